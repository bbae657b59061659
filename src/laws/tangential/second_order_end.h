// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Of the law of second_order.h, the step after the last one of a contact, see end_of_contact.h.

#ifndef TALUS_LAWS_TANGENTIAL_SECOND_ORDER_END_H
#define TALUS_LAWS_TANGENTIAL_SECOND_ORDER_END_H

#include "laws/tangential/event_errors.h"
#include "laws/tangential/midpoint.h"
#include "laws/tangential/second_order_parts.h"
#include "laws/tangential/set_back.h"
#include "laws/tangential/tanh.h"

namespace Talus {

template <class Kind> struct SecondOrderEnd : SecondOrderParts<Kind> {
  using Kind::adhesive, Kind::friction, Kind::granular, Kind::of_force, Kind::rescales;
  using Parts = SecondOrderParts<Kind>;
  using Parts::displacement_of, Parts::grows_to_limit;
  template <class Real> using Row = SecondOrderRow<Real>;

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
    if constexpr (Kind::kind == Friction::TANH)
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
