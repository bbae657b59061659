// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rolling that is held: torque M with which the rotation left after the step is 1 - stopping_share
// of that before, whatever friction does: d(r_1 omega_1 + r_2 omega_2) = -response (friction_moment
// + M). Not longer than mu_roll F_n, F_n >= 0.

#ifndef TALUS_LAWS_ROLLING_HOLDING_H
#define TALUS_LAWS_ROLLING_HOLDING_H

#include "laws/rolling/common.h"
#include "laws/tangential/common.h"

namespace Talus {

struct HoldingRolling : RollingLaw {
  static constexpr const char *name = "holding", *label = "resistance";
  static const Law *order_2(bool adhesive);
  static constexpr bool holds = true;
  template <class Real> struct Row {
    Real mu, roll_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_r"}, {"roll_min", Shown::NEVER}};

  static void read(LawReader &r) { read_resistance(r, stage); }
  static Row<double> mix(const Mixing &m) { return {m.friction("mu_r"), m.largest("roll_min")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double dt)
  {
    const Real zero = splat<Real>(0.0), turns = response(s.inverse_mass, dt);
    const Real presses = select(s.normal_force > zero, s.normal_force, zero);
    const Vector3<Real> rotation = cross(s.surface_rotation, s.normal);
    const auto acts = square_root(dot(rotation, rotation)) >= c.roll_min;
    const Real stop = select(turns > zero, stopping_share / turns, zero);
    const Vector3<Real> needed = stop * cross(s.normal, rotation) - s.torque_per_radius;
    s.torque_per_radius =
        s.torque_per_radius + select(acts, splat<Real>(1.0), zero) * capped(needed, c.mu * presses);
  }
};

}    // namespace Talus

#endif
