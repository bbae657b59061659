/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix nve/sphere with `-sf talus`: velocity Verlet for spheres, words and results of the style
   of LAMMPS, to rounding

     v += h F/m, x += dt v with the new v, forces at the new x, v += h F/m
     omega += h T/(c m r^2) with each kick           c = 2/5, with `disc` 1/2

   h = dt/2 times ftm2v, dt = update->dt. The kick that ends a step and the one that begins the
   next are made in one pass while particles are in the records, so that their velocities there
   are those of the half step; complete_step() or the final_integrate() of a step that is looked
   at completes them. The bits are the same wherever a step is made.

   Called by: Verlet::run() through Modify::initial_integrate() and final_integrate().
   Falls back to the methods of LAMMPS without a pair style of Talus, with `update dipole` and
   with run_style respa: reason_for_stock().
   Errors: those of fix nve/sphere.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/sphere/talus,FixNVESphereTalus);
// clang-format on
#else

#ifndef LMP_FIX_NVE_SPHERE_TALUS_H
#define LMP_FIX_NVE_SPHERE_TALUS_H

#include "fix_nve_sphere.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixNVESphereTalus : public FixNVESphere, public Talus::SystemFix {
 public:
  FixNVESphereTalus(class LAMMPS *, int, char **);
  void post_constructor() override;
  void init() override;
  void initial_integrate(int) override;
  void final_integrate() override;

  // SystemFix
  std::string needs_arrays() override;
  std::string reason_for_stock() const override { return reason; }
  bool integrates() const override { return true; }
  Talus::Kicks kicks() const override { return {0.5, 0.5}; }
  void complete_step() override;

 private:
  std::shared_ptr<Talus::GranularSystem> system;
  std::string reason = "no run yet";    // for the methods of LAMMPS

  std::string find_reason() const;
  Talus::RecordStep half_step() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
