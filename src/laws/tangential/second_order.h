// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts that dissipate, to second order in the time step: what the words `tangential multistep
// ... slider midpoint` and `tangential none`, and plaincoulomb, mean with `order 2` of the integrator. Positions
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
//   * adhesion that the normal law has itself, the constant pull_off of dmt, is taken out of the
//     elastic force before and added again behind, with the share of p = 0. It raises the limit of
//     friction to mu (F + pull_off), so that friction may end while the contact still sticks;
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
#include "laws/tangential/granular.h"
#include "laws/tangential/hurwitz_zeta.h"
#include "laws/tangential/midpoint.h"
#include "laws/tangential/tanh.h"

#include <type_traits>

namespace Talus {

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

/// Errors of the sum over time steps in the step in which a contact begins, as factors of forces of
/// that step. Elsewhere 0, and the ratio below 1.
template <class Real> struct Beginning {
  Real ratio;                                ///< what one step brings of overlap, over overlap
  Real elastic, damping, spring, dashpot;    ///< the last two tangential
};

/// Exponents of the overlap; slip_min of tanh; kt, xt of LAMMPS' laws.
template <class Real> struct SecondOrderRow {
  Real mu, elastic, damping, spring, dashpot, slip_min, kt, xt;
};

/// DASHPOT: a spring without stiffness. TANH: that of tanh.h, with the velocity at the time of the
/// positions.
enum class Friction { NONE, SPRING, DASHPOT, TANH };

/// `Granular`: the law of LAMMPS' pair granular that it is, with its kt, xt and lever arms.
template <Friction kind, class Granular = void> struct SecondOrder : FrictionLaw {
  static constexpr bool friction = kind == Friction::SPRING || kind == Friction::DASHPOT;
  static constexpr bool granular = !std::is_void_v<Granular>;
  static constexpr bool mindlin = std::is_same_v<Granular, Mindlin>;
  static constexpr const char *name =
      mindlin ? "mindlin order 2"
      : granular && friction
          ? kind == Friction::SPRING ? "linear_history order 2" : "linear_nohistory order 2"
      : kind == Friction::SPRING  ? "multistep order 2"
      : kind == Friction::DASHPOT ? "dashpot order 2"
      : kind == Friction::TANH    ? "tanh order 2"
                                  : "none order 2";
  static constexpr const char *label =
      mindlin                     ? "mindlin"
      : granular                  ? kind == Friction::SPRING ? "linear_history" : "linear_nohistory"
      : kind == Friction::SPRING  ? "multistep slider midpoint"
      : kind == Friction::DASHPOT ? "dashpot"
      : kind == Friction::TANH    ? Tanh::label
                                  : nullptr;
  static constexpr int odd_history = 3, even_history = 1;
  static constexpr bool second_order = true, lever_arms = granular, needs_radius = mindlin;
  static constexpr bool has_spring = kind == Friction::SPRING, is_midpoint = true;
  static constexpr bool stiffens = mindlin, reads_stiffness = friction && !granular;
  template <class Real> using Row = SecondOrderRow<Real>;
  static constexpr Shown of_granular = granular ? Shown::ALWAYS : Shown::NEVER;
  static constexpr CoefficientName coefficients[] = {{"mu"},
                                                     {"elastic exponent", Shown::NEVER},
                                                     {"damping exponent", Shown::NEVER},
                                                     {"spring exponent", Shown::NEVER},
                                                     {"dashpot exponent", Shown::NEVER},
                                                     {"slip_min", Shown::NEVER},
                                                     {"kt", of_granular},
                                                     {"xt", of_granular}};

  static Row<double> mix(const Mixing &m)
  {
    const Law &damping = m.a.law.damping();
    const double elastic = m.a.law.normal().exponent;
    const double of_gn = damping.damping_exponent(elastic);
    const double its_own = granular ? -1.0 : damping.dashpot_exponent(elastic);
    GranularRow<double> own{};
    if constexpr (granular) own = Granular::mix(m);
    return {kind == Friction::NONE ? 0.0 : m.friction("mu"),
            elastic,
            of_gn,
            mindlin    ? 0.5
            : granular ? 0.0
                       : elastic - 1.0,
            its_own < 0.0 ? of_gn : its_own,
            Tanh::mix(m).slip_min,
            own.kt,
            own.xt};
  }

  static double stored(const ContactLanes<double> &s, const Row<double> &c, const double *h)
  {
    const Vector3<double> d{h[0], h[1], h[2]};
    const bool stores = kind == Friction::SPRING && s.overlap > 0.0;
    return stores ? 0.5 * stiffness(c, s) * dot(d, d) : 0.0;
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
    s.elastic = s.elastic + s.pull_off;
    s.kt = stiffness(c, s);
    if constexpr (granular) s.gt = c.xt * s.gn;
    EndOfContact<Real> end;
    if constexpr (ends) end = end_of<advance>(c, s, h, dt);
    const LastStep<Real> last = last_step(h[3]);
    Real pure = find_normal_force(s, last);
    if constexpr (!advance) pure = select(last.known, last.force, pure);

    auto begins = last.began;
    Beginning<Real> start{one, zero, zero, zero, zero};
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
    if constexpr (kind == Friction::TANH)
      t = Tanh::force({c.mu, c.slip_min}, s.normal_force, present_velocity(s));
    if constexpr (friction) {
      const Vector3<Real> u = present_velocity(s);
      Vector3<Real> d{h[0], h[1], h[2]};
      const Real limit = c.mu * (pure + s.pull_off);
      Real old_limit = c.mu * (last.force + s.pull_off);
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
          const Slide<Real> way{s.kt,     s.gt,      s.overlap, s.overlap + dt * s.normal_velocity,
                                c.spring, c.dashpot, limit,     old_limit,
                                before,   half_way,  u,         f,
                                time,     dt};
          Vector3<Real> slid = slide(way);
          if constexpr (ends) slid = select(begins, first_slide(way), slid);
          d = select(slides, slid, d);
          f = s.kt * d + s.gt * u;
        }
        t = select(slides, with_length(limit, -f), t);
      }
      if constexpr (ends) {
        const Real most = c.mu * (s.critical_force + s.adhesive_share * s.pull_off);
        const Vector3<Real> early = start.spring / start.ratio * dt * s.kt * u;
        const Vector3<Real> sticks = limited(t + early + start.dashpot * s.gt * u, most);
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
    add_pull(s);
    if constexpr (lever_arms)
      add_tangential_in_overlap(s, t);
    else
      add_tangential(s, t);
  }

 private:
  template <class Real>
  TALUS_INLINE static Real stiffness(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    if constexpr (kind == Friction::DASHPOT) return splat<Real>(0.0);
    if constexpr (mindlin) return c.kt * s.contact_radius;
    return granular ? c.kt : s.kt;
  }

  template <class Real> TALUS_INLINE static void add_pull(ContactLanes<Real> &s)
  {
    const Real pull = s.adhesive_share * s.pull_off;
    s.elastic = s.elastic - pull;
    s.normal_force = s.normal_force - pull;
    s.critical_force = s.critical_force + pull;
    s.force = s.force - pull * s.normal;
  }

  /// Of the surfaces, at the time of the positions.
  template <class Real>
  TALUS_INLINE static Vector3<Real> present_velocity(const ContactLanes<Real> &s)
  {
    return surface_velocity_of(s.velocity + s.velocity_change,
                               s.surface_rotation + s.rotation_change, s.normal);
  }

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
    const Real of_gn = c.damping * s.gn * v / select(touches, s.overlap, one);
    const Real growth = dt * v * (of_gn - s.tangent_n) - s.gn * change;
    return select(growth > force, force / select(growth > zero, growth, one), one);
  }

  /// Of friction where the overlap is 0 and the normal force is that of damping, with gn over gt of
  /// now; 0 if it goes faster to 0 than gt.
  template <class Real>
  TALUS_INLINE static Real limit_at_begin(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), limit = -c.mu * s.gn * s.normal_velocity;
    return select((limit > zero) & (c.damping <= c.dashpot), limit, zero) + c.mu * s.pull_off;
  }

  template <Of which, class Real>
  static Beginning<Real> errors_of(const Row<Real> &c, Real overlap, const Edge<Real> &edge)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), p = c.elastic;
    const Real ratio = select(edge.is, edge.reach / select(edge.is, overlap, one), one);
    const Real later = which == Of::BEGIN ? edge.theta : edge.theta - one;
    const Real first = hurwitz_zeta(p, edge.theta), next = next_hurwitz_zeta(p, edge.theta);
    const Real elastic = first + edge.bend * ((0.5 * p + one) * next - later * first);
    const auto of = [&](Real q) {
      return select(edge.is, power(ratio, q) * hurwitz_zeta(q, edge.theta), zero);
    };
    Beginning<Real> all{ratio, select(edge.is, power(ratio, p) * elastic, zero), of(c.damping),
                        zero, zero};
    all.spring = all.elastic;
    all.dashpot = all.damping;
    if constexpr (granular) all.spring = of(c.spring + one);
    if (any(c.dashpot < c.damping)) all.dashpot = of(c.dashpot);
    return all;
  }

  /// push A dt^p times the second term, where `elastic` is the force now.
  template <Of which, class Real>
  static Real second_force(const Row<Real> &c, const ContactLanes<Real> &s,
                           const Beginning<Real> &start, Real elastic, const Edge<Real> &edge,
                           double dt)
  {
    const Real zero = splat<Real>(0.0);
    const Real most = power(start.ratio, c.elastic) * elastic;
    const Real push = dt * dt * s.inverse_mass * most / edge.reach;
    const Real force = push * most * second_term<which>(c.elastic, edge.theta);
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
    const auto damped = (s.gn * v > zero) & (c.damping < c.elastic);
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
    if constexpr (kind == Friction::TANH)
      end.tangential = Tanh::force({c.mu, c.slip_min}, end.normal_force, surface_velocity(s));
    if constexpr (friction) {
      const Vector3<Real> now = turned_by(half_turn(s, dt), d, s.normal), u = surface_velocity(s);
      const Vector3<Real> within = -(s.kt * now + s.gt * u);
      Vector3<Real> stuck = end_of_sticking(within, -dt * s.kt * u, c.mu * last.force, edge.theta);
      auto slid = last.slid;
      const auto adheres = s.pull_off > zero;
      if (any(adheres)) {    // the limit does not end at 0, what vanishes with the overlap sticks
        slid = slid & ((s.pull_off <= zero) |
                       ((kind == Friction::DASHPOT ? c.dashpot : c.spring) <= zero));
        const Real of_spring = power(error.ratio, c.spring) * hurwitz_zeta(c.spring, edge.theta);
        stuck = select(adheres, of_spring * s.kt * now + error.dashpot * s.gt * u, stuck);
      }
      const Real limit = end.normal_force + end.adhesive_share * s.pull_off;
      end.tangential =
          select(slid, with_length(c.mu * limit, within), select(edge.is, stuck, end.tangential));
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
