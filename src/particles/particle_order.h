// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The canonical order of the particles of a rank, owned and ghosts: each has a "slot".

#ifndef TALUS_PARTICLES_PARTICLE_ORDER_H
#define TALUS_PARTICLES_PARTICLE_ORDER_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

/// Slots begin ... end-1.
struct SlotRange {
  int begin = 0, end = 0;

  bool holds(int slot) const { return slot >= begin && slot < end; }
};

class ParticleOrder {
 public:
  /// At a rebuild: puts all particles into the order of (key, tag); images of one particle keep the
  /// order of LAMMPS. The arrays are in LAMMPS' numbering: owned particles 0 ... num_owned-1,
  /// then ghosts. Particles that are in order already, or nearly, cost least. Throws what
  /// require_countable() throws.
  void arrange(int num_owned, const std::vector<std::uint64_t> &key,
               std::vector<std::int64_t> tag_of_atom, int threads = 1);

  /// Slots are counted with an int, like LAMMPS' particles: throws std::length_error if there
  /// are too many.
  static void require_countable(std::size_t particles);

  int size() const { return static_cast<int>(atom_of_slot.size()); }
  bool is_owned(int atom) const { return atom < owned; }
  bool owns_slot(int slot) const { return is_owned(atom_of_slot[slot]); }

  /// 1/2 for a pair with a ghost, which another rank computes as well, else 1.
  double share(int slot_a, int slot_b) const
  {
    return owns_slot(slot_a) && owns_slot(slot_b) ? 1.0 : 0.5;
  }
  double memory_usage() const;

  int owned = 0;                    ///< local indices below this are owned by this rank
  std::vector<std::int64_t> tag;    ///< by local index, as of the rebuild
  std::vector<int> atom_of_slot;    ///< slot -> local index
  std::vector<int> slot_of_atom;    ///< local index -> slot
};

}    // namespace Talus

#endif
