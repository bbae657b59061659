// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts that dissipate, to second order in the time step: what the words `tangential multistep
// ... slider midpoint` and `tangential none` mean with `order 2` of the integrator. Positions
// belong to the time t, velocities to t - lag, lag = dt/2; velocity_change is lag times the
// acceleration of the last step, so that velocity + velocity_change is second order at t. The laws
// come after the damping and find the normal force anew. What makes the order two:
//
//   * damping at the time of the positions, implicit in the contact itself: with F_0, its normal
//     force of the last step, and v_p = v_n + dv_n - lag F_0/m, what others contribute,
//     F = (F_e - gn v_p)/(1 + gn lag/m), not below 0;
//   * in the step in which a contact begins, t = theta dt after it did, the sum over time steps of
//     a force A t^p has the error A dt^p zeta(-p, theta), Hurwitz' zeta function (Euler-Maclaurin
//     for a sum that does not begin on a grid point): it is subtracted. p: exponents of elastic
//     force and damping. Only if the overlap is at most what one step brings;
//   * the displacement of multistep midpoint;
//   * a sliding contact moves along the mean of its old and its new force (generalized midpoint
//     rule of plasticity: Ortiz and Popov 1985, Int. J. Numer. Meth. Eng. 21, 1561), and the spring
//     follows the force g kt, |g kt| = L at its limit, by (gt/kt) d' + d = g: with g linear in the
//     step an L-stable rule of second order. Equal to the rule of Ortiz and Popov if gt = 0.
//
// The fourth number remembered is -F_0, below zero if the contact was there a step ago, with two
// flags: it began in that step, it slid. So a force can be computed again without advancing.

#ifndef TALUS_LAWS_TANGENTIAL_SECOND_ORDER_H
#define TALUS_LAWS_TANGENTIAL_SECOND_ORDER_H

#include "base/flagged_number.h"
#include "laws/tangential/common.h"
#include "laws/tangential/multistep.h"

namespace Talus {

/// x^p for p = 0, 1/4, 1/2, 1, 3/2 and x >= 0.
template <class Real> TALUS_INLINE Real power(Real x, Real p)
{
  const Real root = square_root(x);
  const auto chosen = [p](double below, Real yes, Real no) {
    return select(p < splat<Real>(below), yes, no);
  };
  return chosen(0.125, splat<Real>(1.0),
                chosen(0.375, square_root(root), chosen(0.75, root, chosen(1.25, x, x * root))));
}

/// Hurwitz' zeta(-p, t) for the same p and 0 < t <= 1: t^p + zeta(-p, 1 + t), and that by
/// polynomials, to 4e-8.
template <class Real> TALUS_INLINE Real hurwitz_zeta(Real p, Real t)
{
  constexpr int terms = 8;
  constexpr double of_0[terms] = {-0.5, -1.0}, of_1[terms] = {-1.0 / 12.0, -0.5, -0.5};
  constexpr double of_quarter[terms] = {-0.320451229501,   -0.860325820267,  -0.183870503231,
                                        0.0680906914594,   -0.0378135309747, 0.02023491878,
                                        -0.00776578768526, 0.00145001642375};
  constexpr double of_half[terms] = {-0.207886193114,   -0.730181357831,  -0.326458056008,
                                     0.083088078935,    -0.0407279979801, 0.0205063899565,
                                     -0.00762781400875, 0.00140074307725};
  constexpr double of_3_halves[terms] = {-0.0254852121436, -0.311828018178,   -0.547661363885,
                                         -0.163034422567,  0.030418556131,    -0.0106838251611,
                                         0.00335476767364, -0.000565690041381};
  Real sum = splat<Real>(0.0);
  for (int n = terms - 1; n >= 0; n--) {
    const auto chosen = [p](double below, double yes, Real no) {
      return select(p < splat<Real>(below), splat<Real>(yes), no);
    };
    sum = t * sum + chosen(0.125, of_0[n],
                           chosen(0.375, of_quarter[n],
                                  chosen(0.75, of_half[n],
                                         chosen(1.25, of_1[n], splat<Real>(of_3_halves[n])))));
  }
  return power(t, p) + sum;
}

/// v shortened or stretched to a length; zero stays zero.
template <class Real> TALUS_INLINE Vector3<Real> with_length(Real length, const Vector3<Real> &v)
{
  const Real zero = splat<Real>(0.0), size = square_root(dot(v, v));
  return select(size > zero, length / size, zero) * v;
}

/// Not above the limit.
template <class Real> TALUS_INLINE Vector3<Real> limited(const Vector3<Real> &v, Real limit)
{
  return select(dot(v, v) > limit * limit, with_length(limit, v), v);
}

/// What a contact remembers of its last step.
template <class Real> struct LastStep {
  bool_of<Real> known;    ///< it was there
  Real force;             ///< normal one, 0 if not
  bool_of<Real> began, slid;
};

template <class Real> TALUS_INLINE LastStep<Real> last_step(Real stored)
{
  const Real zero = splat<Real>(0.0), flags = flags_of(stored);
  const bool_of<Real> known = stored < zero;
  const bool_of<Real> slid = known & (flags > splat<Real>(1.5));
  const bool_of<Real> began =
      known & (select(slid, flags - splat<Real>(2.0), flags) > splat<Real>(0.5));
  return {known, select(known, -without_flags(stored), zero), began, slid};
}

/// Errors of the sum over time steps in the step in which a contact begins, as factors of elastic
/// force and damping force of that step. Elsewhere 0, and the ratio below 1.
template <class Real> struct Beginning {
  Real ratio;    ///< what one step brings of overlap, over overlap
  Real elastic, damping;
};

/// What the return of a sliding contact to its limit takes of the state.
template <class Real> struct Slide {
  Real kt, gt, overlap, normal_velocity, inverse_distance;
  Real old_limit;    ///< of the last step
  double dt;
  bool_of<Real> known;    ///< it was there a step ago
  Vector3<Real> normal, velocity, turn;
  Vector3<Real> old_velocity, old_rotation;    ///< a step ago
};

template <class Real> struct SecondOrderRow {
  Real mu, elastic_exponent, damping_exponent;
};

template <bool friction> struct SecondOrder : FrictionLaw {
  static constexpr const char *name = friction ? "multistep order 2" : "none order 2";
  static constexpr const char *label = friction ? "multistep slider midpoint" : nullptr;
  static constexpr int odd_history = 3, even_history = 1;
  static constexpr bool second_order = true;
  static constexpr bool has_spring = friction, is_midpoint = true, reads_stiffness = friction;
  template <class Real> using Row = SecondOrderRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"mu"}, {"elastic exponent", Shown::NEVER}, {"damping exponent", Shown::NEVER}};

  static Row<double> mix(const Mixing &m)
  {
    const double elastic = m.a.law.normal().exponent;
    return {friction ? m.friction("mu") : 0.0, elastic,
            m.a.law.damping().damping_exponent(elastic)};
  }

  static double stored(const ContactLanes<double> &s, const Row<double> & /*c*/, const double *h)
  {
    const Vector3<double> d{h[0], h[1], h[2]};
    return friction ? 0.5 * s.kt * dot(d, d) : 0.0;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const LastStep<Real> last = last_step(h[3]);
    Real pure = find_normal_force(s, last);
    if constexpr (!advance) pure = select(last.known, last.force, pure);

    const Real approach = -dt * s.normal_velocity;
    auto begins = last.began;
    if constexpr (advance)
      begins = (h[3] >= zero) & (s.lag > zero) & (approach >= s.overlap) & (s.overlap > zero);
    Beginning<Real> start{one, zero, zero};
    Real force = pure, theta = one;
    const bool any_begins = any(begins);
    if (any_begins) {
      start = errors_of(c, s.overlap, approach, begins);
      theta = select(begins, s.overlap / select(begins, approach, one), one);
      force = pure - (start.elastic * s.elastic - start.damping * s.gn * s.normal_velocity);
    }
    s.normal_force = force;
    s.critical_force = magnitude(force);
    s.force = force * s.normal;

    auto slides = last.slid;
    if constexpr (friction) {
      const Vector3<Real> u = surface_velocity_of(s.velocity + s.velocity_change,
                                                  s.surface_rotation + s.rotation_change, s.normal);
      Vector3<Real> d{h[0], h[1], h[2]};
      const Real limit = c.mu * pure;
      if constexpr (advance) {
        slides = move<Real>(c, s, last, theta, u, limit, dt, d);
        h[0] = d.x;
        h[1] = d.y;
        h[2] = d.z;
      } else {
        const Vector3<Real> f = s.kt * d + s.gt * u;
        slides = slides | (dot(f, f) > limit * limit);
      }
      const Vector3<Real> within = -(s.kt * d + s.gt * u);
      Vector3<Real> t = select(slides, with_length(limit, within), within);
      if (any_begins) {
        const Real most = c.mu * s.critical_force;
        const Vector3<Real> early = start.elastic / start.ratio * dt * s.kt * u;
        const Vector3<Real> sticks = limited(t + early + start.damping * s.gt * u, most);
        t = select(begins, select(slides, with_length(most, t), sticks), t);
      }
      add_tangential(s, t);
    } else
      add_tangential(s, Vector3<Real>{zero, zero, zero});
    if constexpr (advance)
      h[3] = -with_flags(pure, select(begins, one, zero) + select(slides, splat<Real>(2.0), zero));
  }

 private:
  /// Rounded to what is remembered of it, and above zero.
  template <class Real>
  TALUS_INLINE static Real find_normal_force(const ContactLanes<Real> &s,
                                             const LastStep<Real> &last)
  {
    const Real one = splat<Real>(1.0), least = splat<Real>(1.0e-200);
    const Real by_others = dot(s.velocity_change, s.normal) - s.lag * s.inverse_mass * last.force;
    const Real v = s.normal_velocity + by_others;
    const Real force = (s.elastic - s.gn * v) / (one + s.gn * s.lag * s.inverse_mass);
    return without_flags(select(force > least, force, least));
  }

  // These two are seldom called: functions of their own, which are not given the whole state, so
  // that it can stay in registers.

  template <class Real>
  static Beginning<Real> errors_of(const Row<Real> &c, Real overlap, Real approach,
                                   bool_of<Real> begins)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real ratio = select(begins, approach / select(begins, overlap, one), one);
    const Real theta = one / ratio;
    const auto error = [&](Real p) {
      return select(begins, power(ratio, p) * hurwitz_zeta(p, theta), zero);
    };
    return {ratio, error(c.elastic_exponent), error(c.damping_exponent)};
  }

  /// v_t of these velocities, n across the surface.
  template <class Real>
  TALUS_INLINE static Vector3<Real>
  surface_velocity_of(const Vector3<Real> &v, const Vector3<Real> &rotation, const Vector3<Real> &n)
  {
    return v - dot(v, n) * n - cross(rotation, n);
  }

  /// Advances d by a step; whether the contact slides.
  template <class Real>
  TALUS_INLINE static bool_of<Real>
  move(const Row<Real> &c, const ContactLanes<Real> &s, const LastStep<Real> &last, Real theta,
       const Vector3<Real> &u, Real limit, double dt, Vector3<Real> &d)
  {
    const Real time = dt * theta;
    const Vector3<Real> before = turned(d, s.normal);
    const Vector3<Real> slip = turned(step_displacement(s, dt, time), s.normal);
    d = before + slip;
    const Vector3<Real> f = s.kt * d + s.gt * u;
    const auto slides = dot(f, f) > limit * limit;
    if (any(slides)) {
      const Slide<Real> its{s.kt,
                            s.gt,
                            s.overlap,
                            s.normal_velocity,
                            s.inverse_distance,
                            c.mu * last.force,
                            dt,
                            last.known,
                            s.normal,
                            s.velocity,
                            s.turn,
                            s.velocity - s.velocity_change,
                            s.surface_rotation - s.rotation_change};
      d = select(slides, slide(c, its, before, slip, with_length(limit, f), time), d);
    }
    return slides;
  }

  /// Displacement of a sliding contact. `end`: force at its limit, by the end of the step.
  template <class Real>
  static Vector3<Real> slide(const Row<Real> &c, const Slide<Real> &s, const Vector3<Real> &before,
                             const Vector3<Real> &slip, const Vector3<Real> &end, Real time)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const double dt = s.dt;
    const auto safe = [&](Real a) { return select(a > zero, a, one); };
    const Real tau = s.gt / safe(s.kt);
    const Vector3<Real> g_end = one / safe(s.kt) * end;
    const Vector3<Real> at_once = one / (tau + time) * (tau * before + time * g_end);

    // stiffness and damping a step ago and half way
    const Real d0 = s.overlap + dt * s.normal_velocity;
    const Real x_old = select(d0 > zero, d0, zero) / safe(s.overlap), x_mid = 0.5 * (one + x_old);
    const Real of_kt = c.elastic_exponent - one, of_gt = c.damping_exponent;
    const Real kt_old = s.kt * power(x_old, of_kt), gt_old = s.gt * power(x_old, of_gt);
    const Real kt_mid = s.kt * power(x_mid, of_kt), gt_mid = s.gt * power(x_mid, of_gt);

    const Vector3<Real> n_old =
        with_length(one, s.normal - (dt * s.inverse_distance) * s.velocity - s.turn);
    const Vector3<Real> u_old =
        turned(surface_velocity_of(s.old_velocity, s.old_rotation, n_old), s.normal);
    const Vector3<Real> f_old = limited(kt_old * before + gt_old * u_old, s.old_limit);
    const Vector3<Real> along = with_length(one, kt_mid * (before + splat<Real>(0.5) * slip) +
                                                     gt_mid * (one / safe(time) * slip));

    const Vector3<Real> g_old = select(kt_old > zero, one / safe(kt_old), zero) * f_old;
    const Real b = dot(along, g_old);
    const Real root = b * b + dot(g_end, g_end) - dot(g_old, g_old);
    const Real reach = b + square_root(select(root > zero, root, zero));
    const Vector3<Real> g = select((root >= zero) & (reach > zero), reach * along - g_old, g_end);
    const Real t = gt_mid / safe(kt_mid);
    const Vector3<Real> half_way =
        one / (t * t + dt * t + splat<Real>(0.5 * dt * dt)) *
        (t * t * before + 0.5 * dt * t * g_old + 0.5 * dt * (t + splat<Real>(dt)) * g);
    return select(s.known, half_way, at_once);
  }
};

}    // namespace Talus

#endif
