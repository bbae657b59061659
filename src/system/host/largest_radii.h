// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Largest radius of each particle type, present or yet to be inserted, for cutoffs. Frozen
// particles are kept apart: two frozen ones need not be neighbors.

#ifndef TALUS_SYSTEM_HOST_LARGEST_RADII_H
#define TALUS_SYSTEM_HOST_LARGEST_RADII_H

#include "pointers.h"

#include <algorithm>
#include <vector>

namespace Talus {
class ShapedParticles;
}

namespace LAMMPS_NS {

class LargestRadii : protected Pointers {
 public:
  explicit LargestRadii(LAMMPS *lmp) : Pointers(lmp) {}

  /// Looks at all particles of all ranks, at fixes pour and deposit, and at the types that have a
  /// shape, if any. Call in init_style().
  void find(int frozen_groups, const Talus::ShapedParticles *shapes);

  /// Distance at which particles of types i and j can touch.
  double cutoff(int i, int j) const;
  double largest() const;
  /// Of one type (length).
  double largest(int type) const { return std::max(free[type], frozen[type]); }
  double of_free(int type) const { return free[type]; }
  double of_frozen(int type) const { return frozen[type]; }

 private:
  void add_future(std::vector<double> &radius) const;

  std::vector<double> free, frozen;    // by type
};

}    // namespace LAMMPS_NS

#endif
