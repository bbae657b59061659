// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The field of gravity, if a fix has registered one: the sums of forces on particles then start
// with their weights instead of 0. GranularSystem calls it in each step.

#ifndef TALUS_SYSTEM_STEP_WEIGHTS_H
#define TALUS_SYSTEM_STEP_WEIGHTS_H

#include "contact/contact_pipeline.h"

#include "pointers.h"

#include <functional>
#include <string>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;

class Weights : protected LAMMPS_NS::Pointers {
 public:
  Weights(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// In init() of a fix, after that of the pair style: from now on the sums of forces begin with
  /// the weights of the particles of its group. Returns "", or why the fix has to add them itself. `field`: the acceleration
  /// in the present step, nullptr if there is none; asked on all ranks.
  std::string take(const LAMMPS_NS::Fix *gravity, std::function<const double *()> field);
  /// The fix is going.
  void drop(const LAMMPS_NS::Fix *gravity);

  // ---- by the system

  /// The pair style is initialized: init() of the fix comes later.
  void forget() { fix = nullptr; }
  /// Before the sums of a step begin. Collective.
  void begin_step(ContactPipeline &particles);
  /// After a rebuild: which particles have none.
  void find_weightless(ContactPipeline &particles) const;

 private:
  GranularSystem &system;
  const LAMMPS_NS::Fix *fix = nullptr;
  std::function<const double *()> acceleration;    // if there is a fix
};

}    // namespace Talus

#endif
