/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix freeze with `-sf talus`: the style of LAMMPS, which has nothing to do while particles are
   in the records: there, frozen particles have infinite mass. Their forces are zeroed, and
   summed before that, where LAMMPS looks at them.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(freeze/talus,FixFreezeTalus);
// clang-format on
#else

#ifndef LMP_FIX_FREEZE_TALUS_H
#define LMP_FIX_FREEZE_TALUS_H

#include "fix/motion/plain_style.h"
#include "fix_freeze.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixFreezeTalus : public FixFreeze, public Talus::SystemFix {
 public:
  FixFreezeTalus(LAMMPS *lmp, int narg, char **arg) :
      FixFreeze(lmp, narg, arg), system(Talus::GranularSystem::of(lmp))
  {
  }
  void post_constructor() override { restore_style(this, "freeze"); }
  void post_force(int) override { system->step().complete_step_of(*this); }

  // SystemFix
  std::string needs_arrays() override { return ""; }
  void complete_step() override { FixFreeze::post_force(0); }

 private:
  std::shared_ptr<Talus::GranularSystem> system;
};

}    // namespace LAMMPS_NS

#endif
#endif
