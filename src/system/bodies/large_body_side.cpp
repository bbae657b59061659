// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/bodies/large_body_side.h"

#include "body/shape/mesh_interior.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "utils.h"

using namespace LAMMPS_NS;

namespace Talus {

void LargeBodySide::decide(int group_bits, const BodyFrame &frame)
{
  if (!is_open()) return;
  const MeshInterior interior(mesh_shape->surface());
  bigint here[2] = {0, 0}, count[2];    // outside, inside
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & group_bits)) continue;
    const double *x = atom->x[i];
    here[interior.contains(frame.point_to_body(Vector3<double>{x[0], x[1], x[2]}))]++;
  }
  MPI_Allreduce(here, count, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (count[0] + count[1] == 0) return;
  if (count[0] && count[1]) {
    mesh_shape->set_side(MeshSide::BOTH);
    if (comm->me == 0)
      error->warning(FLERR,
                     "fix large/body mesh '{}': {} particles are inside of it and {} outside: it "
                     "acts on both sides; say 'inside' or 'outside' if one is meant",
                     mesh_shape->name(), count[1], count[0]);
    return;
  }
  mesh_shape->set_side(mesh_shape->side_within(count[1] > 0));
  if (comm->me == 0)
    utils::logmesg(lmp, "fix large/body mesh '{}': particles are {} of it: it acts on this side\n",
                   mesh_shape->name(), count[1] ? "inside" : "outside");
}

}    // namespace Talus
