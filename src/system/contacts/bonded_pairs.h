// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pairs that do not touch as long as they are bonded (special_bonds with a factor for 1-2 that is not 1): where a bond
// breaks, or is made, between two rebuilds LAMMPS changes its neighbor lists in place, and the pairs of Talus follow.

#ifndef TALUS_SYSTEM_CONTACTS_BONDED_PAIRS_H
#define TALUS_SYSTEM_CONTACTS_BONDED_PAIRS_H

#include "lmptype.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

class GranularSystem;

class BondedPairs {
 public:
  BondedPairs(LAMMPS_NS::LAMMPS *its_lmp, GranularSystem &owner) : lmp(its_lmp), system(owner) {}

  /// Before the contacts of a step are computed, behind the fixes that change neighbor lists: takes pairs from the lists
  /// again if bonds are others than at the last call of are_used(). Contacts go on. Of one rank alone.
  void follow_bonds();
  /// After it: pairs are those of the present bonds.
  void are_used();

 private:
  struct Bonds {
    int all = 0,
        broken = 0;    ///< of the list of LAMMPS, which keeps broken ones until the next rebuild
    bool operator==(const Bonds &other) const { return all == other.all && broken == other.broken; }
  };
  Bonds present_bonds() const;

  LAMMPS_NS::LAMMPS *lmp;
  GranularSystem &system;
  Bonds now, used;
  LAMMPS_NS::bigint lists_used = 0;    ///< their number
};

}    // namespace Talus

#endif
