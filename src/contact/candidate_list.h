// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The broad phase as the kernels want it: particles in canonical order ("slots"), and the pairs
// that may touch before the next rebuild as a flat list of slots (first[c] < second[c]), sorted by
// first and then second. Working through it in order adds the forces on every particle in ascending
// order of its partners, on every rank.

#ifndef TALUS_CONTACT_CANDIDATE_LIST_H
#define TALUS_CONTACT_CANDIDATE_LIST_H

#include <cstdint>
#include <vector>

namespace Talus {

class CandidateList {
 public:
  /// Starts a rebuild: puts all particles into the order of (key, tag); images of one particle keep
  /// the order of the host. The arrays are in the host's numbering: owned particles 0 ...
  /// num_owned-1, then ghosts.
  void order_particles(int num_owned, const std::vector<std::uint64_t> &key,
                       std::vector<std::int64_t> tag_of_atom);

  /// Adds a pair in the host's numbering, once, in any orientation. `weight` scales its force.
  void add_pair(int i, int j, double weight);

  /// Ends the rebuild: sorts the pairs.
  void finish();

  /// Index of the pair of two slots, or -1.
  std::int64_t find(int slot_a, int slot_b) const;

  bool is_owned(int atom) const { return atom < owned; }
  int num_particles() const { return static_cast<int>(atom_of_slot.size()); }
  std::int64_t num_pairs() const { return static_cast<std::int64_t>(first.size()); }
  bool weighted() const { return !weights.empty(); }
  double memory_usage() const;

  int owned = 0;                    ///< host's indices below this are owned by this rank
  std::vector<std::int64_t> tag;    ///< by host's index, as of the rebuild
  std::vector<int> atom_of_slot;    ///< slot -> host's index
  std::vector<int> slot_of_atom;    ///< host's index -> slot
  std::vector<int> first, second;
  std::vector<double> weights;    ///< empty if every weight is 1

 private:
  struct Pair {
    int first, second;
    double weight;
  };
  std::vector<Pair> added;
  std::vector<std::int64_t> row_start;    ///< pairs of slot s: row_start[s] ... row_start[s+1]-1
};

}    // namespace Talus

#endif
