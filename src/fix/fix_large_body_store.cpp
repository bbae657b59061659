// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What fix large/body keeps of each particle and of the body, on its way between ranks and through
// restart files.

#include "fix/fix_large_body.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

void FixLargeBody::keep_history()
{
  if (!with_history) return;
  restart_peratom = 1;
  create_attribute = 1;
  contacts.history.keep_impacts(with_impact);
  maxexchange = max_packed();
  FixLargeBody::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) FixLargeBody::set_arrays(i);
}

int FixLargeBody::max_packed() const
{
  return shape->one_contact() ? contacts.history.size_packed() : ContactMemory::max_packed;
}

void FixLargeBody::grow_arrays(int nmax)
{
  if (shape->one_contact())
    contacts.history.grow(nmax);
  else
    contacts.memory.grow(nmax);
}

void FixLargeBody::copy_arrays(int i, int j, int /*delflag*/)
{
  if (shape->one_contact())
    contacts.history.copy(i, j);
  else
    contacts.memory.copy(i, j);
}

void FixLargeBody::set_arrays(int i)
{
  if (shape->one_contact())
    contacts.history.forget(i);
  else
    contacts.memory.forget(i);
}

int FixLargeBody::pack_exchange(int i, double *buf)
{
  return shape->one_contact() ? contacts.history.pack(i, buf) : contacts.memory.pack(i, buf);
}

int FixLargeBody::unpack_exchange(int i, double *buf)
{
  return shape->one_contact() ? contacts.history.unpack(i, buf) : contacts.memory.unpack(i, buf);
}

/* Number of particles; motion; what triangles have borne. The host does not move what it has read
   for us when particles are deleted before this fix is defined: the number tells. */

void FixLargeBody::write_restart(FILE *fp)
{
  std::vector<double> values(1 + LargeBodyMotion::size_restart);
  values[0] = static_cast<double>(atom->natoms);
  motion.to_array(&values[1]);
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
  if (with_history && values[0] != static_cast<double>(atom->natoms))
    error->all(FLERR,
               "Fix large/body {}: particles were added or deleted between read_restart and this "
               "command, so "
               "that contact history cannot be assigned: define the fix right after read_restart",
               id);
  if (!motion.from_array(&values[1]) && comm->me == 0)
    error->warning(FLERR,
                   "Fix large/body {}: the restart file has another kind of motion: the body "
                   "begins where this command puts it",
                   id);
  surface->read_work(values, 1 + LargeBodyMotion::size_restart);
}

int FixLargeBody::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  pack_exchange(i, buf + 1);
  return static_cast<int>(buf[0]);
}

/* The restart file may hold less than this fix keeps, or more, if its words have changed. */

void FixLargeBody::unpack_restart(int i, int nth)
{
  double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  const int stored = static_cast<int>(extra[m]) - 1;
  double values[ContactMemory::max_packed] = {};
  std::copy(extra + m + 1, extra + m + 1 + std::min(stored, max_packed()), values);
  unpack_exchange(i, values);
}

int FixLargeBody::size_restart(int i)
{
  return 1 + (shape->one_contact() ? max_packed() : contacts.memory.size_packed(i));
}

int FixLargeBody::maxsize_restart()
{
  return 1 + max_packed();
}
