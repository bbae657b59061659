// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The canonical order of the particles of a rank, owned and ghosts ("slots"), and which part of the
// rank's work computes the forces on each of them.

#ifndef TALUS_PARTICLES_PARTICLE_ORDER_H
#define TALUS_PARTICLES_PARTICLE_ORDER_H

#include "base/aligned_vector.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace Talus {

class PairRows;
struct NeighborView;

class ParticleOrder {
 public:
  /// At a rebuild: puts all particles into the order of (key, tag); images of one particle keep the
  /// order of the host. The arrays are in the host's numbering: owned particles 0 ... num_owned-1,
  /// then ghosts. All forces are then computed by part 0. Particles that are in order already, or
  /// nearly, cost least.
  void arrange(int num_owned, const std::vector<std::uint64_t> &key,
               std::vector<std::int64_t> tag_of_atom, int threads = 1);

  /// Divides the particles for `threads` threads, into ranges of the order.
  ///
  /// Without `two_phases` into one range for each thread and, between those of two threads, a few
  /// small ones for whichever of them has the time: see for_each_wanted(). Ghosts are in the parts
  /// as well. Pairs belong to the part of their second particle.
  ///
  /// With `two_phases` into ranges with about the same number of pairs, and each of them into
  /// owned particles without any ghost partner (parts 0 ... threads-1) and the others (parts
  /// threads ... 2 threads-1). Ghosts are in none. Pairs belong to the parts of both.
  void divide(const PairRows &rows, int threads, bool two_phases);

  /// visit(part) for the parts that a thread may do, the most wanted first: its own one, then small
  /// ones by distance. All parts in ascending order if one thread after the other claims its own.
  template <class Visit> void for_each_wanted(int thread, Visit visit) const
  {
    const int home = thread * (1 + 2 * small_chunks);
    visit(home);
    for (int d = 1; d <= 2 * small_chunks; d++) {
      if (home + d < parts) visit(home + d);
      if (home - d > 0) visit(home - d);
    }
  }

  /// Slots are counted with an int, like the host's particles: throws std::length_error if there
  /// are too many.
  static void require_countable(std::size_t particles);

  bool is_owned(int atom) const { return atom < owned; }
  int size() const { return static_cast<int>(atom_of_slot.size()); }
  int num_chunks() const { return parts; }
  /// Part of a slot; in two phases no_chunk for ghosts.
  int part(int slot) const { return parts == 1 ? 0 : chunk_of_slot[slot]; }
  /// One of the parts to which a pair belongs; no_chunk for two ghosts in two phases.
  int chunk_with_pair(int first, int second) const
  {
    return part(second) != no_chunk ? part(second) : part(first);
  }
  const std::uint16_t *chunk_of_slots() const
  {
    return parts == 1 ? nullptr : chunk_of_slot.data();
  }
  /// Slots of a part are within this range, in ascending order; unless in two phases, they are all
  /// that are in it, and the parts follow each other.
  struct Range {
    int begin, end;
  };
  Range range(int part) const { return parts == 1 ? Range{0, size()} : range_of_chunk[part]; }
  /// All slots divided among the threads: with its own part and, without two phases, the nearer
  /// half of the small ones.
  Range range_of_thread(int thread) const;
  bool in_two_phases() const { return two_phases; }

  /// Every part has a place behind the slots for unused results, in a cache line of its own if
  /// an entry takes half a line: of entries that begin at a line and are `num_places()` in all.
  std::size_t nowhere(int part) const { return (std::size_t(size()) + 1) / 2 * 2 + 2UL * part; }
  std::size_t num_places() const { return nowhere(parts); }

  /// With two phases: slots that are not of a part, but second ones of pairs with first ones that
  /// are; in ascending order.
  const std::vector<int> &rows_beyond(int part) const { return beyond[part]; }

  /// 1/2 for a pair with a ghost, which another rank computes as well, else 1.
  double share(int slot_a, int slot_b) const
  {
    return is_owned(atom_of_slot[slot_a]) && is_owned(atom_of_slot[slot_b]) ? 1.0 : 0.5;
  }
  /// The only part that runs before the others: what it adds to their particles is cleared before
  /// they start, see ContactPipeline.
  bool runs_alone_first(int part) const { return two_phases && parts == 2 && part == 0; }
  /// Forces that a part adds to slots of its range which are not its own do no harm: they are
  /// ghosts, or of a part that runs later and is cleared before. Those of no other part of the same
  /// phase are within it.
  bool may_fill_range(int part) const { return !two_phases || part < parts / 2; }
  double memory_usage() const;

  static constexpr int no_chunk = 0xffff, max_threads = 0x2fff;

  int owned = 0;                    ///< host's indices below this are owned by this rank
  std::vector<std::int64_t> tag;    ///< by host's index, as of the rebuild
  std::vector<int> atom_of_slot;    ///< slot -> host's index
  std::vector<int> slot_of_atom;    ///< host's index -> slot

 private:
  using Work = AlignedVector<int>;             // by slot
  using Sums = std::vector<std::int64_t>;      // of the slots of each thread
  using Flags = std::vector<unsigned char>;    // by slot
  Sums sums_of(const Work &work, int threads) const;
  void assign_phases(const Work &work, const Flags &late, int threads);
  void assign_ranges(const Work &work, int threads);
  void find_rows_beyond(const NeighborView &neighbors, int threads);

  /// On either side of the border between the ranges of two threads, and how much of the work of a
  /// thread each of them is.
  static constexpr int small_chunks = 1;
  static constexpr double small_chunk = 0.05;

  int parts = 1;
  bool two_phases = false;
  std::vector<std::uint16_t> chunk_of_slot;    // empty if there is one part only
  std::vector<Range> range_of_chunk;
  std::vector<std::vector<int>> beyond;    // by part; empty without two phases
};

}    // namespace Talus

#endif
