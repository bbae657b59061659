// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spinning after one collision time, as Chrono: twisting torque -mu_twist r_c F_n (w.n) n/|w| on
// body 1, its opposite on body 2, with w = omega_1 - omega_2 and r_c the radius of the circle in
// which the surfaces intersect; an attractive F_n with its sign.

#ifndef TALUS_LAWS_TWISTING_DELAYED_H
#define TALUS_LAWS_TWISTING_DELAYED_H

#include "laws/rolling/common.h"

namespace Talus {

struct DelayedTwist : TwistingLaw {
  static constexpr const char *name = "delayed", *label = "delayed resistance";
  static constexpr bool delayed = true, reads_impact = true;
  template <class Real> struct Row {
    Real mu, twist_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_s"}, {"twist_min", Shown::NEVER}};

  static Row<double> mix(const Mixing &m)
  {
    return {m.friction("mu_s"), m.largest("twist_min", delayed_threshold)};
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Vector3<Real> &w = s.relative_omega;
    const Real speed = square_root(dot(w, w));
    const auto twists = (speed > c.twist_min) & (speed > splat<Real>(0.0));
    const Real strength = c.mu * s.intersection_radius * s.delayed_force;
    const Real twisting_torque = -strength * dot(w, s.normal) / speed;
    s.twisting_torque =
        s.twisting_torque + select(twists, twisting_torque, splat<Real>(0.0)) * s.normal;
  }
};

}    // namespace Talus

#endif
