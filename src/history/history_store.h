// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact histories from one pair list to the next. The contacts of the last lists are put aside as
// they stand, by the slots of then, and every particle carries along which slot it had: a contact
// of two particles that were and are owned by this rank is found at once. Names (the tags of then)
// are needed for the others: contacts with a ghost, and contacts that arrive with a particle from
// another rank or out of a restart file.
//
//   begin(), ContactHistory::put_aside() for     the last lists are still there
//     every chunk, finish()
//   outgoing(), receive()                        in periodic boxes, before anything moves
//   pack(), unpack(), copy(), forget()           particles migrate, are sorted, deleted, added
//   set_ghost()                                  new ghosts
//   open(), ContactHistory::fetch() for every    new lists are there
//     chunk, number()
//
// In a periodic box the two sides of a contact across a border compute it from positions that were
// shifted and rounded differently, and which of the two histories would live on depends on the
// decomposition: so that of the rank that owns the first particle, in canonical order, is taken
// everywhere. A pair of names must not have more than one contact: periods of a box have to be
// longer than two diameters.

#ifndef TALUS_HISTORY_HISTORY_STORE_H
#define TALUS_HISTORY_HISTORY_STORE_H

#include "history/contact_lists.h"
#include "history/named_contacts.h"
#include "history/slot_contacts.h"
#include "neighbors/work_partition.h"
#include "particles/particle_order.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace Talus {

class HistoryStore {
 public:
  explicit HistoryStore(int this_rank = 0) : me(this_rank) { keep(HistoryRows::most_records); }

  /// Records of each contact from now on, see HistoryRows::keep().
  void keep(int records);
  int num_records() const { return records; }

  // ---- what particles carry along, by local index ---------------------------------------------

  /// Which particle of the last lists this is.
  struct Origin {
    std::int64_t name = 0;                ///< its tag then; 0: it was in none
    std::int32_t rank = -1, slot = -1;    ///< where it was owned, if known
  };
  /// Room for particles 0 ... capacity-1; new ones were in no list and have no contacts.
  void resize(int capacity);
  void copy(int from, int to);
  /// A new particle has this index.
  void forget(int atom);
  /// Of `owned` particles and the ghosts behind them: a ghost, and the rank that owns it.
  void set_ghost(int owned, int atom, const Origin &origin, int owner);
  int owner_of_ghost(int owned, int atom) const { return owners[atom - owned]; }
  const Origin &origin(int atom) const { return origins[atom]; }
  /// As size_origin doubles of a message.
  static void write(const Origin &origin, double *to);
  static Origin read(const double *from);
  static constexpr int size_origin = 2;

  // ---- out of the last lists -------------------------------------------------------------------

  struct Scope {
    bool particles_may_leave;    ///< without it pack() and largest_count() count nothing
    bool periodic;               ///< the first particle decides, see above
  };
  void begin(const WorkPartition &work, Scope scope);
  SlotContacts &chunk(int c) { return chunks[c]; }
  void finish(const ParticleOrder &order, int threads);

  /// What other ranks have to take over, by rank: numbers for receive() there. Valid until clear().
  using Messages = std::map<int, std::vector<double>>;
  const Messages &outgoing() const { return messages; }
  void receive(const std::vector<double> &message);

  /// Removes all histories but those of the lists, and releases the memory if it is large.
  void clear();
  bool empty() const { return !filled && lists.empty(); }
  /// Histories have been put aside since clear(): the same on all ranks.
  bool holds_last_lists() const { return filled; }

  // ---- particles under way ---------------------------------------------------------------------

  /// Of owned particles: contacts that they brought, and those of others than spheres, see
  /// ContactMemory.
  ContactLists lists;
  static bool is_of_spheres(const ContactLists::Contact &one)
  {
    return one.partner > 0 && !(one.feature & ContactLists::of_shape);
  }

  /// An owned particle with all its contacts as a list (see ContactLists), for a message to its new
  /// rank. Returns the number of doubles.
  int pack(int atom, double *buffer);
  int unpack(int atom, const double *buffer);
  /// The same without the origin, for a restart file.
  int pack_list(int atom, double *buffer);
  int unpack_list(int atom, const double *buffer);
  /// Upper limits: of one list and of all (doubles).
  int list_size(int atom) const;
  int largest_list(int owned) const;
  /// The most contacts between spheres that one of the owned particles may have.
  int largest_count(int owned) const;
  /// The name of a particle out of a restart file, which has no contacts yet.
  void set_name(int atom, std::int64_t name);

  /// The same, one by one: the partner and the history.
  struct Contact {
    std::int64_t partner;
    HistoryValues history;
  };
  std::vector<Contact> contacts_of(int atom);
  void add(int atom, const Contact &one);

  // ---- into the new lists ----------------------------------------------------------------------

  /// `present` must stay until number().
  void open(const ParticleOrder &present, int threads);
  /// The same where particles have the slots that they had when histories were put aside: all contacts are found
  /// by slots, those with images of own particles as well, as each side has them. What is here stays; close()
  /// follows instead of number().
  void open_unmoved(const ParticleOrder &present);
  void close() { order = nullptr; }
  /// Of two slots of the present order. May be called by several threads.
  FoundHistory find(int a, int b) const
  {
    const int then_a = slot_then[a], then_b = slot_then[b];
    if ((then_a | then_b) >= 0) return find_by_slots(then_a, then_b);
    return find_of_atoms(order->atom_of_slot[a], order->atom_of_slot[b]);
  }
  /// Of two of LAMMPS' particles, before open() as well.
  FoundHistory find_of_atoms(int i, int j) const;
  /// Histories have been fetched: forgets them. From here on particles carry the present slots.
  void number(const ParticleOrder &present);

  double memory_usage() const;

 private:
  /// Since then contacts in lists are not its own.
  bool was_numbered_here(const Origin &o) const { return o.rank == me && o.slot >= 0; }
  bool was_here(const Origin &o) const { return filled && was_numbered_here(o); }
  bool is_in_list(int atom, const ContactLists::Contact &one) const
  {
    return is_of_spheres(one) && !was_numbered_here(origins[atom]);
  }
  FoundHistory find_by_slots(int a, int b) const;
  FoundHistory find_in(int c, int a, int b) const;
  template <class Visit> void for_each_chunk(Visit visit) const;
  int row_size(int slot) const;
  void count_followers();
  void list_followers();
  template <class Visit> void for_each_partner(int slot, Visit visit);
  void name_contacts(const ParticleOrder &order);
  void name_lists(int owned);
  HistoryValues values_of(const ContactLists::Contact &one) const;
  void add_message(int rank, std::int64_t first, std::int64_t second, const HistoryValues &history);
  int plain_slot(int atom) const;
  template <class Visit> void for_each_contact_of_slot(int slot, Visit visit);

  int me;
  int records = 1;

  // by local index
  std::vector<Origin> origins;
  std::vector<std::int32_t> owners;    // by ghost

  // contacts of the last lists, by the slots of then
  bool filled = false;
  Scope scope{false, false};
  int threads = 1;
  std::vector<SlotContacts> chunks;
  WorkPartition work;                          // which chunk has a contact
  std::vector<unsigned char> touched_image;    // contacts with images of own ones; empty if none
  NamedContacts named;                         // with ghosts, and of lists
  Messages messages;

  // only if particles may leave, by slot
  std::vector<std::int64_t> name_of_slot;        // negative: of a ghost
  std::vector<std::uint32_t> followers_begin;    // and the end of the last
  AlignedVector<int> followers;                  // partners that are not in the row of a slot
  bool followers_listed = false;
  int most_partners = 0;

  // while histories are fetched
  const ParticleOrder *order = nullptr;
  std::vector<int> slot_then;    // by present slot; -1: names may be needed
};

inline FoundHistory HistoryStore::find_in(int c, int a, int b) const
{
  const SlotContacts &chunk = chunks[c];
  if (chunk.histories.empty()) return {};
  const std::int64_t place = chunk.find(std::min(a, b), std::max(a, b)),
                     readable = place & ~(place >> 63);
  return {place >= 0, a < b, &chunk.histories, static_cast<std::size_t>(readable)};
}

inline FoundHistory HistoryStore::find_by_slots(int a, int b) const
{
  return find_in(work.chunk_with_pair(std::min(a, b), std::max(a, b)), a, b);
}

}    // namespace Talus

#endif
