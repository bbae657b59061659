// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The field of gravity, if a fix has registered one: the sums of forces on particles then start
// with their weights instead of 0. GranularSystem calls it in each step.

#ifndef TALUS_SYSTEM_STEP_WEIGHTS_H
#define TALUS_SYSTEM_STEP_WEIGHTS_H

#include "contact/contact_pipeline.h"
#include "system/host/system_fix.h"

#include "pointers.h"

#include <string>

namespace Talus {

class GranularSystem;

class Weights : protected LAMMPS_NS::Pointers {
 public:
  Weights(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// In init() of a fix, after that of the pair style: from now on the sums of forces begin with
  /// the weights. Returns "", or why the fix has to add them itself.
  std::string take(SystemGravity *gravity_fix);
  /// The fix is going.
  void drop(const SystemGravity *gravity_fix);

  // ---- by the system

  /// The pair style is initialized: init() of the fix comes later.
  void forget() { field = nullptr; }
  /// Before the sums of a step begin. Collective.
  void begin_step(ContactPipeline &particles);
  /// After a rebuild: which particles have none.
  void find_weightless(ContactPipeline &particles) const;

 private:
  GranularSystem &system;
  SystemGravity *field = nullptr;
};

}    // namespace Talus

#endif
