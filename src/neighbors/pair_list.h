// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The broad phase as the kernels want it: the pairs that may touch before the next rebuild as a
// flat list of slots (first[c] < second[c], see ParticleOrder), sorted by second and then first.
// Working through it in order adds the forces on every particle in ascending order of its
// partners, on every rank and every thread; and whatever a pair needs has been touched lately or
// stands next in memory, apart from few pairs whose members stand far from each other.

#ifndef TALUS_NEIGHBORS_PAIR_LIST_H
#define TALUS_NEIGHBORS_PAIR_LIST_H

#include "base/aligned_vector.h"
#include "neighbors/pair_rows.h"
#include "particles/particle_order.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class PairList {
 public:
  /// At a rebuild, after order.arrange() and order.divide(): the pairs that belong to `part`.
  /// `order` must live as long as this list. Throws what require_countable() throws. May be
  /// called for different parts at the same time.
  void collect(const ParticleOrder &order, const PairRows &rows, int part);

  /// Contacts are numbered with 32 bits, to halve the traffic of their list: throws
  /// std::length_error if `pairs` are too many for that.
  static void require_countable(std::int64_t pairs);

  /// Without two phases, before the first step: first particles of other parts are read where these
  /// copy their states for others: at copy_of_slot[slot] for each of `foreign`.
  void read_copies(const std::vector<int> &copy_of_slot);
  /// By pair: where the state of the first particle is read.
  const int *state_of_first() const
  {
    return copy_of_first.empty() ? first.data() : copy_of_first.data();
  }

  /// Index of the pair of two slots, or -1.
  std::int64_t find(int slot_a, int slot_b) const;

  /// The slot is of this part.
  bool serves(int slot) const { return particles->part(slot) == part; }
  /// This part computes the force of its pairs on that slot, if it is owned.
  bool acts_on(int slot) const { return !particles->in_two_phases() || serves(slot); }
  /// The pair is counted here; in two phases other parts of this rank may compute it as well.
  bool counts(std::int64_t pair) const
  {
    return acts_on(first[pair]) || particles->part(first[pair]) == ParticleOrder::no_chunk;
  }
  /// Members of these pairs are in other parts.
  bool shared() const { return particles->num_chunks() > 1; }
  /// Forces on first particles of other parts are handed over to them: see OutgoingForces.
  bool hands_over() const { return part > 0 && !particles->in_two_phases(); }
  /// Pairs of this kind, in ascending order.
  const std::vector<std::uint32_t> &handed_over() const { return crossing; }

  /// Where forces on a slot are added: there, or if this part does not want them behind the last
  /// particle.
  std::size_t nowhere() const { return particles->nowhere(part); }
  struct ToAll {
    static constexpr bool keeps(int) { return true; }
    std::size_t operator()(int slot) const { return slot; }
  };
  /// Second particles there; first ones there or, before `begin`, handed over.
  struct ToFollowers {
    int begin;
    std::size_t operator()(int slot) const { return slot; }
    bool keeps(int slot) const { return slot >= begin; }
  };
  struct ToRange {
    static constexpr bool keeps(int) { return true; }
    int begin;
    unsigned size;
    std::size_t nowhere;
    std::size_t operator()(int slot) const
    {
      return static_cast<unsigned>(slot - begin) < size ? static_cast<std::size_t>(slot) : nowhere;
    }
  };
  struct ToPart {
    static constexpr bool keeps(int) { return true; }
    const std::uint16_t *chunk_of_slot;
    int part;
    std::size_t nowhere;
    std::size_t operator()(int slot) const
    {
      return chunk_of_slot[slot] == part ? static_cast<std::size_t>(slot) : nowhere;
    }
  };
  /// Calls work(target) with the cheapest of these that will do.
  template <class Work> void with_target(Work work) const
  {
    const ParticleOrder::Range its = slots();
    if (hands_over()) return work(ToFollowers{its.begin});
    if (!particles->in_two_phases() || particles->runs_alone_first(part)) return work(ToAll{});
    if (particles->may_fill_range(part))
      return work(ToRange{its.begin, static_cast<unsigned>(its.end - its.begin), nowhere()});
    work(ToPart{particles->chunk_of_slots(), part, nowhere()});
  }

  int which() const { return part; }
  /// Where the slots of this part are.
  ParticleOrder::Range slots() const { return particles->range(part); }

  const ParticleOrder &order() const { return *particles; }
  std::int64_t num_pairs() const { return static_cast<std::int64_t>(first.size()); }
  bool weighted() const { return !weights.empty(); }
  double memory_usage() const;

  AlignedVector<int> first, second;
  std::vector<double> weights;    ///< scale of the force; empty if every scale is 1
  /// Particles that will not be in a cache of 1 MB when a pair comes, in ascending order of the
  /// pairs: first ones that have left it, and those of other parts where they come first. `slot`
  /// is where the state is read.
  struct Distant {
    std::uint32_t pair;
    int slot;
  };
  std::vector<Distant> distant;
  /// Slots of other parts that these pairs read, in ascending order; in two phases not those of
  /// ghosts, which are in none.
  std::vector<int> foreign;

 private:
  void make_room(std::int64_t count, bool weighted);
  void take_rows(const PairRows &rows);
  void take_served(const PairRows &rows);
  void look_around();
  void look_back();

  const ParticleOrder *particles = nullptr;
  int part = 0;
  std::vector<std::uint32_t> crossing;
  AlignedVector<int> copy_of_first;    // empty if all are read where they are
};

}    // namespace Talus

#endif
