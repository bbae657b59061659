// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The pair style of Talus that a script has defined, and what place it has among those of LAMMPS. Questions are valid in
// init() of LAMMPS and after it.

#ifndef TALUS_SYSTEM_STEP_ATTACHED_PAIR_H
#define TALUS_SYSTEM_STEP_ATTACHED_PAIR_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {
class Pair;
}

namespace Talus {

class AttachedPair : protected LAMMPS_NS::Pointers {
 public:
  /// What a pair style demands of the system.
  struct Traits {
    std::string name;    ///< as scripts have it, for messages
    /// The Coulomb limit acts on stored displacements also while a run is set up, as in the stock
    /// styles; else histories are only read then.
    bool limits_at_setup = false;
    /// Runs also where two particles may touch on both sides of a period: with a warning, for the
    /// stock style does not tell these contacts apart either.
    bool allows_small_period = false;
  };

  explicit AttachedPair(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// By the system. set() with nullptr leaves the traits, for messages.
  void set(LAMMPS_NS::Pair *one) { pair = one; }
  void set_traits(const Traits &of) { style = of; }

  /// nullptr: none is attached.
  LAMMPS_NS::Pair *get() const { return pair; }
  bool is_there() const { return pair != nullptr; }
  /// Of the one that is attached, or the last one.
  const Traits &traits() const { return style; }
  const std::string &name() const { return style.name; }
  /// All pairs are computed by it: it is not part of hybrid, or the only one.
  bool is_alone() const;
  /// "" if it is computed in each step, alone or with other sub-styles, else why not, as text for
  /// messages.
  std::string reason_against() const;

 private:
  LAMMPS_NS::Pair *pair = nullptr;
  Traits style{"gran/penalty"};
};

}    // namespace Talus

#endif
