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

/* Of a particle, the contacts in its own rows are those with partners before it; the others are
   with its followers: contacts of whose pairs it is the first particle. Calls visit(chunk) for all
   chunks: the ranges of a phase at the same time, the phases one after the other, for both add to
   the same particles. */

template <class Visit> void HistoryStore::for_each_chunk(Visit visit) const
{
  for (int phase = 0; phase < work.num_phases(); phase++)
    in_parallel(work.num_ranges(), threads, [&](int r) { visit(work.chunk(phase, r)); });
}

/* A chunk counts for the slots of its range; what it has of others is counted afterwards. Without a
   loop over rows, whose lengths cannot be foreseen. */

void HistoryStore::count_followers()
{
  followers_listed = false;
  followers_begin.assign(name_of_slot.size() + 2, 0);
  std::vector<std::vector<int>> elsewhere(chunks.size());
  for_each_chunk([&](int c) {
    const SlotContacts &its = chunks[c];
    const SlotRange range = work.range_of_chunk(c);
    for (std::uint32_t e = 0; e < its.rows.back(); e++)
      if (range.holds(its.first[e]))
        followers_begin[its.first[e] + 2]++;
      else
        elsewhere[c].push_back(its.first[e]);
  });
  for (const std::vector<int> &of_chunk : elsewhere)
    for (const int slot : of_chunk) followers_begin[slot + 2]++;
  for (int s = 0; s < static_cast<int>(name_of_slot.size()); s++)
    if (name_of_slot[s] > 0)
      most_partners =
          std::max(most_partners, row_size(s) + static_cast<int>(followers_begin[s + 2]));
}

/* Of all phases. */

int HistoryStore::row_size(int slot) const
{
  int size = 0;
  const int range = work.range_of(slot);
  for (int phase = 0; phase < work.num_phases(); phase++) {
    const SlotContacts &its = chunks[work.chunk(phase, range)];
    size += static_cast<int>(its.row_end(slot) - its.row_begin(slot));
  }
  return size;
}

/* From the number of followers of each particle to lists: when the first one leaves, for often
   none does. */

void HistoryStore::list_followers()
{
  if (followers_listed) return;
  followers_listed = true;
  for (std::size_t s = 2; s < followers_begin.size(); s++)
    followers_begin[s] += followers_begin[s - 1];
  renew(followers, followers_begin.back());
  // the begin of a row moves on to its end
  const auto add = [this](int slot, int partner) {
    followers[followers_begin[slot + 1]++] = partner;
  };
  std::vector<std::vector<std::pair<int, int>>> elsewhere(chunks.size());
  for_each_chunk([&](int c) {
    const SlotRange range = work.range_of_chunk(c);
    chunks[c].for_each([&](int first, int second) {
      if (range.holds(first))
        add(first, second);
      else
        elsewhere[c].emplace_back(first, second);
    });
  });
  for (const auto &of_chunk : elsewhere)
    for (const auto &[slot, partner] : of_chunk) add(slot, partner);
}

/* visit(partner) for all slots that touched this one. */

template <class Visit> void HistoryStore::for_each_partner(int slot, Visit visit)
{
  list_followers();
  const int range = work.range_of(slot);
  for (int phase = 0; phase < work.num_phases(); phase++) {
    const SlotContacts &its = chunks[work.chunk(phase, range)];
    for (std::uint32_t e = its.row_begin(slot); e < its.row_end(slot); e++) visit(its.first[e]);
  }
  for (std::uint32_t n = followers_begin[slot]; n < followers_begin[slot + 1]; n++)
    visit(followers[n]);
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
    const int slot = origins[atom].slot;
    for_each_partner(slot, [&](int other) {
      const std::int64_t name = name_of_slot[other];
      const FoundHistory found =
          name > 0 ? find_by_slots(slot, other) : named.find(name_of_slot[slot], -name);
      if (!found.known) return;    // its first particle sees no contact
      const std::int64_t partner = std::abs(name);
      const Record seen = found.seen_by_a();
      std::memcpy(to++, &partner, sizeof partner);
      to = std::copy_n(seen.c, 4, to);
      if (with_impacts) to = std::copy_n(found.impact->c, 4, to);
      count++;
    });
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
    const std::uint32_t *begin = &followers_begin[o.slot];
    const int contacts =
        row_size(o.slot) + static_cast<int>(followers_listed ? begin[1] - begin[0] : begin[2]);
    return list_header + contacts * (1 + values());
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
