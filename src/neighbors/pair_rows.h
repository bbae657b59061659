// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The pairs of a half neighbor list as the canonical order has them: in rows by their second slot,
// and in these by their first one. Lists of NeighborSearch have them so, or nearly: of most pairs
// the row is known without a look at any other. Those in the row of their first particle are turned
// round: sorted by their second one, by all threads.

#ifndef TALUS_NEIGHBORS_PAIR_ROWS_H
#define TALUS_NEIGHBORS_PAIR_ROWS_H

#include "base/aligned_vector.h"
#include "neighbors/neighbor_view.h"
#include "particles/particle_order.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class PairRows {
 public:
  /// At a rebuild, after order.arrange(). Both must live as long as this.
  PairRows(const ParticleOrder &order, const NeighborView &neighbors, int threads = 1);

  int num_slots() const { return order.size(); }
  /// Number of pairs with that second slot.
  int size(int second) const { return sizes[second]; }
  /// The force of at least one pair is scaled by something else than 1.
  bool weighted() const { return with_weights; }

  /// Writes the first slots of a row, in ascending order, and unless nullptr the scales of the
  /// forces.
  void copy(int second, int *firsts, double *weights) const;

  /// visit(slot) for every owned particle that has a pair with a ghost, once for each such pair.
  template <class Visit> void for_each_beside_ghosts(Visit visit) const
  {
    for (const auto &slots : beside_ghosts) std::for_each(slots.begin(), slots.end(), visit);
  }

  /// visit(first, scale) for the pairs of a row, in the order of the list.
  template <class Visit> void for_each(int second, Visit visit) const
  {
    const int atom = order.atom_of_slot[second];
    int left = size(second);    // and once it is zero, there is nothing to look for elsewhere
    const auto take = [&](int entry) {
      const double scale = scaled ? view.scale_of(entry) : 1.0;
      const int first = slot_of(entry);
      if (first > second || scale == 0.0) return;
      visit(first, scale);
      left--;
    };
    if (has_row(atom))
      for (int n = 0; n < view.size[atom]; n++) take(view.entries[atom][n]);
    if (left == 0) return;
    const int range = range_of(second);
    const Reversed &of_range = reversed[range];
    const std::size_t row = second - range_begin(range);
    for (std::size_t n = of_range.begin[row]; n < of_range.begin[row + 1]; n++)
      take(of_range.entries[n]);
  }

 private:
  /// Pairs as entries of rows where the list does not have them, of the seconds in one range.
  struct Reversed {
    std::vector<std::size_t> begin;    // of each row and the end of the last
    AlignedVector<int> entries;
  };
  struct Found {
    int second, entry;
  };
  using Finds = std::vector<std::vector<Found>>;    // by range of the second

  bool has_row(int atom) const { return listed.empty() || listed[atom]; }
  int slot_of(int entry) const { return order.slot_of_atom[entry & view.index_mask]; }
  int range_begin(int range) const
  {
    return static_cast<int>(std::int64_t{num_slots()} * range / ranges);
  }
  int range_of(int slot) const
  {
    return static_cast<int>(((slot + std::int64_t{1}) * ranges - 1) / num_slots());
  }
  void look_through(int range, Finds &finds);
  void take_reversed(int range, const std::vector<Finds> &finds);

  const ParticleOrder &order;
  const NeighborView view;
  const int ranges;    // of slots, one for each thread
  const bool scaled;
  std::atomic<bool> with_weights{false};
  std::vector<unsigned char> listed;    // by local index: has a row; empty if all have
  AlignedVector<int> sizes;             // by slot
  std::vector<Reversed> reversed;       // by range; empty if no pair is
  std::vector<std::vector<int>> beside_ghosts;
};

}    // namespace Talus

#endif
