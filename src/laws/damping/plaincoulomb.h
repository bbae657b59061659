// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Chrono's PlainCoulomb with coefficients: gn sqrt(overlap). gn force time/distance^(3/2).

#ifndef TALUS_LAWS_DAMPING_PLAINCOULOMB_H
#define TALUS_LAWS_DAMPING_PLAINCOULOMB_H

#include "laws/damping/common.h"

namespace Talus {

struct PlainCoulombDamping : DampingByNumber {
  static constexpr const char *name = "plaincoulomb";

  static double damping_exponent(double /*elastic*/) { return 0.5; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.gn = c.gn * square_root(s.overlap);
    s.gt = splat<Real>(0.0);
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
