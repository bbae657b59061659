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
//   * where it ends the same, see end_of_contact.h;
//   * the displacement, and the return of a sliding contact to its limit: see midpoint.h.
//
// The fourth number remembered is -F_0, below zero if the contact was there a step ago, with two
// flags: it began in that step, it slid. So a force can be computed again without advancing. Of a
// contact that ended in that step it is above zero.

#ifndef TALUS_LAWS_TANGENTIAL_SECOND_ORDER_H
#define TALUS_LAWS_TANGENTIAL_SECOND_ORDER_H

#include "base/flagged_number.h"
#include "laws/tangential/common.h"
#include "laws/tangential/end_of_contact.h"
#include "laws/tangential/midpoint.h"

namespace Talus {

/// Hurwitz' zeta(-p, t) for the p of power() and 0 < t <= 1: t^p + zeta(-p, 1 + t), and that by
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

/// Hurwitz' zeta(-p-1, t) for p = 1, 3/2 in the same way.
template <class Real> TALUS_INLINE Real next_hurwitz_zeta(Real p, Real t)
{
  constexpr int terms = 8;
  constexpr double of_2[terms] = {0.0, -1.0 / 6.0, -0.5, -1.0 / 3.0};
  constexpr double of_5_halves[terms] = {0.00851693932511, -0.063714006929,  -0.389767136457,
                                         -0.456516777643,  -0.101402024882,  0.0141888780042,
                                         -0.0032726276339, 0.000483693683210};
  const auto linear = p < splat<Real>(1.25);
  Real sum = splat<Real>(0.0);
  for (int n = terms - 1; n >= 0; n--)
    sum = t * sum + select(linear, splat<Real>(of_2[n]), splat<Real>(of_5_halves[n]));
  return t * power(t, p) + sum;
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

  /// Contacts that begin or end in this step; few do. Elsewhere compute<true, false>() is enough,
  /// with the same bits.
  template <class Real> TALUS_INLINE static bool_of<Real> at_an_end(Real parted, Real stored)
  {
    const Real zero = splat<Real>(0.0);
    return (stored >= zero) | (parted > zero);
  }

  template <bool advance, bool ends = true, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    s.adhesive_share = one;
    EndOfContact<Real> end;
    if constexpr (ends) end = end_of<advance>(c, s, h, dt);
    const LastStep<Real> last = last_step(h[3]);
    Real pure = find_normal_force(s, last);
    if constexpr (!advance) pure = select(last.known, last.force, pure);

    auto begins = last.began;
    Beginning<Real> start{one, zero, zero};
    Real force = pure, theta = one;
    if constexpr (ends) {
      const Real approach = -dt * s.normal_velocity;
      if constexpr (advance)
        begins = (h[3] >= zero) & (s.lag > zero) & (approach + approach >= s.overlap);
      const Real others = 2.0 * dot(s.velocity_change, s.normal);
      const Edge<Real> edge =
          edge_of<Of::BEGIN>(s, s.overlap, s.normal_velocity, others, begins, dt);
      begins = edge.is;
      start = errors_of<Of::BEGIN>(c, s.overlap, edge);
      theta = edge.theta;
      s.adhesive_share = select(begins, splat<Real>(0.5) + theta, one);    // p = 0
      const Real early =
          start.elastic * s.elastic - second_force<Of::BEGIN>(c, s, start, s.elastic, edge, dt);
      force = pure - (early - start.damping * s.gn * s.normal_velocity);
      if constexpr (advance) s.elastic = s.elastic - early;    // what does not store is work
    }
    s.normal_force = force;
    s.critical_force = magnitude(force);
    s.force = force * s.normal;

    auto slides = last.slid;
    Vector3<Real> t{zero, zero, zero};
    if constexpr (friction) {
      const Vector3<Real> u = surface_velocity_of(s.velocity + s.velocity_change,
                                                  s.surface_rotation + s.rotation_change, s.normal);
      Vector3<Real> d{h[0], h[1], h[2]};
      const Real limit = c.mu * pure;
      Real old_limit = c.mu * last.force;
      if constexpr (ends && advance)
        old_limit = select(last.known, old_limit, select(begins, limit_at_begin(c, s), limit));
      if constexpr (advance) {
        const Real none = splat<Real>(no_force);
        const auto returns = last.known & (last.force < none) & (pure > none);
        if (any(returns)) theta = select(returns, share_since_return(c, s, pure, dt), theta);
      }
      const Real time = dt * theta;
      Vector3<Real> before = d, half_way = u;
      if constexpr (advance) {
        const Vector3<Real> q = half_turn(s, dt);
        before = turned_by(q, d, s.normal);
        half_way = velocity_half_way(s, q);
        d = before + time * half_way;
      }
      Vector3<Real> f = s.kt * d + s.gt * u;
      const auto exceeds = dot(f, f) > limit * limit;
      slides = advance ? exceeds : slides | exceeds;
      t = -f;
      if (any(slides)) {
        if constexpr (advance) {
          const Slide<Real> way{s.kt,
                                s.gt,
                                s.overlap,
                                s.overlap + dt * s.normal_velocity,
                                c.elastic_exponent - one,
                                c.damping_exponent,
                                limit,
                                old_limit,
                                before,
                                half_way,
                                u,
                                f,
                                time,
                                dt};
          Vector3<Real> slid = slide(way);
          if constexpr (ends) slid = select(begins, first_slide(way), slid);
          d = select(slides, slid, d);
          f = s.kt * d + s.gt * u;
        }
        t = select(slides, with_length(limit, -f), t);
      }
      if constexpr (ends) {
        const Real most = c.mu * s.critical_force;
        const Vector3<Real> early = start.elastic / start.ratio * dt * s.kt * u;
        const Vector3<Real> sticks = limited(t + early + start.damping * s.gt * u, most);
        t = select(begins, select(slides, with_length(most, t), sticks), t);
      }
      if constexpr (advance) {
        h[0] = d.x;
        h[1] = d.y;
        h[2] = d.z;
      }
    }
    if constexpr (advance)
      h[3] = -with_flags(pure, select(begins, one, zero) + select(slides, splat<Real>(2.0), zero));
    if constexpr (ends) end.replace(s, t, h);
    add_tangential(s, t);
  }

 private:
  static constexpr double least_force = 1.0e-200, no_force = 2.0e-200;

  /// Rounded to what is remembered of it, and above zero.
  template <class Real>
  TALUS_INLINE static Real find_normal_force(const ContactLanes<Real> &s,
                                             const LastStep<Real> &last)
  {
    const Real one = splat<Real>(1.0), least = splat<Real>(least_force);
    const Real by_others = dot(s.velocity_change, s.normal) - s.lag * s.inverse_mass * last.force;
    const Real v = s.normal_velocity + by_others;
    const Real force = (s.elastic - s.gn * v) / (one + s.gn * s.lag * s.inverse_mass);
    return without_flags(select(force > least, force, least));
  }

  /// Where damping has held a force at 0 which is F now, the part of the step since it began to
  /// grow: before, the spring was at rest.
  template <class Real>
  TALUS_INLINE static Real share_since_return(const Row<Real> &c, const ContactLanes<Real> &s,
                                              Real force, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), v = s.normal_velocity;
    const Real change = 2.0 * dot(s.velocity_change, s.normal) + dt * centrifugal(s, v);
    const auto touches = s.overlap > zero;
    const Real of_gn = c.damping_exponent * s.gn * v / select(touches, s.overlap, one);
    const Real growth = dt * v * (of_gn - s.tangent_n) - s.gn * change;
    return select(growth > force, force / select(growth > zero, growth, one), one);
  }

  /// Of friction where the overlap is 0 and the normal force is that of damping.
  template <class Real>
  TALUS_INLINE static Real limit_at_begin(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), limit = -c.mu * s.gn * s.normal_velocity;
    return select(limit > zero, limit, zero);
  }

  template <Of which, class Real>
  static Beginning<Real> errors_of(const Row<Real> &c, Real overlap, const Edge<Real> &edge)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), p = c.elastic_exponent;
    const Real ratio = select(edge.is, edge.reach / select(edge.is, overlap, one), one);
    const Real later = which == Of::BEGIN ? edge.theta : edge.theta - one;
    const Real first = hurwitz_zeta(p, edge.theta), next = next_hurwitz_zeta(p, edge.theta);
    const Real elastic = first + edge.bend * ((0.5 * p + one) * next - later * first);
    const Real damping = hurwitz_zeta(c.damping_exponent, edge.theta);
    return {ratio, select(edge.is, power(ratio, p) * elastic, zero),
            select(edge.is, power(ratio, c.damping_exponent) * damping, zero)};
  }

  /// push A dt^p times the second term, where `elastic` is the force now.
  template <Of which, class Real>
  static Real second_force(const Row<Real> &c, const ContactLanes<Real> &s,
                           const Beginning<Real> &start, Real elastic, const Edge<Real> &edge,
                           double dt)
  {
    const Real zero = splat<Real>(0.0);
    const Real most = power(start.ratio, c.elastic_exponent) * elastic;
    const Real push = dt * dt * s.inverse_mass * most / edge.reach;
    const Real force = push * most * second_term<which>(c.elastic_exponent, edge.theta);
    return select(edge.is, which == Of::BEGIN ? -force : force, zero);
  }

  /// Of contacts that have parted. Those that touch again begin anew.
  template <bool advance, class Real>
  static EndOfContact<Real> end_of(const Row<Real> &c, const ContactLanes<Real> &s, Real *h,
                                   double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real v = s.normal_velocity;
    EndOfContact<Real> end;
    end.parted = s.parted > zero;
    const LastStep<Real> last = last_step(-magnitude(h[3]));
    auto ends = end.parted & (s.overlap > zero) & (h[3] > zero);
    if constexpr (advance) ends = end.parted & (s.overlap > zero) & (h[3] < zero);

    // limited damping: the force ends before the overlap
    const auto damped = s.gn * v > zero;
    const Real overlap = s.overlap - select(damped, s.gn * v / select(damped, s.kn, one), zero);
    const auto pressed = ends & (last.force > splat<Real>(no_force));
    const Real left = s.elastic - s.gn * v;
    const Real others =
        2.0 * (dot(s.velocity_change, s.normal) - s.lag * s.inverse_mass * last.force);
    const Edge<Real> edge = edge_of<Of::END>(s, overlap, v, others, pressed, dt);
    const Beginning<Real> error = errors_of<Of::END>(c, overlap, edge);
    const Real sum = error.elastic * left - second_force<Of::END>(c, s, error, left, edge, dt);
    end.normal_force = select(edge.is, -sum, zero);

    const Real way = select(ends, dt * (v - 0.5 * dt * centrifugal(s, v)), one);
    end.adhesive_share = select(ends, s.overlap / way - splat<Real>(0.5), zero);

    const Vector3<Real> d{h[0], h[1], h[2]};
    end.tangential = {zero, zero, zero};
    if constexpr (friction) {
      const Vector3<Real> now = turned_by(half_turn(s, dt), d, s.normal), u = surface_velocity(s);
      const Vector3<Real> within = -(s.kt * now + s.gt * u);
      const Vector3<Real> stuck =
          end_of_sticking(within, -dt * s.kt * u, c.mu * last.force, edge.theta);
      end.tangential = select(last.slid, with_length(c.mu * end.normal_force, within),
                              select(edge.is, stuck, end.tangential));
    }
    for (int n = 0; n < 3; n++) end.history[n] = select(ends, h[n], zero);
    const Real flags = select(last.slid, splat<Real>(2.0), zero);
    end.history[3] = select(ends, with_flags(last.force, flags), zero);
    const auto again = (h[3] > zero) & (s.parted <= zero);
    for (int n = 0; n < 3; n++) h[n] = select(again, zero, h[n]);
    return end;
  }
};

}    // namespace Talus

#endif
