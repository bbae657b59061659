// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// `rolling mu_r` with `order 2` of the integrator: the torque -r_i M of holding.h, to second order
// in the time step, see held_rotation.h. It includes torque_per_radius of friction, which is known
// of this step. In the step in which a contact begins the normal force is the corrected one, see
// tangential/second_order.h; in that after its end there is none.

#ifndef TALUS_LAWS_ROLLING_HOLDING_ORDER_2_H
#define TALUS_LAWS_ROLLING_HOLDING_ORDER_2_H

#include "laws/rolling/common.h"
#include "laws/rolling/held_rotation.h"
#include "laws/tangential/multistep.h"

namespace Talus {

struct HoldingOrder2 : RollingLaw {
  static constexpr const char *name = "holding", *label = "resistance";
  static constexpr bool holds = true;
  static constexpr int even_history = HeldRotation<double>::size;
  template <class Real> struct Row {
    Real mu, roll_min;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_r"}, {"roll_min", Shown::NEVER}};

  static Row<double> mix(const Mixing &m) { return {m.friction("mu_r"), m.largest("roll_min")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0),
               turns = response(s.inverse_mass, dt);
    const Real inverse = select(turns > zero, one / select(turns > zero, turns, one), zero);
    const Real presses = select(s.normal_force > zero, s.normal_force, zero);
    const auto across = [&s](const Vector3<Real> &v) { return v - dot(v, s.normal) * s.normal; };

    HeldRotation<Real> kept = held_rotation(h);
    const Vector3<Real> stored = kept.torque;
    kept.torque = turns * rotated_to_plane(kept.torque, s.normal);
    const Vector3<Real> found =
        hold_rotation(across(s.surface_rotation), across(s.rotation_change),
                      turns * s.torque_per_radius, turns * c.mu * presses, kept);
    Vector3<Real> whole = as_stored(inverse * found + s.torque_per_radius);
    if constexpr (advance) {
      kept.torque = whole;
      store_held(kept, h);
      for (int n = 0; n < even_history; n++) h[n] = select(s.separated > zero, zero, h[n]);
    } else
      whole = select(kept.known, stored, whole);
    const auto acts = (s.separated <= zero) & (turns > zero) & (c.mu > zero);
    s.torque_per_radius = select(acts, whole, s.torque_per_radius);
  }
};

}    // namespace Talus

#endif
