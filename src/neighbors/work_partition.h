// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How the contact work of a rank is divided into chunks.
//
// For the threads the canonical order is cut into ranges of slots: a large one for each thread and,
// between those of two threads, a few small ones for whichever of them has the time. If the
// exchange of ghosts is overlapped with computation, the work has two phases as well: pairs of
// owned particles are of the early one, pairs with a ghost of the late one. A chunk is what one
// range has to do in one phase.
//
// Every pair belongs to exactly one chunk: of the range of its second slot. A force on a particle
// that a chunk must not add at once, because the particle belongs to another range or waits for
// contacts of the late phase, is deferred, see DeferredForces.

#ifndef TALUS_NEIGHBORS_WORK_PARTITION_H
#define TALUS_NEIGHBORS_WORK_PARTITION_H

#include "particles/particle_order.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace Talus {

class PairRows;

class WorkPartition {
 public:
  WorkPartition() = default;
  /// One chunk for all.
  explicit WorkPartition(const ParticleOrder &order) : ends{order.size()} {}
  /// At a rebuild, after order.arrange(): ranges of about the same number of pairs and particles.
  WorkPartition(const ParticleOrder &order, const PairRows &rows, int threads, bool two_phases);

  bool in_two_phases() const { return phases == 2; }
  int num_phases() const { return phases; }
  int num_ranges() const { return static_cast<int>(ends.size()); }
  int num_chunks() const { return phases * num_ranges(); }
  /// Chunks are numbered by phase, and in each phase by range.
  int chunk(int phase, int range) const { return phase * num_ranges() + range; }
  bool is_late_chunk(int chunk) const { return chunk >= num_ranges(); }

  /// Slots of a range: one range follows the other in the order of slots, ghosts included.
  SlotRange range(int r) const { return {r ? ends[r - 1] : 0, ends[r]}; }
  SlotRange range_of_chunk(int chunk) const { return range(chunk % num_ranges()); }
  int range_of(int slot) const
  {
    return static_cast<int>(std::upper_bound(ends.begin(), ends.end() - 1, slot) - ends.begin());
  }
  /// The chunk to which a pair belongs, if there is such a pair.
  int chunk_with_pair(int first, int second) const
  {
    const bool late = in_two_phases() && (is_ghost(first) || is_ghost(second));
    return chunk(late, range_of(second));
  }

  /// In two phases: the slot is a ghost.
  bool is_ghost(int slot) const { return role[slot] == GHOST; }
  /// In two phases: an owned particle with a ghost among its partners. All others have only
  /// contacts of the early phase.
  bool is_late(int slot) const { return role[slot] == LATE; }

  /// All slots divided among the threads: with the large range the nearer half of the small ones.
  SlotRange range_of_thread(int thread) const
  {
    const int home = thread * (1 + 2 * small_ranges);
    return {range(std::max(0, home - small_ranges)).begin,
            range(std::min(num_ranges() - 1, home + small_ranges)).end};
  }

  /// visit(range) for the ranges that a thread may do, the most wanted first: its own one, then
  /// small ones by distance. All in ascending order if one thread after the other claims its own.
  template <class Visit> void for_each_wanted(int thread, Visit visit) const
  {
    const int home = thread * (1 + 2 * small_ranges), ranges = num_ranges();
    visit(home);
    for (int d = 1; d <= 2 * small_ranges; d++) {
      if (home + d < ranges) visit(home + d);
      if (home - d > 0) visit(home - d);
    }
  }

  double memory_usage() const;

 private:
  enum Role : unsigned char { EARLY, LATE, GHOST };
  void cut(const ParticleOrder &order, const PairRows &rows, int threads);
  void assign_roles(const ParticleOrder &order, const PairRows &rows, int threads);

  /// On either side of the border between the ranges of two threads, and how much of the work of a
  /// thread each of them is.
  static constexpr int small_ranges = 1;
  static constexpr double small_share = 0.05;

  int phases = 1;
  std::vector<int> ends{0};    // of the ranges
  std::vector<Role> role;      // by slot; empty in one phase
};

}    // namespace Talus

#endif
