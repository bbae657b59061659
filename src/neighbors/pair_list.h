// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The result of the broad phase: the pairs that may touch before the next rebuild, as a flat list
// of slots (first[c] < second[c], see ParticleOrder), sorted by second and then first. Working
// through it in order adds the forces on every particle in ascending order of its partners, on
// every rank and every thread; and whatever a pair needs has been touched lately or stands next in
// memory, apart from few pairs whose members stand far from each other.

#ifndef TALUS_NEIGHBORS_PAIR_LIST_H
#define TALUS_NEIGHBORS_PAIR_LIST_H

#include "base/aligned_vector.h"
#include "neighbors/pair_rows.h"
#include "neighbors/work_partition.h"
#include "particles/particle_order.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class PairList {
 public:
  /// At a rebuild, after order.arrange(): the pairs of one chunk of the work. `order` and `work`
  /// must live as long as this list. Throws what require_countable() throws. May be called for
  /// different chunks at the same time.
  void collect(const ParticleOrder &order, const WorkPartition &work, const PairRows &rows,
               int chunk);

  /// Contacts are numbered with 32 bits, to halve the traffic of their list: throws
  /// std::length_error if `pairs` are too many for that.
  static void require_countable(std::int64_t pairs);

  /// Before the first step: first particles of other ranges are read where these copy their states
  /// for others: at copy_of_slot[slot] for each of `foreign`.
  void read_copies(const std::vector<int> &copy_of_slot);
  /// By pair: where the state of the first particle is read.
  const int *state_of_first() const
  {
    return copy_of_first.empty() ? first.data() : copy_of_first.data();
  }

  /// Index of the pair of two slots, or -1.
  std::int64_t find(int slot_a, int slot_b) const;

  /// These are pairs of the late phase: one particle of each is a ghost.
  bool is_late() const { return late; }
  /// Where the second slots of the pairs are.
  SlotRange slots() const { return range; }
  /// The first particle of a pair belongs to another range: one before this.
  bool is_foreign(int slot) const { return slot < range.begin; }
  /// The particle has contacts of the late phase as well.
  bool has_late(int slot) const { return work->in_two_phases() && work->is_late(slot); }
  /// Forces on that first or second particle, if it is owned, are deferred: see DeferredForces.
  bool defers(int slot) const { return is_foreign(slot) || has_late(slot); }
  /// Pairs with such a particle, in ascending order.
  const std::vector<std::uint32_t> &frontier() const { return at_frontier; }
  bool is_at_frontier(std::uint32_t pair) const
  {
    return frontier_bits[pair / 64] >> (pair % 64) & 1U;
  }
  /// How many of them are before that pair.
  std::uint32_t frontier_before(std::uint32_t pair) const
  {
    const std::uint64_t below = (std::uint64_t{1} << (pair % 64)) - 1;
    return before_word[pair / 64] +
           static_cast<std::uint32_t>(__builtin_popcountll(frontier_bits[pair / 64] & below));
  }
  /// One of these is among the pairs begin ... last.
  bool reaches_frontier(std::uint32_t begin, std::uint32_t last) const
  {
    return !at_frontier.empty() &&
           frontier_before(last) + is_at_frontier(last) > frontier_before(begin);
  }

  const ParticleOrder &order() const { return *particles; }
  std::int64_t num_pairs() const { return static_cast<std::int64_t>(first.size()); }
  bool weighted() const { return !weights.empty(); }
  double memory_usage() const;

  AlignedVector<int> first, second;
  std::vector<double> weights;    ///< scale of the force; empty if every scale is 1
  /// Particles that will not be in a cache of 1 MB when a pair comes, in ascending order of the
  /// pairs: first ones that have left it, those of other ranges where they come first, and of late
  /// pairs all. `slot` is where the state is read.
  struct Distant {
    std::uint32_t pair;
    int slot;
  };
  std::vector<Distant> distant;
  /// Slots of other ranges that these pairs read, in ascending order.
  std::vector<int> foreign;

 private:
  void make_room(std::int64_t count, bool weighted);
  void take_all(const PairRows &rows);
  void take_of_phase(const PairRows &rows);
  void find_frontier();
  void find_distant();

  const ParticleOrder *particles = nullptr;
  const WorkPartition *work = nullptr;
  SlotRange range;
  bool late = false;
  std::vector<std::uint32_t> at_frontier;
  // of 64 pairs each, if there is a frontier: which are at it, and how many of those before are
  std::vector<std::uint64_t> frontier_bits;
  std::vector<std::uint32_t> before_word;
  AlignedVector<int> copy_of_first;    // empty if all are read where they are
};

}    // namespace Talus

#endif
