// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Damping only: F_t = -gt v_t, not longer than mu |F_n|. (Chrono's mode None, but capped instead of
// dropped beyond the limit.)

#ifndef TALUS_LAWS_TANGENTIAL_DASHPOT_H
#define TALUS_LAWS_TANGENTIAL_DASHPOT_H

#include "laws/tangential/common.h"

namespace Talus {

struct Dashpot : FrictionLaw {
  static constexpr const char *name = "dashpot", *label = name;

  static void read(LawReader &r) { read_friction(r, false, false); }
  static const Law *order_2(bool adhesive);

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    add_tangential(s, capped(-s.gt * surface_velocity(s), c.mu * s.critical_force));
  }
};

}    // namespace Talus

#endif
