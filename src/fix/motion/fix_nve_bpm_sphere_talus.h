/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix nve/bpm/sphere with `-sf talus`: velocity Verlet for spheres that have an orientation, words
   and results of the style of LAMMPS, to rounding. That of fix nve/sphere/talus, and then

     q += dt omega q/2 by Richardson's extrapolation, with the omega of the half step

   Orientations live in the arrays of LAMMPS, and so do particles in every step.

   Called by: Verlet::run() through Modify::initial_integrate() and final_integrate().
   Falls back to the methods of LAMMPS without a pair style of Talus, with `update dipole` and
   with run_style respa: reason_for_stock().
   Errors: those of fix nve/bpm/sphere.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/bpm/sphere/talus,FixNVEBPMSphereTalus);
// clang-format on
#else

#ifndef LMP_FIX_NVE_BPM_SPHERE_TALUS_H
#define LMP_FIX_NVE_BPM_SPHERE_TALUS_H

#include "BPM/fix_nve_bpm_sphere.h"
#include "system/step/granular_system.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixNVEBPMSphereTalus : public FixNVEBPMSphere, public Talus::SystemFix {
 public:
  FixNVEBPMSphereTalus(class LAMMPS *, int, char **);
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
  void turn();
};

}    // namespace LAMMPS_NS

#endif
#endif
