// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rolling after one collision time, as Chrono: v_rot = (r_1 omega_1 + r_2 omega_2) x n; the torque
// on body i is -r_i torque_per_radius with torque_per_radius = mu_roll F_n n x v_rot/|v_rot|, an
// attractive F_n with its sign.

#ifndef TALUS_LAWS_ROLLING_DELAYED_H
#define TALUS_LAWS_ROLLING_DELAYED_H

#include "laws/rolling/common.h"

namespace Talus {

struct DelayedRolling : RollingLaw {
  static constexpr const char *name = "delayed", *label = "delayed resistance";
  static constexpr bool delayed = true, reads_impact = true;
  template <class Real> struct Row {
    Real mu, roll_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_r"}, {"roll_min", Shown::NEVER}};

  static Row<double> mix(const Mixing &m)
  {
    return {m.friction("mu_r"), m.largest("roll_min", delayed_threshold)};
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Vector3<Real> rotation = cross(s.surface_rotation, s.normal);
    const Real speed = square_root(dot(rotation, rotation));
    const auto rolls = (speed > c.roll_min) & (speed > splat<Real>(0.0));
    const Real strength = c.mu * s.delayed_force;
    s.torque_per_radius = s.torque_per_radius + select(rolls, strength / speed, splat<Real>(0.0)) *
                                                    cross(s.normal, rotation);
  }
};

}    // namespace Talus

#endif
