// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact history of the candidate pairs during a run: one record for each pair that touches, seen
// from the first particle of the pair; and a second one, the impact of the contact, in scenes with a
// law that needs it. Half of the candidates or more do not touch: the records stand side by side
// in the order in which the contacts were found, so nearly in that of the pairs, and each pair
// knows its place.

#ifndef TALUS_HISTORY_CONTACT_HISTORY_H
#define TALUS_HISTORY_CONTACT_HISTORY_H

#include "history/kept_contacts.h"
#include "history/partner_lists.h"
#include "neighbors/pair_list.h"
#include "particles/record.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace Talus {

/// Where histories are while pairs are numbered anew, by host's index. `partners` are the lists of
/// owned particles, and `name` is how these lists call each particle, 0 if it is in none: it
/// differs from the tag if IDs were renumbered since. `kept`, if not empty, is asked first;
/// `kept_slot` of owned particles is the slot that they had, -1 if they came from elsewhere: these
/// and ghosts are looked up by name.
struct FiledHistories {
  const PartnerLists &partners;
  const std::vector<std::int64_t> &name;
  const KeptContacts &kept;
  const std::vector<int> &kept_slot;

  /// As KeptContacts::find() takes it.
  int slot_then(int atom, bool is_owned) const
  {
    return is_owned && kept_slot[atom] >= 0 ? kept_slot[atom] : kept.slot_named(name[atom]);
  }
};

class ContactHistory {
 public:
  /// After a rebuild: takes the history of each pair from wherever it is. Pairs without history
  /// start at zero. Onsets are kept if the lists have 8 values. `slots_then` (by slot):
  /// FiledHistories::slot_then() of every particle; not needed if nothing is kept.
  void fetch(const PairList &pairs, const FiledHistories &filed,
             const std::vector<int> &slots_then);

  /// Before pairs are numbered anew: hands all histories over, and has none until fetch(). May run
  /// for different parts of a rank at the same time.
  void keep(const PairList &pairs, KeptContacts::Part &part);

  /// Before particles are renumbered: the history of every touching pair is filed under each of its
  /// owned particles (see PartnerLists). First announce(), then PartnerLists::layout(), then
  /// file(); each may run for the chunks of one phase at the same time, and files under particles
  /// of their ranges. For first particles of other ranges, one chunk after the other: the same with
  /// _foreign, after it.
  void announce(const PairList &pairs, PartnerLists &partners) const;
  void announce_foreign(const PairList &pairs, PartnerLists &partners) const;
  void file(const PairList &pairs, PartnerLists &partners) const;
  void file_foreign(const PairList &pairs, PartnerLists &partners) const;

  /// After file(): pairs whose first particle is a ghost take over the history that its owner has
  /// filed, which ghost_values(host's index of the first, tag of the second) returns or nullptr.
  void
  adopt_first_copies(const PairList &pairs, PartnerLists &partners,
                     const std::function<const double *(int, std::int64_t)> &ghost_values) const;

  /// Gives all memory back: for scenes whose laws keep no history.
  void release();

  /// Which of the pairs 8 block ... 8 block + 7 touch from now on, as bits: histories of new
  /// contacts begin at zero, those of pairs that have separated are forgotten.
  void set_touching(std::int64_t block, unsigned bits)
  {
    if (touching[block] != bits) change(block, bits);
  }

  bool touches(std::int64_t pair) const { return touching[pair / 8] >> (pair % 8) & 1U; }
  /// Of a pair that touches.
  Record &record(std::int64_t pair) { return records[places[pair]]; }
  const Record &record(std::int64_t pair) const { return records[places[pair]]; }
  Record &impact(std::int64_t pair) { return impacts[places[pair]]; }
  const Record &impact(std::int64_t pair) const { return impacts[places[pair]]; }
  bool with_impacts() const { return impact_kept; }

  /// Where the record of a pair that touches stands in all_records(), by pair.
  const std::uint32_t *all_places() const { return places.data(); }
  Record *all_records() { return records.data(); }
  Record *all_impacts() { return impacts.data(); }

  double memory_usage() const;

 private:
  template <class Find> void fill(const PairList &pairs, Find find);
  void begin(std::int64_t pair);
  void change(std::int64_t block, unsigned bits);
  template <class Visit> void for_each_end(const PairList &pairs, Visit visit) const;
  template <class Visit> void for_each_foreign(const PairList &pairs, Visit visit) const;
  void file_end(const PairList &pairs, PartnerLists &partners, std::int64_t pair,
                bool of_first) const;

  bool impact_kept = false;
  AlignedVector<std::uint8_t> touching;      // one bit for each pair
  AlignedVector<std::uint32_t> places;       // by pair, valid if it touches
  AlignedVector<Record> records, impacts;    // by place
  AlignedVector<std::uint32_t> vacant;       // places of pairs that have separated
};

}    // namespace Talus

#endif
