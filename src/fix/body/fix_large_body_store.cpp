// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What fix large/body keeps of each particle and of the body, on its way between ranks and through
// restart files.

#include "fix/body/fix_large_body.h"

#include "base/state_exchange.h"
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

constexpr int restart_format = 9;
constexpr int restart_header = size_particle_head + 1;    // of a particle: and its ID

}    // namespace

void FixLargeBody::keep_history()
{
  if (!body->keeps_history()) return;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange = body->history().max_packed();
  FixLargeBody::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) FixLargeBody::set_arrays(i);
}

void FixLargeBody::grow_arrays(int nmax)
{
  body->history().grow(nmax);
}

void FixLargeBody::copy_arrays(int i, int j, int /*delflag*/)
{
  body->history().copy(i, j);
}

void FixLargeBody::set_arrays(int i)
{
  body->history().forget(i);
}

int FixLargeBody::pack_exchange(int i, double *buf)
{
  return body->history().pack(i, buf);
}

int FixLargeBody::unpack_exchange(int i, double *buf)
{
  return body->history().unpack(i, buf);
}

void FixLargeBody::exchange_state(StateExchange &x)
{
  body->exchange_state(x);
}

/* Number of particles, and the state of the body. LAMMPS does not move what it has read for us when particles are deleted
   before this fix is defined: the number tells. */

void FixLargeBody::write_restart(FILE *fp)
{
  std::vector<double> values = body->state_of_all_ranks();
  values.insert(values.begin(), static_cast<double>(Talus::count_particles(lmp)));
  if (comm->me) return;
  write_restart_data_of_fix(fp, restart_format, values.data(), values.size() * sizeof(double));
}

void FixLargeBody::restart(char *buf)
{
  const std::string data =
      restart_data_of_fix(lmp, std::string("Fix large/body ") + id, restart_format, buf);
  std::vector<double> values(std::max(data.size() / sizeof(double), std::size_t{1}));
  std::memcpy(values.data(), data.data(), data.size());
  if (body->keeps_history() && values[0] != static_cast<double>(atom->natoms))
    error->all(FLERR,
               "Fix large/body {}: particles were added or deleted between read_restart and this "
               "command, so that contact history cannot be assigned: define the fix right after "
               "read_restart",
               id);
  const LargeBody::RestartProblem problem =
      body->restart_from(values.data() + 1, values.data() + values.size());
  if (!problem.error.empty()) error->all(FLERR, "Fix large/body {}: {}", id, problem.error);
  if (!problem.warning.empty() && comm->me == 0)
    error->warning(FLERR, "Fix large/body {}: {}", id, problem.warning);
}

int FixLargeBody::pack_restart(int i, double *buf)
{
  const int size = restart_header + pack_exchange(i, buf + restart_header);
  buf[size_particle_head] = ubuf(atom->tag[i]).d;
  return complete_particle_data(buf, size);
}

void FixLargeBody::unpack_restart(int i, int nth)
{
  const double *data = particle_data(lmp, std::string("Fix large/body ") + id, i, nth);
  if (!data) return;
  if (ubuf(*data++).i != atom->tag[i])
    error->one(FLERR,
               "Fix large/body {}: particles were deleted or renumbered between read_restart and "
               "this command, so that contact history cannot be assigned: define the fix right "
               "after read_restart",
               id);
  body->history().unpack(i, data);
}

int FixLargeBody::size_restart(int i)
{
  return restart_header + body->history().size_packed(i);
}

int FixLargeBody::maxsize_restart()
{
  return restart_header + body->history().max_packed();
}
