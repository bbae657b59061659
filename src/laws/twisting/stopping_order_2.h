// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// `spinning mu_s` with `order 2` of the integrator: the torque -mu_s r_c F_n (w.n)/|w| n of
// stopping.h to second order in the time step. As long as the bodies roll on each other it changes
// smoothly through (w.n) = 0; where they hardly do, within a few steps, it is held like rolling,
// see rolling/held_rotation.h.

#ifndef TALUS_LAWS_TWISTING_STOPPING_ORDER_2_H
#define TALUS_LAWS_TWISTING_STOPPING_ORDER_2_H

#include "laws/rolling/common.h"
#include "laws/rolling/held_rotation.h"

namespace Talus {

/// 1/I_1 + 1/I_2 over 5/2 (1/m_1 + 1/m_2), of solid spheres of one density; exact against a large
/// body and for equal spheres.
template <class Real> TALUS_INLINE Real inverse_gyration(const ContactLanes<Real> &s)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto overlaps = s.overlap > zero;
  const Real differ = select(overlaps, 2.0 * s.arm_difference / select(overlaps, s.overlap, one),
                             zero);    // (r_2 - r_1)/(r_1 + r_2)
  const Real square = select(s.inverse_distance > zero, differ * differ, one);
  return 0.25 * s.inverse_radius * s.inverse_radius *
         (one + 10.0 * square + 5.0 * square * square) / (one + 3.0 * square);
}

struct StoppingOrder2 : TwistingLaw {
  static constexpr const char *name = "stopping", *label = "resistance";
  static constexpr bool needs_radius = true;
  static constexpr int even_history = 3;    // of HeldRotation: along the normal
  static constexpr double smooth = 4.0;     ///< rolling over what a step of the torque changes
  template <class Real> struct Row {
    Real mu, twist_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_s"}, {"twist_min", Shown::NEVER}};

  static Row<double> mix(const Mixing &m) { return {m.friction("mu_s"), m.largest("twist_min")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real turns = response(s.inverse_mass, dt) * inverse_gyration(s);
    const auto acts = (s.separated <= zero) & (turns > zero) & (c.mu > zero);
    const Real inverse = select(acts, one / select(acts, turns, one), zero);
    const Real presses = select(s.normal_force > zero, s.normal_force, zero);
    const Real most = c.mu * s.intersection_radius * presses, reach = turns * most;

    const Vector3<Real> omega = s.relative_omega + s.omega_change;
    const Real along = dot(omega, s.normal), square = dot(omega, omega);
    const Real rolls = square - along * along;
    const Real high = select(magnitude(along) > reach, magnitude(along), reach);
    const Real size = square_root(high * high + select(rolls > zero, rolls, zero));
    const Real limit = select(size > zero, reach * high / select(size > zero, size, one), zero);

    const auto vector = [&](Real a) { return Vector3<Real>{a, zero, zero}; };
    const Real stored[] = {h[0], zero, zero, h[1], zero, zero, h[2]};
    HeldRotation<Real> kept = held_rotation(stored);
    kept.torque = turns * kept.torque;
    Real found =
        inverse * hold_rotation(vector(dot(s.relative_omega, s.normal)),
                                vector(dot(s.omega_change, s.normal)), vector(zero), limit, kept)
                      .x;
    const auto is_smooth = rolls > smooth * smooth * reach * reach;
    const Real speed = square_root(square);
    found = select(is_smooth, most * along / select(speed > zero, speed, one), found);
    kept.moved = (select(kept.moved, one, zero) + select(is_smooth, one, zero)) > zero;
    Vector3<Real> torque = as_stored(vector(found));
    if constexpr (advance) {
      kept.torque = torque;
      Real next[HeldRotation<Real>::size];
      store_held(kept, next);
      h[0] = select(s.separated > zero, zero, next[0]);
      h[1] = select(s.separated > zero, zero, next[3]);
      h[2] = select(s.separated > zero, zero, next[6]);
    } else
      torque.x = select(kept.known, h[0], torque.x);
    s.twisting_torque = s.twisting_torque - select(acts, torque.x, zero) * s.normal;
  }
};

}    // namespace Talus

#endif
