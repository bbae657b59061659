/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

// What travels with particles: orientations.

#include "fix/shape/fix_shape_gran.h"

#include "system/host/particle_count.h"
#include "system/host/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int size_orientation = ShapedParticles::size_orientation;
constexpr int restart_format = 5;
constexpr int restart_header = size_particle_head + 1;    // of a particle: and its ID

}    // namespace

void FixShapeGran::grow_arrays(int nmax)
{
  shapes->grow(nmax);
  array_atom = shapes->orientation_rows();
}

void FixShapeGran::copy_arrays(int i, int j, int /*delflag*/)
{
  shapes->copy(i, j);
}

void FixShapeGran::set_arrays(int i)
{
  shapes->begin(i);
}

int FixShapeGran::pack_border(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++)
    std::copy_n(shapes->orientations()[list[k]], size_orientation, buf + 1L * size_orientation * k);
  return size_orientation * n;
}

int FixShapeGran::unpack_border(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++)
    std::copy_n(buf + 1L * size_orientation * k, size_orientation,
                shapes->orientations()[first + k]);
  return size_orientation * n;
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
  return shapes->pack(i, buf);
}

int FixShapeGran::unpack_exchange(int i, double *buf)
{
  return shapes->unpack(i, buf);
}

void FixShapeGran::exchange_state(StateExchange &x)
{
  shapes->exchange_state(x);
}

/* Restart files hold the number of particles; of each particle its ID, and what it carries. LAMMPS does not move what it has read for us when particles are
   deleted or added before this fix is defined: their number tells. */

void FixShapeGran::write_restart(FILE *fp)
{
  const bigint particles = Talus::count_particles(lmp);
  if (comm->me) return;
  write_restart_data_of_fix(fp, restart_format, &particles, sizeof particles);
}

void FixShapeGran::restart(char *buf)
{
  const std::vector<double> data =
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
  shapes->unpack(i, data);
}

int FixShapeGran::size_restart(int /*i*/)
{
  return restart_header + size_orientation;
}

int FixShapeGran::maxsize_restart()
{
  return restart_header + size_orientation;
}

double FixShapeGran::memory_usage()
{
  return shapes->memory_usage();
}
