/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix gravity with `-sf talus`: words and results of the style of LAMMPS, to rounding

   With a pair style of Talus the sums of the forces on a particle begin with its weight m g,
   wherever a step is made; see Weights. post_force() is left with the
   potential energy -sum m g.x, in steps that LAMMPS looks at, and with the weights of particles
   of a fix freeze, which have none in the sums: a fix freeze behind this one counts them.

   A magnitude or direction that is a variable is evaluated once in each step; in the records if
   its formula reads nothing but the time, see system/host/time_formula.h.
   Falls back to the methods of LAMMPS: reason_for_stock(). Errors: those of fix gravity.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(gravity/talus,FixGravityTalus);
// clang-format on
#else

#ifndef LMP_FIX_GRAVITY_TALUS_H
#define LMP_FIX_GRAVITY_TALUS_H

#include "fix_gravity.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixGravityTalus : public FixGravity, public Talus::SystemFix {
 public:
  FixGravityTalus(class LAMMPS *, int, char **);
  ~FixGravityTalus() override;
  void post_constructor() override;
  void init() override;
  void post_force(int) override;

  // SystemFix
  std::string needs_arrays() override { return reason; }
  std::string reason_for_stock() const override { return reason; }
  void complete_step() override;
  void exchange_state(Talus::StateExchange &x) override;

 private:
  std::shared_ptr<Talus::GranularSystem> system;
  std::string reason = "no run yet";    // for the methods of LAMMPS
  bigint evaluated_at = -1;             // step of the variables' values

  bool has_said = false;

  void say_where_it_differs();
  std::string find_reason();
  std::string reason_of_variables() const;
  bool acts_on_forces(class Fix *fix) const;
  std::string reason_of_fixes_before() const;
  bool some_frozen_move(int frozenbits) const;
  const double *acceleration();
  void evaluate();
};

}    // namespace LAMMPS_NS

#endif
#endif
