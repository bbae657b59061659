// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// `rolling sds` with `order 2` of the integrator: the pseudo-force of sds.h with velocities at the
// time of the positions, to second order in the time step: see tangential/midpoint.h on how xi
// turns, tangential/set_back.h on its limit, and tangential/second_order.h on begin and end of a
// contact. Where one begins, the part of the force that does not go to zero with the overlap is
// that of the dashpot, not above the limit; where it ends, that of the limit by adhesion: only a
// share of it acts. The rest, which goes to zero with the overlap at least, needs no correction.

#ifndef TALUS_LAWS_ROLLING_SDS_ORDER_2_H
#define TALUS_LAWS_ROLLING_SDS_ORDER_2_H

#include "laws/rolling/sds.h"
#include "laws/rounding.h"
#include "laws/tangential/adhesive_contact.h"
#include "laws/tangential/end_of_contact.h"
#include "laws/tangential/midpoint.h"
#include "laws/tangential/set_back.h"

namespace Talus {

struct SdsOrder2 : RollingLaw {
  static constexpr const char *name = "sds", *label = "rolling sds";
  static constexpr bool needs_radius = true;
  static constexpr int even_history = 4;    // xi; 1: it slides, 2: the limit is 0
  template <class Real> struct Row {
    Real k, gamma, mu, damping,
        adhesion;    // exponent of the overlap; limit at begin over pulloff_force
  };
  static constexpr CoefficientName coefficients[] = {{"k_roll"},
                                                     {"gamma_roll"},
                                                     {"mu_roll"},
                                                     {"damping exponent", Shown::NEVER},
                                                     {"pull at begin", Shown::NEVER}};

  static Row<double> mix(const Mixing &m)
  {
    const auto row = SdsRolling::mix(m);
    const Law &normal = m.a.law.normal();
    // with adhesion of the normal law damping is no part of the limit
    const double damping =
        normal.cohesive ? 1.0 : m.a.law.damping().damping_exponent(normal.exponent);
    return {row.k, row.gamma, row.mu, damping, normal.lasts_beyond_contact ? 1.0 + jkr_begin : 1.0};
  }
  template <class Real>
  static Real stored(const ContactLanes<Real> &s, const Row<Real> &c, const Real *h)
  {
    return SdsRolling::stored(s, {c.k, c.gamma, c.mu}, h);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Vector3<Real> &omega = s.relative_omega, &n = s.normal;
    const auto at_event = magnitude(s.adhesive_share - one) > zero;
    const auto separated = s.separated > zero;
    const Real critical = select(at_event, s.uncorrected_force, s.critical_force);
    const Real damping_at_event = select(c.damping <= zero, -s.gn * s.normal_velocity, zero);
    const Real limit_at_event = c.mu * (select(damping_at_event > zero, damping_at_event, zero) +
                                        c.adhesion * s.pulloff_force);
    const Vector3<Real> u = s.radius * cross(omega + s.omega_change, n);

    Vector3<Real> xi{h[0], h[1], h[2]};
    auto slides = h[3] >= one;
    if constexpr (advance) {
      const Vector3<Real> q = half_turn(s, dt);
      const Vector3<Real> half_way = s.radius * cross(omega + dot(omega, n) * q, n);
      const Vector3<Real> old_u = splat<Real>(2.0) * half_way - u;
      const Vector3<Real> before = turned_by(q, xi, n), drag = c.gamma * u;
      const auto presses = critical > splat<Real>(no_force);
      const auto returns = (h[3] > one) & presses;
      Real time = splat<Real>(dt);
      if (any(returns))
        time = dt * select(returns, share_since_return(s, c.damping, critical, dt), one);
      const Vector3<Real> moved = before + time * half_way;
      const Vector3<Real> trial = c.k * moved + drag;
      const Real limit = c.mu * critical, stiff = select(c.k > zero, c.k, one);
      const auto back = [&](const Vector3<Real> &force, const Vector3<Real> &of_dashpot) {
        return select(c.k > zero, one / stiff, zero) * (force - of_dashpot);
      };
      slides = dot(trial, trial) > limit * limit;
      const Vector3<Real> old = c.k * before + c.gamma * old_u;
      const Vector3<Real> followed =
          select(slides, back(midpoint_return(trial, old, limit), drag), moved);
      if (any(at_event)) {
        const Real theta = s.adhesive_share - splat<Real>(0.5);
        const Vector3<Real> change = s.radius * cross(s.omega_change, n);
        const Vector3<Real> first_drag = c.gamma * (u - 2.0 * theta * change);
        const Vector3<Real> begun =
            back(limited(first_drag, limit_at_event), first_drag) + dt * theta * half_way;
        const Vector3<Real> total = c.k * begun + drag;
        slides = select(at_event, select(dot(total, total) > limit * limit, one, zero),
                        select(slides, one, zero)) > zero;
        xi = select(at_event, begun, followed);
      } else
        xi = followed;
      // an adhesive force that ends with a jump is corrected in the step after it, and in a set-up
      // then
      xi = select(separated,
                  select(s.pulloff_force > zero, before, Vector3<Real>{zero, zero, zero}), xi);
      const Real least = splat<Real>(1.0e-150);    // what slides has a direction
      xi.x = rounded<47>(select(magnitude(xi.x) > least, xi.x, least));
      h[0] = xi.x;
      h[1] = xi.y;
      h[2] = xi.z;
      h[3] = select(presses, select(slides, one, zero), splat<Real>(2.0));
      slides = h[3] >= one;
    }

    const Real most = c.mu * s.critical_force;
    Vector3<Real> force = c.k * xi + c.gamma * u;
    const Vector3<Real> jump = limited(c.gamma * u, limit_at_event);
    const Vector3<Real> ends = s.adhesive_share * limited(force, c.mu * s.pulloff_force);
    const Vector3<Real> begins = limited(force + (s.adhesive_share - one) * jump, most);
    force = select(slides, with_length(most, force), select(at_event, begins, force));
    force = select(separated, ends, force);
    s.twisting_torque = s.twisting_torque - s.radius * cross(n, force);
  }
};

}    // namespace Talus

#endif
