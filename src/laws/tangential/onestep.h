// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A spring with the displacement of one time step: F_t = -(kt dt + gt) v_t, not longer than mu
// |F_n|.

#ifndef TALUS_LAWS_TANGENTIAL_ONESTEP_H
#define TALUS_LAWS_TANGENTIAL_ONESTEP_H

#include "laws/tangential/common.h"

namespace Talus {

struct Onestep : FrictionLaw {
  static constexpr const char *name = "onestep", *label = name;

  static void read(LawReader &r) { read_friction(r, true, false); }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double dt)
  {
    const Vector3<Real> trial = -(s.kt * splat<Real>(dt) + s.gt) * surface_velocity(s);
    add_tangential(s, capped(trial, c.mu * s.critical_force));
  }
};

}    // namespace Talus

#endif
