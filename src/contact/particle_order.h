// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The canonical order of the particles of a rank, owned and ghosts ("slots"), and which part of the
// rank's work computes the forces on each of them.

#ifndef TALUS_CONTACT_PARTICLE_ORDER_H
#define TALUS_CONTACT_PARTICLE_ORDER_H

#include "contact/neighbour_view.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace Talus {

class ParticleOrder {
 public:
  /// At a rebuild: puts all particles into the order of (key, tag); images of one particle keep the
  /// order of the host. The arrays are in the host's numbering: owned particles 0 ... num_owned-1,
  /// then ghosts. All forces are then computed by part 0. Particles that are in order already, or
  /// nearly, cost least.
  void arrange(int num_owned, const std::vector<std::uint64_t> &key,
               std::vector<std::int64_t> tag_of_atom, int threads = 1);

  /// Divides the owned particles: `threads` ranges of the order with about the same number of
  /// pairs and, with `two_phases`, each of them into particles without any ghost partner (parts
  /// 0 ... threads-1) and the others (parts threads ... 2 threads-1). Ghosts are in none.
  void divide(const NeighbourView &neighbours, int threads, bool two_phases);

  /// Slots are counted with an int, like the host's particles: throws std::length_error if there
  /// are too many.
  static void require_countable(std::size_t particles);

  bool is_owned(int atom) const { return atom < owned; }
  int size() const { return static_cast<int>(atom_of_slot.size()); }
  int num_parts() const { return parts; }
  /// Part of a slot; no_part for ghosts, unless there is one part only.
  int part(int slot) const { return parts == 1 ? 0 : part_of_slot[slot]; }
  const std::uint16_t *part_of_slots() const { return parts == 1 ? nullptr : part_of_slot.data(); }
  /// Slots of a part are within this range, in ascending order; in part 0 alone they are all.
  struct Range {
    int begin, end;
  };
  Range range(int part) const { return parts == 1 ? Range{0, size()} : range_of_part[part]; }
  /// Those of all parts of a thread are within this one, and of no other thread.
  Range range_of_thread(int thread) const;
  bool in_two_phases() const { return two_phases; }

  /// Every part has a place behind the slots for what nobody wants, in a cache line of its own if
  /// an entry takes half a line: of entries that begin at a line and are `num_places()` in all.
  std::size_t nowhere(int part) const { return (std::size_t(size()) + 1) / 2 * 2 + 2UL * part; }
  std::size_t num_places() const { return nowhere(parts); }

  /// Rows of the neighbours that divide() has seen, in ascending order: all pairs of a part are in
  /// them.
  std::vector<Range> rows_of(const NeighbourView &neighbours, int part) const;

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

  static constexpr int no_part = 0xffff, max_threads = 0x7fff;

  int owned = 0;                    ///< host's indices below this are owned by this rank
  std::vector<std::int64_t> tag;    ///< by host's index, as of the rebuild
  std::vector<int> atom_of_slot;    ///< slot -> host's index
  std::vector<int> slot_of_atom;    ///< host's index -> slot

 private:
  using PairCounts = std::vector<std::vector<int>>;         // by slot, of several threads
  using Flags = std::vector<std::atomic<unsigned char>>;    // by slot, set by any thread
  using Sums = std::vector<std::int64_t>;                   // of the slots of each thread
  Sums add_counts(PairCounts &pairs, int threads) const;
  void assign_parts(PairCounts &pairs, const Flags &late, int threads);

  int parts = 1;
  bool two_phases = false;
  std::vector<std::uint16_t> part_of_slot;    // empty if there is one part only
  std::vector<Range> range_of_part;
  std::vector<Range> slots_of_block;    // of the pairs in some rows of the neighbours
};

}    // namespace Talus

#endif
