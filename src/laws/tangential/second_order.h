// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts that dissipate, to second order in the time step: what the words `tangential multistep
// ... slider midpoint` and `tangential none`, and plaincoulomb, mean with `order 2` of the
// integrator. Positions belong to the time t, velocities to t - lag, lag = dt/2; velocity_change is
// lag times the acceleration of the last step, so that velocity + velocity_change is second order
// at t. The laws come after the damping and find the normal force again. What makes the order two:
//
//   * damping at the time of the positions, implicit in the contact itself: with F_0, its normal
//     force of the last step, and v_p = v_n + dv_n - lag F_0/m, what others contribute,
//     F = (F_e - gn v_p)/(1 + gn lag/m), not below 0;
//   * in the step in which a contact begins, t = theta dt after it did, the sum over time steps of
//     a force A t^p has the error A dt^p zeta(-p, theta), Hurwitz' zeta function (Euler-Maclaurin
//     for a sum that does not begin on a grid point): it is subtracted. p: exponents of elastic
//     force and damping. Only if the overlap is at most what one step brings;
//   * where it ends the same, see end_of_contact.h;
//   * contacts whose normal law has adhesion of its own: see adhesive_contact.h;
//   * the displacement, and the return of a sliding contact to its limit: see midpoint.h.
//
// After the displacement the history holds what the contact did in the last step (see Past), from
// which its force can be computed again without advancing, and F_0. See change_of_order.h on
// contacts that come from a run with order 1.

#ifndef TALUS_LAWS_TANGENTIAL_SECOND_ORDER_H
#define TALUS_LAWS_TANGENTIAL_SECOND_ORDER_H

#include "laws/tangential/event_errors.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/midpoint.h"
#include "laws/tangential/scaled_spring.h"
#include "laws/tangential/second_order_end.h"
#include "laws/tangential/set_back.h"
#include "laws/tangential/tanh.h"

namespace Talus {

/// `Granular`: the law of LAMMPS' pair granular that it is, with its kt, xt and lever arms.
template <Friction kind, class Granular = void, Adhesion adhesion_of_normal_law = Adhesion::NO>
struct SecondOrder : FrictionLaw,
                     SecondOrderEnd<SecondOrderKind<kind, Granular, adhesion_of_normal_law>> {
  using Kind = SecondOrderKind<kind, Granular, adhesion_of_normal_law>;
  using Kind::adhesive, Kind::follows_radius, Kind::friction, Kind::granular, Kind::of_force,
      Kind::rescales, Kind::scaled;
  using Parts = SecondOrderParts<Kind>;
  using Parts::add_adhesion, Parts::displacement_of, Parts::elastic_force_of,
      Parts::find_normal_force, Parts::grows_to_limit, Parts::limit_at_begin, Parts::mean_at_begin,
      Parts::present_velocity, Parts::radius_ratio, Parts::share_at_begin, Parts::stiffness;
  static constexpr const char *name = [] {    // of the law that it is
    if constexpr (granular) return Granular::name;
    constexpr const char *names[] = {"none", "multistep", "dashpot", Tanh::name};
    return names[static_cast<int>(kind)];
  }();
  static constexpr const char *label = [] {
    if constexpr (granular) return Granular::label;
    constexpr const char *labels[] = {nullptr, "multistep slider midpoint", "dashpot", Tanh::label};
    return labels[static_cast<int>(kind)];
  }();
  static constexpr int odd_history = 3, even_history = 2;
  static constexpr bool second_order = true, lever_arms = granular, needs_radius = scaled;
  static constexpr bool has_spring = kind == Friction::SPRING, is_midpoint = true;
  static constexpr bool stiffens = scaled && !rescales, reads_stiffness = friction && !granular;
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
    const Law &normal = m.a.law.normal(), &damping = m.a.law.damping();
    const double elastic = normal.exponent;
    const double of_gn = damping.damping_exponent(elastic);
    const double of_gt = granular ? -1.0 : damping.dashpot_exponent(elastic);
    GranularRow<double> granular_row{};
    if constexpr (granular) granular_row = Granular::mix(m);
    const bool jumps = normal.lasts_beyond_contact && m.geometric("gamma") > 0.0;
    return {kind == Friction::NONE ? 0.0 : m.friction("mu"),
            jumps ? 1.0 : elastic,
            of_gn,
            scaled     ? 0.5
            : granular ? 0.0
                       : elastic - 1.0,
            of_gt < 0.0 ? of_gn : of_gt,
            Tanh::mix(m).slip_min,
            granular_row.kt,
            granular_row.xt};
  }

  static double stored(const ContactLanes<double> &s, const Row<double> &c, const double *h)
  {
    if (!has_spring) return 0.0;
    const double k = stiffness(c, s);
    const Vector3<double> d = displacement_of(k, h);
    return 0.5 * k * dot(d, d);
  }

  /// Contacts that begin or end in this step; few do. Elsewhere compute<true, false>() is enough,
  /// with the same bits. `past`: number first_even of its history.
  static constexpr int first_even = odd_history;
  template <class Real> TALUS_INLINE static bool_of<Real> at_event(Real separated, Real past)
  {
    const Real zero = splat<Real>(0.0);
    return (past >= zero) | (separated > zero);
  }

  template <bool advance, bool ends = true, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *h, double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    s.adhesive_share = one;
    if constexpr (adhesive) s.elastic = s.elastic + s.pulloff_force;
    s.kt = stiffness(c, s);
    if constexpr (granular) s.gt = c.xt * s.gn;
    EndOfContact<Real> end;
    if constexpr (ends) end = SecondOrderEnd<Kind>::template end_of<advance>(c, s, h, dt);
    const LastStep<Real> last = last_step(h[3], h[4]);
    Real pure = find_normal_force(s, last);
    if constexpr (!advance) pure = select(last.is_given, last.force, pure);

    bool_of<Real> begins = advance ? zero > zero : last.began;
    EventErrors<Real> start{one, zero, zero, zero, zero};
    const Real rubs = s.elastic;
    Real force = pure, theta = one, undamped = rubs;
    if constexpr (ends) {
      const Real approach = -dt * s.normal_velocity;
      if constexpr (advance)
        begins = (h[3] >= zero) & (s.lag > zero) & (approach + approach >= s.overlap);
      const Real others = 2.0 * dot(s.velocity_change, s.normal);
      const EventStep<Real> event =
          event_step<Event::BEGIN>(s, s.overlap, s.normal_velocity, others, begins, dt);
      begins = event.happens;
      start = errors_of<Event::BEGIN, granular, adhesive>(c, s.overlap, event,
                                                          share_of_jump<adhesive>(c, s));
      theta = event.theta;
      s.adhesive_share = select(begins, share_at_begin(theta), one);    // p = 0
      const Real early = start.elastic * s.elastic -
                         second_force<Event::BEGIN, adhesive>(c, s, start, s.elastic, event, dt);
      force = pure - (early - start.damping * s.gn * s.normal_velocity);
      if constexpr (advance) s.elastic = s.elastic - early;    // what does not store is work
      if constexpr (adhesive) undamped = undamped - early;
    }
    s.normal_force = force;
    s.critical_force = adhesive ? undamped : magnitude(force);
    s.force = force * s.normal;
    if constexpr (ends) s.uncorrected_force = (adhesive ? rubs : pure) + s.pulloff_force;

    auto slides = last.slid;
    Vector3<Real> t{zero, zero, zero};
    if constexpr (kind == Friction::TANH)
      t = Tanh::force({c.mu, c.slip_min}, s.normal_force, present_velocity(s));
    if constexpr (friction) {
      const Vector3<Real> u = present_velocity(s);
      Vector3<Real> d = displacement_of(s.kt, h);
      AdhesiveStep<Real> before_it{};
      if constexpr (adhesive && advance)
        before_it = adhesive_step(s, rubs, detaches<adhesive>(c), dt);
      const Real limit = c.mu * (adhesive ? rubs + s.pulloff_force : pure);
      Real old_limit = c.mu * last.force;
      if constexpr (adhesive && advance)
        old_limit = c.mu * (before_it.old_elastic + s.pulloff_force);
      if constexpr (ends && advance)
        old_limit = select(last.known, old_limit, select(begins, limit_at_begin(c, s), limit));
      if constexpr (advance && !adhesive) {
        const Real none = splat<Real>(no_force);
        const auto returns = last.is_given & (last.force < none) & (pure > none);
        if (any(returns))
          theta = select(returns, share_since_return(s, c.damping, pure, dt), theta);
      }
      const Real time = dt * theta;
      Vector3<Real> before = d, half_way = u;
      if constexpr (advance) {
        const Vector3<Real> q = half_turn(s, dt);
        before = turned_by(q, d, s.normal);
        half_way = velocity_half_way(s, q);
        Real mean = one;
        if constexpr (follows_radius) {
          const SpringStep<Real> step = spring_step<of_force, rescales>(radius_ratio(c, s, dt));
          before = step.share * before;
          mean = select(begins, mean_at_begin(c), step.mean);
        }
        d = before + (mean * time) * half_way;
      }
      Vector3<Real> f = (advance ? s.kt * d : elastic_force_of(s.kt, h)) + s.gt * u;
      const auto exceeds = dot(f, f) > limit * limit;
      slides = advance ? exceeds : slides | exceeds;
      t = -f;
      if (any(slides)) {
        if constexpr (advance) {
          Slide<Real> way{s.kt,     s.gt,      s.overlap, s.overlap + dt * s.normal_velocity,
                          c.spring, c.dashpot, limit,     old_limit,
                          before,   half_way,  u,         f,
                          time,     dt};
          if constexpr (adhesive) {
            way.overlap = before_it.overlap;
            way.old_overlap = before_it.old_overlap;
          }
          if constexpr (follows_radius) {    // which has no dashpot
            const Real longest = limit / select(s.kt > zero, s.kt, one);
            d = select(slides, midpoint_return(d, before, longest), d);
          } else {
            Vector3<Real> slid = slide(way);
            if constexpr (ends && adhesive) {    // of jkr they are above 0 there
              way.kt_exponent = select(detaches<adhesive>(c), zero, c.spring);
              way.gt_exponent = select(detaches<adhesive>(c), zero, c.dashpot);
            }
            if constexpr (ends) slid = select(begins, first_slide(way), slid);
            d = select(slides, slid, d);
          }
          f = s.kt * d + s.gt * u;
        }
        t = select(slides, with_length(limit, -f), t);
      }
      if constexpr (ends) {
        Real most = c.mu * s.critical_force;
        if constexpr (adhesive) {
          const Real p = select(detaches<adhesive>(c), one, c.spring + one);
          const Vector3<Real> trial = (mean_at_begin(c) * time * s.kt + s.gt) * u;
          most = most + c.mu * s.adhesive_share * s.pulloff_force -
                 grows_to_limit(c, s, p, limit_at_begin(c, s), trial, theta);
        }
        const Vector3<Real> early = start.spring / start.ratio * dt * (mean_at_begin(c) * s.kt) * u;
        const Vector3<Real> sticks = limited(t + early + start.dashpot * s.gt * u, most);
        t = select(begins, select(slides, with_length(most, t), sticks), t);
      }
      if constexpr (advance) {
        const Vector3<Real> kept = of_force ? -(s.kt * d) : d;
        h[0] = kept.x;
        h[1] = kept.y;
        h[2] = kept.z;
      }
    }
    if constexpr (advance) {
      h[3] = -one - select(begins, one, zero) - select(slides, splat<Real>(2.0), zero);
      h[4] = pure;
    }
    if constexpr (ends) end.replace(s, t, h);
    if constexpr (adhesive) add_adhesion(s);
    if constexpr (lever_arms)
      add_tangential_in_overlap(s, t);
    else
      add_tangential(s, t);
  }
};

}    // namespace Talus

#endif
