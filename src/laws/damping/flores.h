// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Flores et al. 2011 with coefficients: a m gn overlap, a m gt. gn 1/(time distance^2), gt
// 1/(time distance).

#ifndef TALUS_LAWS_DAMPING_FLORES_H
#define TALUS_LAWS_DAMPING_FLORES_H

#include "laws/damping/common.h"

namespace Talus {

struct FloresDamping : DampingByNumber {
  static constexpr const char *name = "flores";
  static constexpr const char *needs_gt =
      "gn of flores has another unit, 1/(time distance^2), than gt, 1/(time distance)";

  static double damping_exponent(double /*elastic*/) { return 1.5; }
  static double dashpot_exponent(double /*elastic*/) { return 0.5; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real damping = s.contact_radius * s.mass;
    s.gn = damping * c.gn * s.overlap;
    s.gt = damping * c.gt;
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
