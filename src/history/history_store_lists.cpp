// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What particles carry along, and their contacts as lists for messages and restart files:
//
//   number of contacts, values of each (4: the history record; 8: and the impact record)
//   for each contact: the name of the partner, as the bits of a double, and the values as the
//     particle sees them

#include "history/history_store.h"

#include "base/in_parallel.h"

#include <cstring>
#include <utility>

namespace Talus {

namespace {

constexpr int list_header = 2;

static_assert(sizeof(HistoryStore::Origin) == HistoryStore::size_origin * sizeof(double));
static_assert(sizeof(std::int64_t) == sizeof(double), "names travel as the bits of a double");

int size_of_list(const double *list)
{
  return list_header + static_cast<int>(list[0]) * (1 + static_cast<int>(list[1]));
}

}    // namespace

void HistoryStore::resize(int capacity)
{
  origins.resize(capacity);
  list_of.resize(capacity, -1);
}

void HistoryStore::copy(int from, int to)
{
  origins[to] = origins[from];
  list_of[to] = list_of[from];
}

void HistoryStore::forget(int atom)
{
  origins[atom] = {};
  list_of[atom] = -1;
}

void HistoryStore::set_ghost(int owned, int atom, const Origin &origin, int owner)
{
  const std::size_t ghost = atom - owned;
  if (ghost >= owners.size()) owners.resize(ghost + 1);
  owners[ghost] = owner;
  origins[atom] = origin;
}

void HistoryStore::write(const Origin &origin, double *to)
{
  std::memcpy(to, &origin, sizeof origin);
}

HistoryStore::Origin HistoryStore::read(const double *from)
{
  Origin origin;
  std::memcpy(static_cast<void *>(&origin), from, sizeof origin);
  return origin;
}

/* visit(slot, partner) for both particles of every contact: for one slot at a time. The few that
   are not of the chunk that has the contact follow, one after the other. */

template <class Visit> void HistoryStore::for_each_partner(Visit visit)
{
  const int num_chunks = static_cast<int>(chunks.size());
  std::vector<std::vector<std::pair<int, int>>> elsewhere(num_chunks);
  in_parallel(num_chunks, threads, [&](int c) {
    const auto see = [&](int slot, int partner) {
      if (chunk_of(slot) == c)
        visit(slot, partner);
      else
        elsewhere[c].emplace_back(slot, partner);
    };
    chunks[c].for_each([&](int first, int second) {
      see(first, second);
      see(second, first);
    });
  });
  for (const auto &of_chunk : elsewhere)
    for (const auto &[slot, partner] : of_chunk) visit(slot, partner);
}

void HistoryStore::count_partners()
{
  partners_listed = false;
  partners_begin.assign(name_of_slot.size() + 2, 0);
  for_each_partner([this](int slot, int) { partners_begin[slot + 2]++; });
  std::uint32_t most = 0;
  for (std::size_t s = 0; s < name_of_slot.size(); s++)
    if (name_of_slot[s] > 0) most = std::max(most, partners_begin[s + 2]);
  most_partners = static_cast<int>(most);
}

/* From the number of partners of each particle to lists: when the first one leaves, for often
   nobody does. */

void HistoryStore::list_partners()
{
  if (partners_listed) return;
  partners_listed = true;
  for (std::size_t s = 2; s < partners_begin.size(); s++)
    partners_begin[s] += partners_begin[s - 1];
  renew(partners, partners_begin.back());
  // the begin of a row moves on to its end
  for_each_partner(
      [this](int slot, int partner) { partners[partners_begin[slot + 1]++] = partner; });
}

/* ---------------------------------------------------------------------- */

int HistoryStore::pack(int atom, double *buffer)
{
  write(origins[atom], buffer);
  return size_origin + pack_list(atom, buffer + size_origin);
}

int HistoryStore::unpack(int atom, const double *buffer)
{
  origins[atom] = read(buffer);
  return size_origin + unpack_list(atom, buffer + size_origin);
}

int HistoryStore::pack_list(int atom, double *buffer)
{
  const bool here = was_here(origins[atom]) && scope.particles_may_leave;
  if (!here && list_of[atom] >= 0) {
    // names are bit patterns: copied as memory, never as numbers
    const double *list = &lists[list_begin[list_of[atom]]];
    std::memcpy(buffer, list, sizeof(double) * size_of_list(list));
    return size_of_list(list);
  }
  int count = 0;
  double *to = buffer + list_header;
  if (here) {
    list_partners();
    const int slot = origins[atom].slot;
    for (std::uint32_t n = partners_begin[slot]; n < partners_begin[slot + 1]; n++) {
      const std::int64_t name = name_of_slot[partners[n]];
      const FoundHistory found =
          name > 0 ? find_by_slots(slot, partners[n]) : named.find(name_of_slot[slot], -name);
      if (!found.known) continue;    // its first particle sees no contact
      const std::int64_t partner = std::abs(name);
      const Record seen = found.seen_by_a();
      std::memcpy(to++, &partner, sizeof partner);
      to = std::copy_n(seen.c, 4, to);
      if (with_impacts) to = std::copy_n(found.impact->c, 4, to);
      count++;
    }
  }
  buffer[0] = count;
  buffer[1] = values();
  return static_cast<int>(to - buffer);
}

/* Of a particle that only passes through another rank and comes back, everything is here. */

int HistoryStore::unpack_list(int atom, const double *buffer)
{
  const int size = size_of_list(buffer);
  list_of[atom] = -1;
  if (buffer[0] == 0.0 || was_here(origins[atom])) return size;
  list_of[atom] = static_cast<int>(list_begin.size());
  list_begin.push_back(static_cast<std::int64_t>(lists.size()));
  const std::size_t needed = lists.size() + size;
  if (needed > lists.capacity()) lists.reserve(needed + needed / 8);    // not twice
  lists.resize(needed);
  std::memcpy(&lists[list_begin.back()], buffer, sizeof(double) * size);
  return size;
}

int HistoryStore::list_size(int atom) const
{
  const Origin &o = origins[atom];
  if (was_here(o) && scope.particles_may_leave) {
    const std::uint32_t contacts = partners_listed
                                       ? partners_begin[o.slot + 1] - partners_begin[o.slot]
                                       : partners_begin[o.slot + 2];
    return list_header + static_cast<int>(contacts) * (1 + values());
  }
  return list_of[atom] < 0 ? list_header : size_of_list(&lists[list_begin[list_of[atom]]]);
}

int HistoryStore::largest_list(int owned) const
{
  int largest = list_header + (filled ? most_partners * (1 + values()) : 0);
  for (int i = 0; !lists.empty() && i < owned; i++) largest = std::max(largest, list_size(i));
  return largest;
}

/* Both particles of a contact may have brought it: in the same bits. */

void HistoryStore::name_lists(int owned)
{
  for (int i = 0; !lists.empty() && i < owned; i++) {
    if (list_of[i] < 0 || was_here(origins[i])) continue;
    const double *list = &lists[list_begin[list_of[i]]];
    const int contacts = static_cast<int>(list[0]), each = static_cast<int>(list[1]);
    const double *entry = list + list_header;
    for (int n = 0; n < contacts; n++, entry += 1 + each) {
      std::int64_t partner;
      std::memcpy(&partner, entry, sizeof partner);
      Record history, impact = no_history;
      std::copy_n(entry + 1, 4, history.c);
      if (each == 8) std::copy_n(entry + 5, 4, impact.c);
      named.insert(origins[i].name, partner, history, impact);
    }
  }
}

}    // namespace Talus
