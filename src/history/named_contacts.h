// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of contacts by the names of their two particles, for those that slots do not tell: a
// hash table with open addressing. A pair of names has one contact at most, whichever images of its
// particles touch.

#ifndef TALUS_HISTORY_NAMED_CONTACTS_H
#define TALUS_HISTORY_NAMED_CONTACTS_H

#include "base/aligned_vector.h"
#include "history/slot_contacts.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class NamedContacts {
 public:
  bool empty() const { return keys.empty(); }
  std::size_t size() const { return keys.size(); }

  /// Forgets all. Keeps the memory for the next ones.
  void clear();
  /// Records of each contact, see HistoryRows::keep().
  void keep(int records) { histories.keep(records); }

  /// Room for so many without a change of the table: optional.
  void reserve(std::size_t contacts);

  /// The history as `a` sees it. Takes the place of what is there of this pair.
  void insert(std::int64_t a, std::int64_t b, const HistoryValues &history);

  /// Valid until the next insert() or clear().
  FoundHistory find(std::int64_t a, std::int64_t b) const;

  double memory_usage() const;

 private:
  struct Key {
    std::int64_t low, high;
    bool operator==(const Key &o) const { return low == o.low && high == o.high; }
  };
  static Key key_of(std::int64_t a, std::int64_t b) { return a < b ? Key{a, b} : Key{b, a}; }
  std::size_t cell_of(const Key &key) const;
  void grow(std::size_t contacts);

  AlignedVector<Key> keys;
  HistoryRows histories;                 // as the lower name sees them
  AlignedVector<std::uint32_t> cells;    // 1 + index of the contact, 0: free; 2^n of them
};

}    // namespace Talus

#endif
