// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What particles carry along, and their contacts as lists for messages and restart files.

#include "history/history_store.h"

#include "base/in_parallel.h"

#include <cstdlib>
#include <cstring>
#include <utility>

namespace Talus {

namespace {

static_assert(sizeof(HistoryStore::Origin) == HistoryStore::size_origin * sizeof(double));

}    // namespace

void HistoryStore::resize(int capacity)
{
  origins.resize(capacity);
  lists.grow(capacity);
}

void HistoryStore::copy(int from, int to)
{
  origins[to] = origins[from];
  lists.copy(from, to);
}

void HistoryStore::forget(int atom)
{
  origins[atom] = {};
  lists.forget(atom);
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
    const SlotContacts &chunk = chunks[c];
    const SlotRange range = work.range_of_chunk(c);
    for (std::uint32_t e = 0; e < chunk.rows.back(); e++)
      if (range.holds(chunk.first[e]))
        followers_begin[chunk.first[e] + 2]++;
      else
        elsewhere[c].push_back(chunk.first[e]);
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
    const SlotContacts &chunk = chunks[work.chunk(phase, range)];
    size += static_cast<int>(chunk.row_end(slot) - chunk.row_begin(slot));
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
    const SlotContacts &chunk = chunks[work.chunk(phase, range)];
    for (std::uint32_t e = chunk.row_begin(slot); e < chunk.row_end(slot); e++)
      visit(chunk.first[e]);
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

/* A contact with a ghost that the rank of its first particle does not have has no history. */

template <class Visit> void HistoryStore::for_each_contact_of_slot(int slot, Visit visit)
{
  for_each_partner(slot, [&](int other) {
    const std::int64_t name = name_of_slot[other];
    const FoundHistory found =
        name > 0 ? find_by_slots(slot, other) : named.find(name_of_slot[slot], -name);
    if (found.known) visit(std::abs(name), found.seen_by_a());
  });
}

int HistoryStore::pack_list(int atom, double *buffer)
{
  ContactLists::Writer to(buffer);
  const bool by_slots = was_here(origins[atom]);
  if (by_slots && scope.particles_may_leave)
    for_each_contact_of_slot(origins[atom].slot,
                             [&](std::int64_t partner, const HistoryValues &history) {
                               to.add({partner, 0, history.data(), 4 * records});
                             });
  lists.for_each(atom, [&](const ContactLists::Contact &one) {
    if (!is_of_spheres(one) || is_in_list(atom, one)) to.add(one);
  });
  return to.size();
}

/* Of a particle that only passes through another rank and comes back, contacts between spheres are here. */

int HistoryStore::unpack_list(int atom, const double *buffer)
{
  const bool has_slots = was_here(origins[atom]);
  return lists.unpack(atom, buffer, [has_slots](const ContactLists::Contact &one) {
    return has_slots && is_of_spheres(one);
  });
}

HistoryValues HistoryStore::values_of(const ContactLists::Contact &one) const
{
  HistoryValues values{};
  std::copy_n(one.value, std::min(one.values, 4 * records), values.begin());
  return values;
}

std::vector<HistoryStore::Contact> HistoryStore::contacts_of(int atom)
{
  std::vector<Contact> found;
  if (was_here(origins[atom]) && scope.particles_may_leave)
    for_each_contact_of_slot(origins[atom].slot,
                             [&](std::int64_t partner, const HistoryValues &history) {
                               found.push_back({partner, history});
                             });
  lists.for_each(atom, [&](const ContactLists::Contact &one) {
    if (is_in_list(atom, one)) found.push_back({one.partner, values_of(one)});
  });
  return found;
}

void HistoryStore::add(int atom, const Contact &one)
{
  std::copy_n(one.history.begin(), 4L * records, lists.add(atom, one.partner, 0, 4 * records));
}

void HistoryStore::set_name(int atom, std::int64_t name)
{
  origins[atom] = {name, -1, -1};
  lists.forget(atom);
}

int HistoryStore::list_size(int atom) const
{
  const Origin &o = origins[atom];
  int size = lists.packed_size(atom);
  if (!was_here(o) || !scope.particles_may_leave) return size;
  const std::uint32_t *begin = &followers_begin[o.slot];
  const int partners =
      row_size(o.slot) + static_cast<int>(followers_listed ? begin[1] - begin[0] : begin[2]);
  return size + partners * (ContactLists::size_name + 4 * records);
}

int HistoryStore::largest_list(int owned) const
{
  const int partners = filled ? most_partners : 0;
  return lists.largest_packed(owned) + partners * (ContactLists::size_name + 4 * records);
}

int HistoryStore::largest_count(int owned) const
{
  int largest = filled ? most_partners : 0;
  for (int i = 0; !lists.empty() && i < owned; i++) {
    int count = 0;
    lists.for_each(i, [&](const ContactLists::Contact &one) { count += is_in_list(i, one); });
    largest = std::max(largest, count);
  }
  return largest;
}

/* Both particles of a contact may have brought it: in the same bits. */

void HistoryStore::name_lists(int owned)
{
  for (int i = 0; !lists.empty() && i < owned; i++)
    lists.for_each(i, [&](const ContactLists::Contact &one) {
      if (is_in_list(i, one)) named.insert(origins[i].name, one.partner, values_of(one));
    });
}

}    // namespace Talus
