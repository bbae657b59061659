/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

// What travels with particles: orientations and histories of contact points.

#include "fix/fix_shape_gran.h"

#include "base/state_exchange.h"
#include "system/particle_count.h"
#include "system/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int restart_format = 4;
constexpr int restart_header = size_particle_head + 1;    // of a particle: and its ID

}    // namespace

void FixShapeGran::grow_arrays(int nmax)
{
  memory->grow(quat, nmax, 4, "shape/gran:quat");
  array_atom = quat;
  histories.grow(nmax);
}

void FixShapeGran::copy_arrays(int i, int j, int /*delflag*/)
{
  std::copy(quat[i], quat[i] + 4, quat[j]);
  histories.copy(i, j);
}

/* Radius and mass at once, so that others are put at the right distance. */

void FixShapeGran::set_arrays(int i)
{
  std::fill(quat[i], quat[i] + 4, 0.0);
  histories.forget(i);
  set_sizes(i, i + 1);
}

int FixShapeGran::pack_border(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++) std::copy(quat[list[k]], quat[list[k]] + 4, buf + 4L * k);
  return 4 * n;
}

int FixShapeGran::unpack_border(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) std::copy(buf + 4L * k, buf + 4L * k + 4, quat[first + k]);
  return 4 * n;
}

int FixShapeGran::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return pack_border(n, list, buf);
}

void FixShapeGran::unpack_forward_comm(int n, int first, double *buf)
{
  unpack_border(n, first, buf);
}

int FixShapeGran::pack_exchange(int i, double *buf)
{
  std::copy(quat[i], quat[i] + 4, buf);
  return 4 + histories.pack(i, buf + 4);
}

int FixShapeGran::unpack_exchange(int i, double *buf)
{
  return take_from(i, buf);
}

int FixShapeGran::take_from(int i, const double *buf)
{
  std::copy(buf, buf + 4, quat[i]);
  return 4 + histories.unpack(i, buf + 4);
}

/* Points are kept by pair as well: in a periodic box a run goes on with those of both sides as they are. A body that
   was touched by no particle with a shape then has none. */

void FixShapeGran::exchange_state(StateExchange &x)
{
  if (atom->nlocal) x.array(quat[0], 4L * atom->nlocal);
  x(histories, histories_are_current);
  pairs.exchange_state(x);
  for (LargeBody *body : system->bodies().in_order()) {
    Wall &wall = wall_of(*body);
    bool has_points = wall.points != nullptr;
    x(has_points);
    if (has_points && !wall.points)
      wall.points = std::make_unique<WallPoints>(table, name_of(*body));
    if (!has_points) wall.points.reset();
    if (has_points) wall.points->exchange_state(x);
  }
  if (!x.restores()) return;
  histories.grow(atom->nmax);
  orientations_were_set = true;
  set_maxexchange();
}

/* Restart files hold the number of particles; of each particle its ID, and what it carries. LAMMPS does not move what it has read for us when particles are
   deleted or added before this fix is defined: their number tells. */

void FixShapeGran::write_restart(FILE *fp)
{
  keep_histories();    // on all ranks, before particles are packed
  const bigint particles = Talus::count_particles(lmp);
  if (comm->me) return;
  write_restart_data_of_fix(fp, restart_format, &particles, sizeof particles);
}

void FixShapeGran::restart(char *buf)
{
  const std::string data =
      restart_data_of_fix(lmp, std::string("Fix shape/gran ") + id, restart_format, buf);
  bigint particles;
  std::memcpy(&particles, data.data(), sizeof particles);
  if (particles != atom->natoms)
    error->all(FLERR,
               "Fix shape/gran {}: particles were added or deleted between read_restart and this "
               "command, so that orientations cannot be assigned: define the fix right after "
               "read_restart",
               id);
}

int FixShapeGran::pack_restart(int i, double *buf)
{
  const int size = restart_header + pack_exchange(i, buf + restart_header);
  buf[size_particle_head] = ubuf(atom->tag[i]).d;
  return complete_particle_data(buf, size);
}

void FixShapeGran::unpack_restart(int i, int nth)
{
  const double *data = particle_data(lmp, std::string("Fix shape/gran ") + id, i, nth);
  if (!data) return;
  if (ubuf(*data++).i != atom->tag[i])
    error->one(FLERR,
               "Fix shape/gran {}: particles were deleted or renumbered between read_restart and "
               "this command, so that orientations cannot be assigned: define the fix right after "
               "read_restart",
               id);
  take_from(i, data);
}

int FixShapeGran::size_restart(int i)
{
  return restart_header + 4 + histories.packed_size(i);
}

int FixShapeGran::maxsize_restart()
{
  int mine = restart_header + 4 + histories.largest_packed(atom->nlocal), most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}

double FixShapeGran::memory_usage()
{
  double bytes = 4.0 * sizeof(double) * atom->nmax + histories.memory_usage() +
                 pairs.memory_usage() + table.memory_usage();
  for (const auto &[body, wall] : walls)
    if (wall.points) bytes += wall.points->memory_usage();
  return bytes;
}
