// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What travels with a particle: to another place or rank, to its ghosts, and into restart files.

#include "system/fix_contact_store.h"

#include "system/granular_system.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

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

}    // namespace

void FixContactStore::grow_arrays(int nmax)
{
  keys.resize(nmax);
  filed_tags.resize(nmax);
  kept_slots.resize(nmax, -1);
  if (guards_positions) positions.resize(3 * nmax);
  partners.resize(nmax);
}

void FixContactStore::copy_arrays(int i, int j, int /*delflag*/)
{
  keys[j] = keys[i];
  filed_tags[j] = filed_tags[i];
  kept_slots[j] = kept_slots[i];
  if (guards_positions) std::copy(&positions[3 * i], &positions[3 * i] + 3, &positions[3 * j]);
  partners.copy(i, j);
}

void FixContactStore::set_arrays(int i)
{
  refresh_key(i);
  filed_tags[i] = 0;
  kept_slots[i] = -1;
  if (guards_positions) std::copy(atom->x[i], atom->x[i] + 3, &positions[3 * i]);
  partners.clear(i);
}

int FixContactStore::pack_border(int n, int *list, double *buf)
{
  for (int k = 0; k < n; k++) {
    buf[2 * k] = as_double(keys[list[k]]);
    buf[2 * k + 1] = as_double(filed_tags[list[k]]);
  }
  return 2 * n;
}

int FixContactStore::unpack_border(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) {
    keys[first + k] = from_double<std::uint64_t>(buf[2 * k]);
    filed_tags[first + k] = from_double<std::int64_t>(buf[2 * k + 1]);
  }
  return 2 * n;
}

int FixContactStore::pack_exchange(int i, double *buf)
{
  int m = 0;
  buf[m++] = as_double(keys[i]);
  buf[m++] = as_double(filed_tags[i]);
  for (int d = 0; guards_positions && d < 3; d++) buf[m++] = positions[3 * i + d];
  if (kept.empty() || kept_slots[i] < 0) return m + partners.pack(i, buf + m);
  return m + kept.pack(kept_slots[i], partners.num_values(), buf + m);
}

int FixContactStore::unpack_exchange(int i, double *buf)
{
  int m = 0;
  keys[i] = from_double<std::uint64_t>(buf[m++]);
  filed_tags[i] = from_double<std::int64_t>(buf[m++]);
  kept_slots[i] = -1;
  for (int d = 0; guards_positions && d < 3; d++) positions[3 * i + d] = buf[m++];
  return m + partners.unpack(i, buf + m);
}

/* ---------------------------------------------------------------------- */

void FixContactStore::write_restart(FILE *fp)
{
  store_histories(Occasion::RESTART_FILE);    // on all ranks, before particles are packed
  file_kept();
  if (comm->me) return;
  const double state[3] = {inverse_cell, static_cast<double>(partners.num_values()),
                           static_cast<double>(atom->natoms)};
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(state, size, 1, fp);
}

void FixContactStore::restart(char *buf)
{
  double state[3];
  std::memcpy(state, buf, sizeof state);
  inverse_cell = state[0];
  partners.set_values(static_cast<int>(state[1]));
  if (state[2] != static_cast<double>(atom->natoms))
    error->all(
        FLERR,
        "Pair style gran/penalty: particles were added or deleted between read_restart and the "
        "first run, so that contact history cannot be assigned: put 'run 0' in between");
}

int FixContactStore::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  buf[1] = as_double(keys[i]);
  buf[2] = as_double(filed_tags[i]);
  buf[3] = as_double(static_cast<std::int64_t>(atom->tag[i]));
  return 4 + partners.pack(i, buf + 4);
}

/* The host does not move what it has read for us when particles are deleted before this fix exists:
   restart() looks at their number, this at their names. */

void FixContactStore::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  keys[i] = from_double<std::uint64_t>(extra[m + 1]);
  filed_tags[i] = from_double<std::int64_t>(extra[m + 2]);
  if (from_double<std::int64_t>(extra[m + 3]) != atom->tag[i])
    error->one(
        FLERR,
        "Pair style gran/penalty: particles were deleted or renumbered between read_restart and "
        "the first run, so that contact history cannot be assigned: put 'run 0' in between");
  kept_slots[i] = -1;
  partners.unpack(i, extra + m + 4);
}

int FixContactStore::size_restart(int i)
{
  return 4 + partners.packed_size(i);
}

int FixContactStore::maxsize_restart()
{
  int mine = 0, most = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, size_restart(i));
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}

/* ---------------------------------------------------------------------- */

/* Across a periodic border both sides compute a pair, from positions that were shifted and rounded
   differently, so their histories may differ in the last bits. Which of them would live on depends
   on the decomposition: let it be that of the first particle, everywhere. */

void FixContactStore::agree_on_shared_pairs()
{
  int mine = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, partners.size(i));
  MPI_Allreduce(&mine, &most_entries, 1, MPI_INT, MPI_MAX, world);
  if (most_entries == 0) return;

  ghost_entries.assign(static_cast<std::size_t>(atom->nghost) * most_entries * comm_forward, 0.0);
  for (sent_entry = 0; sent_entry < most_entries; sent_entry++) comm->forward_comm(this);

  system->adopt_first_copies(partners, [this](int atom_index, std::int64_t tag) -> const double * {
    for (int n = 0; n < most_entries; n++) {
      const double *entry = ghost_entry(atom_index, n);
      if (from_double<std::int64_t>(entry[0]) == tag) return entry + 1;
    }
    return nullptr;
  });
  std::vector<double>().swap(ghost_entries);
}

double *FixContactStore::ghost_entry(int i, int n)
{
  const std::size_t index = static_cast<std::size_t>(i - atom->nlocal) * most_entries + n;
  return &ghost_entries[index * comm_forward];
}

int FixContactStore::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  for (int k = 0; k < n; k++) {
    double *entry = buf + static_cast<std::size_t>(k) * comm_forward;
    std::fill(entry, entry + comm_forward, 0.0);
    const int i = list[k];
    // a ghost that is passed on to the next rank
    if (i >= atom->nlocal)
      std::copy(ghost_entry(i, sent_entry), ghost_entry(i, sent_entry) + comm_forward, entry);
    else if (sent_entry < partners.size(i))
      partners.copy_entry(i, sent_entry, entry);
  }
  return n * comm_forward;
}

void FixContactStore::unpack_forward_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++)
    std::copy(buf + static_cast<std::size_t>(k) * comm_forward,
              buf + static_cast<std::size_t>(k + 1) * comm_forward,
              ghost_entry(first + k, sent_entry));
}
