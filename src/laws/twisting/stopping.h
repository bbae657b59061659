// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spinning that stops: twisting torque -mu_twist r_c F_n (w.n) n/|w| on body 1, its opposite on
// body 2, with w = omega_1 - omega_2 and r_c the radius of the circle in which the surfaces
// intersect; but not more than what leaves 1 - stopping_share of the twisting after the step; of
// unlike spheres it leaves more (1/r_1^2 + 1/r_2^2 is less than inverse_radius squared). F_n >= 0.

#ifndef TALUS_LAWS_TWISTING_STOPPING_H
#define TALUS_LAWS_TWISTING_STOPPING_H

#include "laws/rolling/common.h"

namespace Talus {

struct StoppingTwist : TwistingLaw {
  static constexpr const char *name = "stopping", *label = "resistance";
  static const Law *order_2(bool adhesive);
  static constexpr bool needs_radius = true;
  template <class Real> struct Row {
    Real mu, twist_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_s"}, {"twist_min", Shown::NEVER}};

  static void read(LawReader &r) { read_resistance(r, stage); }
  static Row<double> mix(const Mixing &m) { return {m.friction("mu_s"), m.largest("twist_min")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double dt)
  {
    const Real zero = splat<Real>(0.0), turns = response(s.inverse_mass, dt);
    const Real presses = select(s.normal_force > zero, s.normal_force, zero);
    const Vector3<Real> &w = s.relative_omega;
    const Real speed = square_root(dot(w, w));
    const auto twists = (speed >= c.twist_min) & (speed > zero);
    const Real wanted = c.mu * s.intersection_radius * presses / speed;
    const Real most = stopping_share / (turns * s.inverse_radius * s.inverse_radius);
    const Real twisting_torque = -select(wanted < most, wanted, most) * dot(w, s.normal);
    s.twisting_torque =
        s.twisting_torque + select(twists & (turns > zero), twisting_torque, zero) * s.normal;
  }
};

}    // namespace Talus

#endif
