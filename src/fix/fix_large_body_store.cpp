// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What fix large/body keeps of each particle and of the body, on its way between ranks and through
// restart files.

#include "fix/fix_large_body.h"

#include "base/state_exchange.h"
#include "system/particle_count.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

// Negative: files of the first version begin with the number of particles.
constexpr double restart_version = -7.0;
constexpr int size_head = 3;
constexpr int restart_header = 2;    // of a particle: number of doubles, ID

}    // namespace

void FixLargeBody::keep_history()
{
  if (!body.keeps_history()) return;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange = body.history().max_packed();
  FixLargeBody::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) FixLargeBody::set_arrays(i);
}

void FixLargeBody::grow_arrays(int nmax)
{
  body.history().grow(nmax);
}

void FixLargeBody::copy_arrays(int i, int j, int /*delflag*/)
{
  body.history().copy(i, j);
}

void FixLargeBody::set_arrays(int i)
{
  body.history().forget(i);
}

int FixLargeBody::pack_exchange(int i, double *buf)
{
  return body.history().pack(i, buf);
}

int FixLargeBody::unpack_exchange(int i, double *buf)
{
  return body.history().unpack(i, buf);
}

void FixLargeBody::exchange_state(StateExchange &x)
{
  motion.exchange_state(x);
  if (vertices) vertices->exchange_state(x);
  side.exchange_state(x);
  surface->exchange_state(x);
  body.exchange_state(x);
}

/* Version of what follows; number of particles; side of a mesh; motion; size and state of vertices that move;
   what triangles have borne.
   LAMMPS does not move what it has read for us when particles are deleted before this fix is
   defined: the number tells. */

void FixLargeBody::write_restart(FILE *fp)
{
  const bigint particles = Talus::count_particles(lmp);
  std::vector<double> values(size_head + LargeBodyMotion::size_restart);
  values[0] = restart_version;
  values[1] = static_cast<double>(particles);
  values[2] = side.code();
  motion.to_array(&values[size_head]);
  values.push_back(0.0);
  const std::size_t before = values.size();
  if (vertices) vertices->to_array(values);
  values[before - 1] = static_cast<double>(values.size() - before);
  surface->append_work(values);    // sums over ranks
  if (comm->me) return;
  const int size = static_cast<int>(values.size() * sizeof(double));
  const double entries = static_cast<double>(values.size());
  const int all = size + static_cast<int>(sizeof entries);
  fwrite(&all, sizeof all, 1, fp);
  fwrite(&entries, sizeof entries, 1, fp);
  fwrite(values.data(), sizeof(double), values.size(), fp);
}

void FixLargeBody::restart(char *buf)
{
  double entries;
  std::memcpy(&entries, buf, sizeof entries);
  std::vector<double> values(static_cast<std::size_t>(entries));
  std::memcpy(values.data(), buf + sizeof entries, values.size() * sizeof(double));
  if (values[0] != restart_version)
    error->all(FLERR,
               "Fix large/body {}: the restart file was written by another version of Talus, which "
               "kept other data of large bodies: go on with that version",
               id);
  if (body.keeps_history() && values[1] != static_cast<double>(atom->natoms))
    error->all(FLERR,
               "Fix large/body {}: particles were added or deleted between read_restart and this "
               "command, so that contact history cannot be assigned: define the fix right after "
               "read_restart",
               id);
  side.set_code(values[2]);
  const double *const of_vertices = &values[size_head + LargeBodyMotion::size_restart];
  const int size_vertices = static_cast<int>(*of_vertices);
  const bool same_motion = motion.from_array(&values[size_head]);
  if (!same_motion && comm->me == 0)
    error->warning(FLERR,
                   "Fix large/body {}: the restart file has another kind of motion: the body "
                   "begins where this command puts it",
                   id);
  if (same_motion && vertices &&
      !vertices->from_array(of_vertices + 1, of_vertices + 1 + size_vertices))
    error->all(
        FLERR,
        "Fix large/body {}: the mesh of the restart file had another number of vertices: use "
        "the same file and words",
        id);
  surface->read_work(values, size_head + LargeBodyMotion::size_restart + 1 + size_vertices);
}

int FixLargeBody::pack_restart(int i, double *buf)
{
  const int size = restart_header + pack_exchange(i, buf + restart_header);
  buf[0] = size;
  buf[1] = ubuf(atom->tag[i]).d;
  return size;
}

void FixLargeBody::unpack_restart(int i, int nth)
{
  double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  if (ubuf(extra[m + 1]).i != atom->tag[i])
    error->one(FLERR,
               "Fix large/body {}: particles were deleted or renumbered between read_restart and "
               "this command, so that contact history cannot be assigned: define the fix right "
               "after read_restart",
               id);
  unpack_exchange(i, extra + m + restart_header);
}

int FixLargeBody::size_restart(int i)
{
  return restart_header + body.history().size_packed(i);
}

int FixLargeBody::maxsize_restart()
{
  return restart_header + body.history().max_packed();
}
