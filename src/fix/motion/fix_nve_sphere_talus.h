/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   fix nve/sphere with `-sf talus`, see sphere_verlet.h. Stock with `update dipole`.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/sphere/talus,FixNVESphereTalus);
// clang-format on
#else

#ifndef LMP_FIX_NVE_SPHERE_TALUS_H
#define LMP_FIX_NVE_SPHERE_TALUS_H

#include "fix/motion/sphere_verlet.h"

#include "fix_nve_sphere.h"

namespace LAMMPS_NS {

class FixNVESphereTalus : public SphereVerlet<FixNVESphere> {
 public:
  FixNVESphereTalus(class LAMMPS *, int, char **);
  std::string needs_arrays() override;

 private:
  std::string reason_of_words() const override;
};

}    // namespace LAMMPS_NS

#endif
#endif
