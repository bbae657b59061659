// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact history of the candidate pairs during a run: a row of numbers (see HistoryRows) for each
// pair that touches, seen from the first particle of the pair. Half of the candidates or more do
// not touch: the rows stand side by side in the order in which the contacts were found, so nearly
// in that of the pairs, and each pair has the index of its row.

#ifndef TALUS_HISTORY_CONTACT_HISTORY_H
#define TALUS_HISTORY_CONTACT_HISTORY_H

#include "history/history_store.h"
#include "neighbors/pair_list.h"

#include <cstdint>
#include <vector>

namespace Talus {

class ContactHistory {
 public:
  /// After a rebuild: takes the history of each pair out of the store, which is open. Pairs that
  /// it does not know start at zero.
  void fetch(const PairList &pairs, const HistoryStore &store);

  /// Before pairs are renumbered: moves all histories to `to`, and has none until fetch(). With
  /// `as_copy`, for a restart file, both have them. May run for different chunks of a rank at the
  /// same time.
  void put_aside(const PairList &pairs, SlotContacts &to, bool as_copy);

  /// Releases all memory: for scenes whose laws keep no history.
  void release();

  /// Which of the pairs 8 block ... 8 block + 7 touch from now on, as bits: histories of new
  /// contacts begin at zero, those of pairs that have separated are forgotten.
  void set_touching(std::int64_t block, unsigned bits)
  {
    if (touching[block] != bits) change(block, bits);
  }

  unsigned touching_bits(std::int64_t block) const { return touching[block]; }
  /// Not after release().
  bool is_kept() const { return !touching.empty(); }
  bool touches(std::int64_t pair) const { return touching[pair / 8] >> (pair % 8) & 1U; }
  /// Of a pair that touches.
  Record &record(std::int64_t pair, int k = 0) { return rows.record(places[pair], k); }
  const Record &record(std::int64_t pair, int k = 0) const { return rows.record(places[pair], k); }
  HistoryValues values(std::int64_t pair) const { return rows.values(places[pair]); }
  void set_values(std::int64_t pair, const HistoryValues &values)
  {
    rows.set_values(places[pair], values);
  }
  /// Of each pair.
  int num_records() const { return rows.records(); }

  /// Where the numbers of a pair that touches stand in all_records(k), by pair.
  const std::uint32_t *all_places() const { return places.data(); }
  Record *all_records(int k = 0) { return rows.all(k); }

  double memory_usage() const;

 private:
  void begin(std::int64_t pair);
  void change(std::int64_t block, unsigned bits);

  AlignedVector<std::uint8_t> touching;    // one bit for each pair
  AlignedVector<std::uint32_t> places;     // by pair, valid if it touches
  HistoryRows rows;                        // by place
  AlignedVector<std::uint32_t> vacant;     // places of pairs that have separated
};

}    // namespace Talus

#endif
