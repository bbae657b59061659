/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix nve/bpm/sphere with `-sf talus`, of spheres that have an orientation: sphere_verlet.h, and behind its first half

     q += dt omega q/2 by Richardson's extrapolation, with the omega of the half step

   Stock with `update dipole`.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/bpm/sphere/talus,FixNVEBPMSphereTalus);
// clang-format on
#else

#ifndef LMP_FIX_NVE_BPM_SPHERE_TALUS_H
#define LMP_FIX_NVE_BPM_SPHERE_TALUS_H

#include "fix/motion/sphere_verlet.h"

#include "BPM/fix_nve_bpm_sphere.h"

namespace LAMMPS_NS {

class FixNVEBPMSphereTalus : public SphereVerlet<FixNVEBPMSphere> {
 public:
  FixNVEBPMSphereTalus(class LAMMPS *, int, char **);
  std::string needs_arrays() override { return reason_for_stock(); }
  void turn_particles() const override;

 private:
  std::string reason_of_words() const override;
};

}    // namespace LAMMPS_NS

#endif
#endif
