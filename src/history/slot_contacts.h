// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contacts of one work chunk with their histories, found by the slots (see ParticleOrder) of
// their two particles: what ContactHistory::put_aside() makes of the pairs of a chunk, and
// HistoryStore keeps until there are new pairs.

#ifndef TALUS_HISTORY_SLOT_CONTACTS_H
#define TALUS_HISTORY_SLOT_CONTACTS_H

#include "base/aligned_vector.h"
#include "base/simd.h"
#include "history/history_rows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

/// Rows by the second slot of the pairs, and within a row in ascending order of the first slot.
struct SlotContacts {
  /// row_entries() may be read this far beyond the last one.
  static constexpr std::size_t ahead = 16;

  int first_row = 0;                     ///< second slot of the first row
  std::vector<std::uint32_t> rows;       ///< begin of each row below, and the end of the last
  AlignedVector<int> first;              ///< `ahead` more than there are contacts
  AlignedVector<std::uint32_t> place;    ///< in the histories; the same
  HistoryRows histories;

  struct Contact {
    int first, second;
    std::uint32_t place;
  };
  std::vector<Contact> with_ghost;    ///< those of which one particle is a ghost

  std::uint32_t row_begin(int second) const;
  std::uint32_t row_end(int second) const;
  /// Place of the history of a pair, or -1.
  std::int64_t find(int first, int second) const;
  /// visit(first, second) for all contacts.
  template <class Visit> void for_each(Visit visit) const;

  double memory_usage() const;
};

/* Slots before the first row make a number beyond the last one. */

inline std::uint32_t SlotContacts::row_begin(int second) const
{
  const std::size_t row = static_cast<std::uint32_t>(second - first_row);
  return row + 1 < rows.size() ? rows[row] : 0;
}

inline std::uint32_t SlotContacts::row_end(int second) const
{
  const std::size_t row = static_cast<std::uint32_t>(second - first_row);
  return row + 1 < rows.size() ? rows[row + 1] : 0;
}

/* Hardly a row is longer than eight; whether it has the pair is unpredictable. */

inline std::int64_t SlotContacts::find(int wanted, int second) const
{
  std::uint32_t begin = row_begin(second);
  const std::uint32_t end = row_end(second);
  std::uint32_t n = begin + find_of_eight(&first[begin], wanted);
  for (; end - begin > 8 && n == begin + 8; n = begin + find_of_eight(&first[begin], wanted))
    begin += 8;
  return std::int64_t{place[n]} | -static_cast<std::int64_t>(n >= end);
}

template <class Visit> void SlotContacts::for_each(Visit visit) const
{
  for (std::size_t row = 0; row + 1 < rows.size(); row++)
    for (std::uint32_t e = rows[row]; e < rows[row + 1]; e++)
      visit(first[e], first_row + static_cast<int>(row));
}

inline double SlotContacts::memory_usage() const
{
  return static_cast<double>(sizeof(std::uint32_t) * (rows.capacity() + place.capacity()) +
                             sizeof(int) * first.capacity() +
                             sizeof(Contact) * with_ghost.capacity()) +
         histories.memory_usage();
}

/// What is known of a pair of particles a and b. If nothing is, there is a row to read all the same:
/// no branch, since it would be mispredicted.
struct FoundHistory {
  bool known = false;
  bool by_a = true;    ///< the history is as `a` sees it, else as `b` does
  const HistoryRows *rows = &none();
  std::size_t row = 0;

  HistoryValues seen_by_a() const { return by_a ? rows->values(row) : mirrored(rows->values(row)); }
  /// A row of zeros.
  static const HistoryRows &none()
  {
    static const HistoryRows rows = [] {
      HistoryRows zero;
      zero.add();
      return zero;
    }();
    return rows;
  }
};

}    // namespace Talus

#endif
