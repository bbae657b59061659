// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which neighbor lists a LAMMPS instance has at present, and the box in which they were made. Snapshots
// ask whether these are still those of then.

#ifndef TALUS_SYSTEM_STEP_NEIGHBOR_LISTS_H
#define TALUS_SYSTEM_STEP_NEIGHBOR_LISTS_H

#include "lmptype.h"
#include "pointers.h"

#include <array>

namespace Talus {

/// The simulation box: corners and tilt.
struct DomainBox {
  std::array<double, 3> low{}, high{}, tilt{};    ///< tilt: xy, xz, yz

  static DomainBox of(const LAMMPS_NS::Domain &domain);
  void give_to(LAMMPS_NS::Domain &domain) const;
};

class NeighborLists : protected LAMMPS_NS::Pointers {
 public:
  explicit NeighborLists(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// Lists have just been made: the first ones, or others than before.
  void are_new();
  /// They are again those that had this number.
  void are_again(LAMMPS_NS::bigint number) { present = number; }
  /// 0: there are none.
  LAMMPS_NS::bigint number() const { return present; }
  const DomainBox &box() const { return box_then; }

 private:
  LAMMPS_NS::bigint present = 0, last = 0;
  DomainBox box_then;
};

}    // namespace Talus

#endif
