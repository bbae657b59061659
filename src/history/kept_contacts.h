// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact histories across a rebuild, where most particles stay on their rank: the touching pairs
// of the last lists with their histories, by the slots of then. Each particle carries along which
// slot it had. The history of a pair is found here if one of its particles was owned before and
// both were known, as owned particles or ghosts. A particle that leaves the rank takes its
// histories along as entries of PartnerLists, for pairs that no one there knew.
//
//   begin(), ContactHistory::keep() of every part,   the last lists are still there
//   finish()
//   pack() for each particle that leaves             while particles migrate
//   slot_named(), find()                             new lists are there
//
// Not for periodic boxes, where a rank may know several images of one particle.

#ifndef TALUS_HISTORY_KEPT_CONTACTS_H
#define TALUS_HISTORY_KEPT_CONTACTS_H

#include "base/aligned_vector.h"
#include "neighbors/work_partition.h"
#include "particles/particle_order.h"
#include "particles/record.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace Talus {

class KeptContacts {
 public:
  /// The touching pairs of one part of the work, in rows by their second slot, and within them by
  /// their first.
  struct Part {
    int first_row = 0;
    std::vector<std::uint32_t> rows;           ///< begin of each row below, and the end of the last
    AlignedVector<int> first;                  ///< sixteen more are there, and read, but not used
    AlignedVector<std::uint32_t> place;        ///< in the records; the same
    AlignedVector<Record> records, impacts;    ///< no impacts in scenes without them

    std::uint32_t row_begin(int second) const;
    std::uint32_t row_end(int second) const;
    /// Place of a pair, or -1.
    std::int64_t find(int first, int second) const;
  };

  /// Without `particles_may_leave`, pack(), slot_named() and most_contacts() know of nothing.
  void begin(const ParticleOrder &order, const WorkPartition &work, bool particles_may_leave);
  Part &part(int p) { return parts[p]; }
  int num_chunks() const { return static_cast<int>(parts.size()); }
  void finish(int threads);

  /// Forgets everything, and gives the memory back if it is much.
  void clear();

  /// Nothing has been kept since clear(): no slot has a meaning.
  bool empty() const { return !filled; }

  /// The largest number of contacts of an owned particle.
  int most_contacts() const { return most; }

  /// The owned particle of a slot leaves: packs its histories, as PartnerLists does with `values`
  /// numbers for each partner. Returns the number of doubles.
  int pack(int slot, int values, double *buffer);

  /// Slot of a particle that has left, by the tag it had; that of one that was a ghost as
  /// was_ghost(slot), which is negative; `unknown` of others.
  int slot_named(std::int64_t tag) const;
  static constexpr int unknown = -1;
  static constexpr int was_ghost(int slot) { return -2 - slot; }    // its own inverse

  /// What is known of two particles, given by slot, was_ghost(slot) or `unknown`. If nothing is,
  /// there are some records all the same: no branch, since nobody could foresee it.
  struct Found {
    bool known = false;
    bool by_a = true;    ///< as `a` sees it, else as `b` does
    const Record *record = &nothing, *impact = &nothing;
  };
  Found find(int a, int b) const { return (a | b) < 0 ? find_of_ghost(a, b) : find_of_owned(a, b); }

  double memory_usage() const;

 private:
  static constexpr Record nothing{};
  Found find_of_ghost(int a, int b) const;
  Found find_of_owned(int a, int b) const
  {
    const int first = std::min(a, b), second = std::max(a, b);
    const Part &part = parts[work.chunk_with_pair(first, second)];
    if (part.records.empty()) return {};
    const std::int64_t place = part.find(first, second), readable = place & ~(place >> 63);
    return {place >= 0, a < b, part.records.data() + readable,
            part.impacts.empty() ? &nothing : part.impacts.data() + readable};
  }
  bool is_of_own_range(int p, int first) const { return first >= work.range_of_chunk(p).begin; }
  template <class Visit> void for_each_pair(int p, bool of_own_first, Visit visit) const;
  template <class Visit> void for_each_chunk(Visit visit) const;
  template <class Visit> void for_each_follower(Visit visit) const;
  void list_followers();

  bool filled = false, may_leave = false, listed = false;
  int most = 0, threads = 1;
  std::vector<Part> parts;
  WorkPartition work;    // as it was

  // only if particles may leave, by slot
  std::vector<std::int64_t> tag;
  std::vector<std::uint32_t> followers_begin;    // and the end of the last
  AlignedVector<int> followers;                  // second slots of the pairs of each first one
  std::unordered_map<std::int64_t, int> slot_by_name;
};

/* Slots before the first row make a number beyond the last one. */

inline std::uint32_t KeptContacts::Part::row_begin(int second) const
{
  const std::size_t row = static_cast<std::uint32_t>(second - first_row);
  return row + 1 < rows.size() ? rows[row] : 0;
}

inline std::uint32_t KeptContacts::Part::row_end(int second) const
{
  const std::size_t row = static_cast<std::uint32_t>(second - first_row);
  return row + 1 < rows.size() ? rows[row + 1] : 0;
}

/* Hardly a row is longer than eight; whether it has the pair nobody can foresee. */

inline std::int64_t KeptContacts::Part::find(int wanted, int second) const
{
  std::uint32_t begin = row_begin(second);
  const std::uint32_t end = row_end(second);
  std::uint32_t n = begin + find_of_eight(&first[begin], wanted);
  for (; end - begin > 8 && n == begin + 8; n = begin + find_of_eight(&first[begin], wanted))
    begin += 8;
  return std::int64_t{place[n]} | -static_cast<std::int64_t>(n >= end);
}

}    // namespace Talus

#endif
