// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What travels with a particle: to another place or rank, to its ghosts, and into restart files.

#include "system/contacts/fix_contact_store.h"

#include "system/host/particle_count.h"
#include "system/host/restart_data.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

using Talus::HistoryStore;

namespace {

// keys and tags travel as the bits of a double
template <class Integer> double as_double(Integer value)
{
  static_assert(sizeof value == sizeof(double));
  double bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

template <class Integer> Integer from_double(double bits)
{
  Integer value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// As they are, bit by bit.
int write_change(const Talus::ChangeRecord &change, double *to)
{
  std::memcpy(to, &change, sizeof change);
  return Talus::ChangeRecord::doubles;
}

Talus::ChangeRecord read_change(const double *from)
{
  Talus::ChangeRecord change;
  std::memcpy(&change, from, sizeof change);
  return change;
}

}    // namespace

void FixContactStore::grow_arrays(int nmax)
{
  keys.resize(nmax);
  if (with_changes) changes.resize(nmax, Talus::ChangeRecord{});
  if (with_last) last.resize(nmax);
  if (guards_positions) positions.resize(3 * nmax);
  store.resize(nmax);
}

/* Before an index changes its meaning contacts have to be in the lists; usually they are. */

void FixContactStore::copy_arrays(int i, int j, int /*delflag*/)
{
  memory_of_contacts.put_aside();
  keys[j] = keys[i];
  if (with_changes) changes[j] = changes[i];
  if (with_last) last[j] = last[i];
  if (guards_positions) std::copy(&positions[3 * i], &positions[3 * i] + 3, &positions[3 * j]);
  store.copy(i, j);
}

void FixContactStore::set_arrays(int i)
{
  memory_of_contacts.put_aside();
  refresh_key(i);
  if (guards_positions) std::copy(atom->x[i], atom->x[i] + 3, &positions[3 * i]);
  if (with_changes) changes[i] = Talus::ChangeRecord{};
  if (with_last) store_velocity(i);
  store.forget(i);
}

/* Of LAMMPS' own proxies: those of the records find theirs on their own. */

int FixContactStore::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/,
                                       int * /*pbc*/)
{
  for (int k = 0; k < n; k++, buf += size_change) write_change(changes[list[k]], buf);
  return size_change * n;
}

void FixContactStore::unpack_forward_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++, buf += size_change) changes[first + k] = read_change(buf);
}

int FixContactStore::pack_border(int n, int *list, double *buf)
{
  if (!comm_border) return 0;
  for (int k = 0; k < n; k++, buf += comm_border) {
    const int i = list[k];
    // a ghost may be passed on to the next rank
    const std::int64_t owner = i < atom->nlocal ? comm->me : store.owner_of_ghost(atom->nlocal, i);
    buf[0] = as_double(keys[i]);
    HistoryStore::write(store.origin(i), buf + 1);
    buf[1 + HistoryStore::size_origin] = as_double(owner);
  }
  return comm_border * n;
}

int FixContactStore::unpack_border(int n, int first, double *buf)
{
  if (!comm_border) return 0;
  for (int k = 0; k < n; k++, buf += comm_border) {
    keys[first + k] = from_double<std::uint64_t>(buf[0]);
    store.set_ghost(
        atom->nlocal, first + k, HistoryStore::read(buf + 1),
        static_cast<int>(from_double<std::int64_t>(buf[1 + HistoryStore::size_origin])));
  }
  return comm_border * n;
}

int FixContactStore::pack_exchange(int i, double *buf)
{
  memory_of_contacts.put_aside();
  int m = 0;
  buf[m++] = as_double(keys[i]);
  for (int d = 0; guards_positions && d < 3; d++) buf[m++] = positions[3 * i + d];
  if (with_changes) m += write_change(changes[i], buf + m);
  if (with_last) m += std::copy(last[i].begin(), last[i].end(), buf + m) - (buf + m);
  return m + store.pack(i, buf + m);
}

int FixContactStore::unpack_exchange(int i, double *buf)
{
  memory_of_contacts.put_aside();
  int m = 0;
  keys[i] = from_double<std::uint64_t>(buf[m++]);
  for (int d = 0; guards_positions && d < 3; d++) positions[3 * i + d] = buf[m++];
  if (with_changes) {
    changes[i] = read_change(buf + m);
    m += size_change;
  }
  if (with_last) {
    std::copy_n(buf + m, size_last, last[i].data());
    m += size_last;
  }
  return m + store.unpack(i, buf + m);
}

/* ---------------------------------------------------------------------- */

/* Particles are in the arrays of LAMMPS. Ghosts get theirs from them, before forces that ask for it. */

void FixContactStore::exchange_particles(Talus::StateExchange &x)
{
  const auto n = static_cast<std::ptrdiff_t>(atom->nlocal);
  x.array(keys.data(), n);
  x(order);
  std::vector<Talus::ChangeRecord> own_changes;
  std::vector<Velocities> own_last;
  if (with_changes) own_changes.assign(changes.begin(), changes.begin() + n);
  if (with_last) own_last.assign(last.begin(), last.begin() + n);
  bool had_last = with_last;
  x(own_changes, had_last, own_last);
  if (!x.restores()) return;
  if (with_changes) restore_changes(own_changes);
  with_last = with_changes && had_last;
  last.resize(with_last ? keys.size() : 0);
  if (with_last) std::copy(own_last.begin(), own_last.end(), last.begin());
  for (int i = 0; guards_positions && i < atom->nlocal; i++)
    std::copy(atom->x[i], atom->x[i] + 3, &positions[3 * i]);
}

/* They may be kept since. */

void FixContactStore::restore_changes(const std::vector<Talus::ChangeRecord> &saved)
{
  std::fill_n(changes.begin(), atom->nlocal, Talus::ChangeRecord{});
  std::copy(saved.begin(), saved.end(), changes.begin());
}

void FixContactStore::exchange_histories(Talus::StateExchange &x)
{
  memory_of_contacts.exchange_state(x);
  if (!x.restores()) return;
  store.resize(static_cast<int>(keys.size()));
  current = false;
}

/* What a restart file holds of this fix: for all particles the state below, for each of them key, name, tag, the list
   of contacts, and with an integrator of second order the changes of velocities. */

namespace {

constexpr int restart_format = 6;
enum State { INVERSE_CELL, PARTICLES, ORDER, WITH_PAIRS, STATE_SIZE };
constexpr int restart_header = Talus::size_particle_head + 3;

}    // namespace

std::string FixContactStore::unassignable(const char *how) const
{
  return name() + ": particles were " + how +
         " between read_restart and the first run, so that contact history cannot be assigned: put "
         "'run 0' in between, behind pair_style, fix large/body and fix shape/gran";
}

void FixContactStore::write_restart(FILE *fp)
{
  store_histories(Occasion::RESTART_FILE);    // on all ranks, before particles are packed
  const bigint particles = Talus::count_particles(lmp);
  if (comm->me) return;
  double state[STATE_SIZE];
  state[INVERSE_CELL] = inverse_cell;
  state[PARTICLES] = static_cast<double>(particles);
  state[ORDER] = order;
  state[WITH_PAIRS] = has_pairs() ? 1.0 : 0.0;
  Talus::write_restart_data_of_fix(fp, restart_format, state, sizeof state);
}

void FixContactStore::restart(char *buf)
{
  const std::vector<double> state = Talus::restart_data_of_fix(lmp, name(), restart_format, buf);
  order = static_cast<int>(state[ORDER]);
  pairs_were_read = state[WITH_PAIRS] != 0.0;
  inverse_cell = state[INVERSE_CELL];
  if (state[PARTICLES] != static_cast<double>(atom->natoms))
    error->all(FLERR, unassignable("added or deleted"));
}

int FixContactStore::pack_restart(int i, double *buf)
{
  int size = restart_header + store.pack_list(i, buf + restart_header);
  if (with_changes) size += write_change(changes[i], buf + size);
  double *const head = buf + Talus::size_particle_head;
  head[0] = as_double(keys[i]);
  head[1] = as_double(store.origin(i).name);
  head[2] = as_double(static_cast<std::int64_t>(atom->tag[i]));
  return Talus::complete_particle_data(buf, size);
}

/* LAMMPS does not move what it has read for us when particles are deleted before this fix exists:
   restart() looks at their number, this at their names. */

void FixContactStore::unpack_restart(int i, int nth)
{
  const double *const head = Talus::particle_data(lmp, name(), i, nth);
  if (!head) return;
  const double *const data = head - Talus::size_particle_head;
  keys[i] = from_double<std::uint64_t>(head[0]);
  if (from_double<std::int64_t>(head[2]) != atom->tag[i])
    error->one(FLERR, unassignable("deleted or renumbered"));
  store.set_name(i, from_double<std::int64_t>(head[1]));
  const int size_of_list = store.unpack_list(i, data + restart_header);
  const int read = restart_header + size_of_list;
  largest_read = std::max(largest_read, size_of_list);
  set_maxexchange(largest_read);    // it may migrate before init()
  if (static_cast<int>(data[0]) == read) return;
  keep_changes(true);    // init() may drop them
  changes[i] = read_change(data + read);
}

/* Exactly, not an upper limit: LAMMPS writes as much, and reads it as further particles. */

int FixContactStore::size_restart(int i)
{
  scratch.resize(store.list_size(i));
  return restart_header + store.pack_list(i, scratch.data()) + (with_changes ? size_change : 0);
}

int FixContactStore::maxsize_restart()
{
  int mine = restart_header + store.largest_list(atom->nlocal) + size_change, most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}
