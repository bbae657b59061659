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

#include "laws/rounding.h"
#include "laws/tangential/adhesive_contact.h"
#include "laws/tangential/common.h"
#include "laws/tangential/end_of_contact.h"
#include "laws/tangential/event_errors.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/midpoint.h"
#include "laws/tangential/scaled_spring.h"
#include "laws/tangential/set_back.h"
#include "laws/tangential/tanh.h"

#include <type_traits>

namespace Talus {

/// What the history tells of the last step of a contact.
template <class Real> struct LastStep {
  bool_of<Real> known;       ///< it was there
  bool_of<Real> is_given;    ///< with a force that is known
  Real force;                ///< normal one, 0 if not
  bool_of<Real> began, slid;
};

template <class Real> TALUS_INLINE LastStep<Real> last_step(Real past, Real force)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), two = splat<Real>(2.0);
  const bool_of<Real> known = past < zero;
  const bool_of<Real> is_given = known & (past > splat<Real>(Past::of_order_1));
  const Real flags = -past - one;
  const bool_of<Real> slid = is_given & (flags >= two);
  const bool_of<Real> began = is_given & (select(slid, flags - two, flags) >= one);
  return {known, is_given, select(is_given, force, zero), began, slid};
}

/// DASHPOT: a spring without stiffness. TANH: that of tanh.h, with the velocity at the time of the
/// positions.
enum class Friction { NONE, SPRING, DASHPOT, TANH };

/// Whether the normal law has adhesion of its own, see adhesive_contact.h.
enum class Adhesion : bool { NO, YES };

/// What a spring does when its stiffness changes: nothing if it has none of its own.
template <class Granular> struct SpringOf {
  static constexpr bool scaled = Granular::needs_radius, of_force = Granular::of_force,
                        rescales = Granular::rescales;
};
template <> struct SpringOf<void> {
  static constexpr bool scaled = false, of_force = false, rescales = false;
};

/// `Granular`: the law of LAMMPS' pair granular that it is, with its kt, xt and lever arms.
template <Friction kind, class Granular = void, Adhesion adhesion_of_normal_law = Adhesion::NO>
struct SecondOrder : FrictionLaw {
  static constexpr bool friction = kind == Friction::SPRING || kind == Friction::DASHPOT;
  static constexpr bool granular = !std::is_void_v<Granular>;
  static constexpr bool scaled = SpringOf<Granular>::scaled;
  static constexpr bool of_force = SpringOf<Granular>::of_force;
  static constexpr bool rescales = SpringOf<Granular>::rescales;
  static constexpr bool follows_radius = of_force || rescales;
  static constexpr bool adhesive = adhesion_of_normal_law == Adhesion::YES;
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
    if constexpr (ends) end = end_of<advance>(c, s, h, dt);
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

 private:
  template <class Real>
  TALUS_INLINE static Real stiffness(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    if constexpr (kind == Friction::DASHPOT) return splat<Real>(0.0);
    if constexpr (scaled) return c.kt * s.contact_radius;
    return granular ? c.kt : s.kt;
  }

  /// For p = 0. Never exactly 1: other stages recognize by it contacts that begin.
  template <class Real> TALUS_INLINE static Real share_at_begin(Real theta)
  {
    const Real one = splat<Real>(1.0), share = splat<Real>(0.5) + theta;
    return select(magnitude(share - one) > splat<Real>(0.0), share, splat<Real>(1.0 + 1.0e-15));
  }

  /// The history of a spring is its displacement or, with the sign of the laws of order 1, its
  /// force.
  template <class Real> TALUS_INLINE static Vector3<Real> displacement_of(Real kt, const Real *h)
  {
    const Vector3<Real> kept{h[0], h[1], h[2]};
    if constexpr (!of_force) return kept;
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    return select(kt > zero, splat<Real>(-1.0) / select(kt > zero, kt, one), zero) * kept;
  }
  template <class Real> TALUS_INLINE static Vector3<Real> elastic_force_of(Real kt, const Real *h)
  {
    const Vector3<Real> kept{h[0], h[1], h[2]};
    return of_force ? -kept : kt * kept;
  }

  /// SpringStep::mean of the step in which a contact begins, its contact radius at 0 or, of jkr,
  /// above it.
  template <class Real> TALUS_INLINE static Real mean_at_begin(const Row<Real> &c)
  {
    const Real one = splat<Real>(1.0);
    if constexpr (!of_force) return one;
    return select(detaches<adhesive>(c), one, splat<Real>(2.0 / 3.0));
  }

  /// Contact radius a step ago over that of now.
  template <class Real>
  TALUS_INLINE static Real radius_ratio(const Row<Real> &c, const ContactLanes<Real> &s, double dt)
  {
    const Real zero = splat<Real>(0.0), v = s.normal_velocity;
    const Real way = -dt * (v - 0.5 * dt * centrifugal(s, v)), old = s.overlap - way;
    const Real ratio = square_root(quotient(select(old > zero, old, zero), s.overlap));
    if constexpr (!adhesive) return ratio;
    const auto at_once = detaches<adhesive>(c);
    return any(at_once) ? select(at_once, jkr_radius_ratio(s, way), ratio) : ratio;
  }

  template <class Real> TALUS_INLINE static void add_adhesion(ContactLanes<Real> &s)
  {
    const Real adhesion = s.adhesive_share * s.pulloff_force;
    s.elastic = s.elastic - adhesion;
    s.normal_force = s.normal_force - adhesion;
    s.critical_force = s.critical_force + adhesion;
    s.force = s.force - adhesion * s.normal;
  }

  /// Of the surfaces, at the time of the positions.
  template <class Real>
  TALUS_INLINE static Vector3<Real> present_velocity(const ContactLanes<Real> &s)
  {
    return surface_velocity_of(s.velocity + s.velocity_change,
                               s.surface_rotation + s.rotation_change, s.normal);
  }

  /// Rounded as in the history; without adhesion above zero.
  template <class Real>
  TALUS_INLINE static Real find_normal_force(const ContactLanes<Real> &s,
                                             const LastStep<Real> &last)
  {
    const Real one = splat<Real>(1.0), least = splat<Real>(zero_force);
    const Real by_others = dot(s.velocity_change, s.normal) - s.lag * s.inverse_mass * last.force;
    const Real v = s.normal_velocity + by_others;
    const Real force = (s.elastic - s.gn * v) / (one + s.gn * s.lag * s.inverse_mass);
    return rounded<47>(adhesive ? force : select(force > least, force, least));
  }

  /// Of friction where the overlap is 0 and the normal force is that of damping, with gn over gt of
  /// now; 0 if it goes faster to 0 than gt.
  template <class Real>
  TALUS_INLINE static Real limit_at_begin(const Row<Real> &c, const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), limit = -c.mu * s.gn * s.normal_velocity;
    if constexpr (adhesive)
      return c.mu *
             (s.pulloff_force + select(detaches<adhesive>(c), jkr_begin * s.pulloff_force, zero));
    return select((limit > zero) & (c.damping <= c.dashpot), limit, zero);
  }

  /// What friction at a limit that is above 0 at the ends of a contact lacks, because it grows to it
  /// there: as a spring, `of_spring`, or as a dashpot.
  template <class Real>
  static Real grows_to_limit(const Row<Real> &c, const ContactLanes<Real> &s, Real of_spring,
                             Real limit, const Vector3<Real> &trial, Real theta)
  {
    const Real zero = splat<Real>(0.0), size = square_root(dot(trial, trial));
    const auto exceeds = size > limit;
    const Real of_dashpot = select(detaches<adhesive>(c), zero, c.dashpot);
    const Real p = select(s.kt > zero, of_spring, of_dashpot);
    const Real share = missing_share(limit, select(exceeds, size, splat<Real>(1.0)), p);
    return select(exceeds, theta * limit * share, zero);
  }

  /// Of contacts that have ended. Those that touch again begin as new ones.
  template <bool advance, class Real>
  static EndOfContact<Real> end_of(const Row<Real> &c, const ContactLanes<Real> &s, Real *h,
                                   double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real v = s.normal_velocity;
    EndOfContact<Real> end;
    end.separated = s.separated > zero;
    const LastStep<Real> last = last_step(-magnitude(h[3]), h[4]);
    const Real left_over = s.overlap + s.pulloff_distance;    // until it ends
    auto ends = end.separated & (left_over > zero) & (h[3] > zero);
    if constexpr (advance) ends = end.separated & (left_over > zero) & (h[3] < zero);

    Real until = left_over, left = s.elastic;
    auto pressed = ends;
    if constexpr (!adhesive) {    // limited damping: the force ends before the overlap
      const auto damped = (s.gn * v > zero) & (c.damping < c.elastic);
      until = s.overlap - select(damped, s.gn * v / select(damped, s.kn, one), zero);
      pressed = ends & (last.force > splat<Real>(no_force));
      left = s.elastic - s.gn * v;
    }
    const Real others =
        2.0 * (dot(s.velocity_change, s.normal) - s.lag * s.inverse_mass * last.force);
    const EventStep<Real> event = event_step<Event::END>(s, until, v, others, pressed, dt);
    const EventErrors<Real> error =
        errors_of<Event::END, granular, adhesive>(c, until, event, zero);
    const Real sum =
        error.elastic * left - second_force<Event::END, adhesive>(c, s, error, left, event, dt);
    end.normal_force = end.elastic = select(event.happens, -sum, zero);
    if constexpr (adhesive) {
      end.elastic = select(detaches<adhesive>(c), zero, end.elastic);
      end.normal_force = end.elastic + error.damping * s.gn * v;
    }
    const Real way = select(ends, dt * (v - 0.5 * dt * centrifugal(s, v)), one);
    end.adhesive_share = select(ends, left_over / way - splat<Real>(0.5), zero);

    const Vector3<Real> d = displacement_of(s.kt, h);
    end.tangential = {zero, zero, zero};
    if constexpr (kind == Friction::TANH)
      end.tangential = Tanh::force({c.mu, c.slip_min}, end.normal_force, surface_velocity(s));
    if constexpr (friction) {
      const Vector3<Real> now = turned_by(half_turn(s, dt), d, s.normal), u = surface_velocity(s);
      const Vector3<Real> within = -(s.kt * now + s.gt * u);
      Real limit = c.mu * end.normal_force;
      auto slid = last.slid;
      if constexpr (adhesive) {    // the limit does not end at 0, what vanishes before it sticks
        limit = c.mu * (end.elastic + end.adhesive_share * s.pulloff_force);
        const auto at_once = detaches<adhesive>(c);
        const Real p = select(at_once, zero, end_exponent<of_force, rescales>(c.spring));
        const auto by_dashpot = s.kt <= zero;
        limit = limit - grows_to_limit(c, s, p, c.mu * s.pulloff_force, within, event.theta);
        slid = slid & (by_dashpot | (p <= zero));
        const Real of_spring = power(error.ratio, p) * hurwitz_zeta(p, event.theta);
        const Vector3<Real> stuck = of_spring * s.kt * now + error.dashpot * s.gt * u;
        end.tangential = select(event.happens, stuck, end.tangential);
      } else {
        const Vector3<Real> rate = -dt * s.kt * u;
        end.tangential =
            select(event.happens, end_of_sticking(within, rate, c.mu * last.force, event.theta),
                   end.tangential);
      }
      end.tangential = select(slid, with_length(limit, within), end.tangential);
    }
    for (int n = 0; n < 3; n++) end.history[n] = select(ends, h[n], zero);
    end.history[3] =
        select(ends & last.is_given, one + select(last.slid, splat<Real>(2.0), zero), zero);
    end.history[4] = select(ends, last.force, zero);
    const auto again = (h[3] > zero) & (s.separated <= zero);
    for (int n = 0; n < 3; n++) h[n] = select(again, zero, h[n]);
    return end;
  }
};

}    // namespace Talus

#endif
