// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// In proportion to the effective mass: gn m, gt m. gn, gt 1/time.

#ifndef TALUS_LAWS_DAMPING_MASS_VELOCITY_H
#define TALUS_LAWS_DAMPING_MASS_VELOCITY_H

#include "laws/damping/common.h"

namespace Talus {

struct MassVelocity : DampingByNumber {
  static constexpr const char *name = "mass_velocity";

  static void read(LawReader & /*r*/) {}
  static double damping_exponent(double /*elastic*/) { return 0.0; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.gn = s.mass * c.gn;
    s.gt = s.mass * c.gt;
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
