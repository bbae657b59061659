// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// In proportion to the velocity alone: gn, gt mass/time (LAMMPS' pair granular, Cundall and Strack
// 1979).

#ifndef TALUS_LAWS_DAMPING_VELOCITY_H
#define TALUS_LAWS_DAMPING_VELOCITY_H

#include "laws/damping/common.h"

namespace Talus {

struct VelocityDamping : DampingByNumber {
  static constexpr const char *name = "velocity";

  static void read(LawReader & /*r*/) {}
  static double damping_exponent(double /*elastic*/) { return 0.0; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.gn = c.gn;
    s.gt = c.gt;
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
