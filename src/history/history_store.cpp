// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/history_store.h"

#include "base/in_parallel.h"

#include <cstring>
#include <numeric>

namespace Talus {

void HistoryStore::keep(int number)
{
  records = number;
  named.keep(records);
}

void HistoryStore::begin(const WorkPartition &partition, Scope of)
{
  filled = true;
  scope = of;
  work = partition;
  chunks.resize(work.num_chunks());
}

void HistoryStore::finish(const ParticleOrder &last, int num_threads)
{
  threads = num_threads;
  name_contacts(last);
  if (!scope.particles_may_leave) return;
  name_of_slot.resize(last.size());
  in_ranges(last.size(), threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) {
      const int atom = last.atom_of_slot[s];
      name_of_slot[s] = last.is_owned(atom) ? last.tag[atom] : -last.tag[atom];
    }
  });
  count_followers();
}

/* Contacts with ghosts. What the other side of a contact decides comes with receive(), or here if
   it is an image of a particle of this rank. */

void HistoryStore::name_contacts(const ParticleOrder &last)
{
  std::size_t count = 0;
  for (const SlotContacts &chunk : chunks) count += chunk.with_ghost.size();
  named.reserve(count);
  for (const SlotContacts &chunk : chunks)
    for (const SlotContacts::Contact &c : chunk.with_ghost) {
      const int first = last.atom_of_slot[c.first], second = last.atom_of_slot[c.second];
      const bool of_ghost = !last.is_owned(first);
      const int owner = owner_of_ghost(last.owned, of_ghost ? first : second);
      if (owner == me) {
        touched_image.resize(last.size(), 0);
        touched_image[of_ghost ? c.second : c.first] = 1;
      }
      if (scope.periodic && of_ghost) continue;
      const HistoryValues history = chunk.histories.values(c.place);
      named.insert(last.tag[first], last.tag[second], history);
      if (scope.periodic && owner != me)
        add_message(owner, last.tag[first], last.tag[second], history);
    }
}

/* Both names, as the bits of doubles, and the history as the first sees it. */

void HistoryStore::add_message(int rank, std::int64_t first, std::int64_t second,
                               const HistoryValues &history)
{
  std::vector<double> &to = messages[rank];
  const std::int64_t names[2] = {first, second};
  const std::size_t begin = to.size();
  to.resize(begin + 2);
  std::memcpy(&to[begin], names, sizeof names);
  to.insert(to.end(), history.begin(), history.begin() + 4L * records);
}

void HistoryStore::receive(const std::vector<double> &message)
{
  const std::size_t stride = 2 + 4L * records;
  for (std::size_t n = 0; n < message.size(); n += stride) {
    std::int64_t names[2];
    std::memcpy(names, &message[n], sizeof names);
    HistoryValues history{};
    std::copy_n(&message[n + 2], 4L * records, history.data());
    named.insert(names[0], names[1], history);
  }
}

/* ---------------------------------------------------------------------- */

void HistoryStore::open(const ParticleOrder &present, int num_threads)
{
  order = &present;
  if (empty()) return;
  name_lists(present.owned);
  slot_then.resize(present.size());
  in_ranges(present.size(), num_threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) slot_then[s] = plain_slot(present.atom_of_slot[s]);
  });
}

void HistoryStore::open_unmoved(const ParticleOrder &present)
{
  order = &present;
  slot_then.resize(present.size());
  std::iota(slot_then.begin(), slot_then.end(), 0);
}

/* Of a particle that slots alone tell everything about; -1 of others. One that touched an image may
   now touch the particle itself. */

int HistoryStore::plain_slot(int atom) const
{
  const Origin &o = origins[atom];
  const bool plain = was_here(o) && (touched_image.empty() || !touched_image[o.slot]);
  return plain ? o.slot : -1;
}

FoundHistory HistoryStore::find_of_atoms(int i, int j) const
{
  const Origin &a = origins[i], &b = origins[j];
  if (was_here(a) && was_here(b)) {
    const FoundHistory found = find_by_slots(a.slot, b.slot);
    if (found.known) return found;
  }
  return a.name && b.name ? named.find(a.name, b.name) : FoundHistory{};
}

void HistoryStore::number(const ParticleOrder &present)
{
  clear();
  const int total = present.size();
  for (int i = 0; i < total; i++) {
    const bool owned = present.is_owned(i);
    // ghosts are found by name if lists are made again without new ghosts
    origins[i] = {present.tag[i], owned ? me : -1, owned ? present.slot_of_atom[i] : -1};
  }
}

/* ---------------------------------------------------------------------- */

void HistoryStore::clear()
{
  filled = false;
  order = nullptr;
  named.clear();
  touched_image.clear();
  messages.clear();
  most_partners = 0;
  if (memory_usage() < release_threshold) return;
  chunks = {};
  named = {};
  keep(records);
  release(followers);
  release(followers_begin);
  release(name_of_slot);
  work = {};
  release(slot_then);
}

double HistoryStore::memory_usage() const
{
  double bytes = static_cast<double>(
      sizeof(Origin) * origins.capacity() + sizeof(std::int32_t) * owners.capacity() +
      sizeof(std::int64_t) * name_of_slot.capacity() + touched_image.capacity() +
      sizeof(std::uint32_t) * followers_begin.capacity() +
      sizeof(int) * (followers.capacity() + slot_then.capacity()));
  for (const SlotContacts &chunk : chunks) bytes += chunk.memory_usage();
  for (const auto &message : messages)
    bytes += static_cast<double>(sizeof(double) * message.second.capacity());
  return bytes + lists.memory_usage() + named.memory_usage() + work.memory_usage();
}

}    // namespace Talus
