/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   What velocity Verlet for spheres with `-sf talus` is, in the place of the fix `Base` of LAMMPS, which has `inertia` and
   whose words and results it has, to rounding

     v += h F/m, x += dt v with the new v, forces at the new x, v += h F/m
     omega += h T/(c m r^2) with each kick           c = 2/5, with `disc` 1/2

   h = dt/2 times ftm2v, dt = update->dt. The kick that ends a step and the one that begins the
   next are made in one pass while particles are in the records, so that their velocities there
   are those of the half step; complete_step() or the final_integrate() of a step that is looked
   at completes them. The bits are the same wherever a step is made.

   Called by: Verlet::run() through Modify::initial_integrate() and final_integrate().
   Falls back to the methods of LAMMPS without a pair style of Talus, with words that it does not know
   and with run_style respa: reason_for_stock().
   Errors: those of `Base`.
------------------------------------------------------------------------- */

#ifndef LMP_SPHERE_VERLET_H
#define LMP_SPHERE_VERLET_H

#include "fix/motion/plain_style.h"
#include "system/step/granular_system.h"
#include "system/step/sphere_kicks.h"

#include "force.h"
#include "update.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

template <class Base> class SphereVerlet : public Base, public Talus::SystemFix {
 public:
  void post_constructor() override { restore_style(this, plain); }
  void init() override
  {
    Base::init();
    reason = find_reason();
  }
  void initial_integrate(int vflag) override
  {
    if (!reason.empty()) return Base::initial_integrate(vflag);
    system->step().advance(this, half_step());
  }
  /// Put off while particles stay in the records.
  void final_integrate() override
  {
    if (!reason.empty()) return Base::final_integrate();
    system->step().complete_step_of(*this);
  }

  // SystemFix
  std::string reason_for_stock() const override { return reason; }
  bool integrates() const override { return true; }
  Talus::Kicks kicks() const override { return {0.5, 0.5}; }
  void complete_step() override { kick_spheres(this->lmp, this->igroup, half_step(), 0, false); }

 protected:
  /// `plain_name`: of the style without a suffix.
  SphereVerlet(LAMMPS *lmp, int narg, char **arg, const char *plain_name) :
      Base(lmp, narg, arg), system(Talus::GranularSystem::of(lmp)), plain(plain_name)
  {
  }
  /// "", or what of the words of the fix is done by LAMMPS only.
  virtual std::string reason_of_words() const = 0;

  std::shared_ptr<Talus::GranularSystem> system;

 private:
  std::string find_reason() const
  {
    if (std::string of_words = reason_of_words(); !of_words.empty()) return of_words;
    if (utils::strmatch(this->update->integrate_style, "^respa"))
      return "run_style respa has levels";
    return system->pair_style().is_there() ? "" : system->pair_style().reason_against();
  }
  Talus::RecordStep half_step() const
  {
    Talus::RecordStep step{this->update->dt,
                           0.5 * this->update->dt * this->force->ftm2v,
                           {0.0, 0.0, 0.0},
                           this->inertia};
    step.two_kicks = true;
    step.extrapolation = 0.5;    // the second of them
    return step;
  }

  const char *plain;
  std::string reason = "no run yet";    // for the methods of LAMMPS
};

}    // namespace LAMMPS_NS

#endif
