// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Errors of the sum over the time steps of the forces of a contact in the step in which it begins
// or behind the one in which it ends, by the exponents with which they do; see second_order.h.
// `granular`: laws of LAMMPS' pair granular, whose springs have an exponent of their own.
// `adhesive`: see adhesive_contact.h.

#ifndef TALUS_LAWS_TANGENTIAL_EVENT_ERRORS_H
#define TALUS_LAWS_TANGENTIAL_EVENT_ERRORS_H

#include "laws/tangential/adhesive_contact.h"
#include "laws/tangential/end_of_contact.h"
#include "laws/tangential/hurwitz_zeta.h"

namespace Talus {

/// Errors of the sum over time steps in the step in which a contact begins, as factors of forces of
/// that step. Elsewhere 0, and the ratio below 1.
template <class Real> struct EventErrors {
  Real ratio;                                ///< what one step brings of overlap, over overlap
  Real elastic, damping, spring, dashpot;    ///< the last two tangential
};

/// Exponents of the overlap; slip_min of tanh; kt, xt of LAMMPS' laws.
template <class Real> struct SecondOrderRow {
  Real mu, elastic, damping, spring, dashpot, slip_min, kt, xt;
};

/// The normal law is jkr: contacts end by pull-off, and the elastic force and what depends on it
/// begin with a jump.
template <bool adhesive, class Real>
TALUS_INLINE bool_of<Real> detaches(const SecondOrderRow<Real> &c)
{
  return c.elastic < splat<Real>(adhesive ? 1.25 : 0.0);
}

/// Of the elastic force.
template <bool adhesive, class Real>
TALUS_INLINE Real share_of_jump(const SecondOrderRow<Real> &c, const ContactLanes<Real> &s)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  if constexpr (!adhesive) return zero;
  const Real share = jkr_begin * s.pulloff_force / select(s.elastic > zero, s.elastic, one);
  return select(detaches<adhesive>(c), select(share < one, share, one), zero);
}

/// `jump`: share of the elastic force that begins with p = 0; 0 of laws other than jkr.
template <Event which, bool granular, bool adhesive, class Real>
EventErrors<Real> errors_of(const SecondOrderRow<Real> &c, Real overlap,
                            const EventStep<Real> &event, Real jump)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), p = c.elastic;
  const Real ratio =
      select(event.happens, event.step_overlap / select(event.happens, overlap, one), one);
  const Real later = which == Event::BEGIN ? event.theta : event.theta - one;
  const Real first = hurwitz_zeta(p, event.theta), next = next_hurwitz_zeta(p, event.theta);
  const Real elastic = first + event.curvature * ((0.5 * p + one) * next - later * first);
  const auto of = [&](Real q) {
    return select(event.happens, power(ratio, q) * hurwitz_zeta(q, event.theta), zero);
  };
  EventErrors<Real> all{ratio, select(event.happens, power(ratio, p) * elastic, zero),
                        of(c.damping), zero, zero};
  all.spring = all.elastic;
  all.dashpot = all.damping;
  if constexpr (granular) all.spring = of(c.spring + one);
  if (any(c.dashpot < c.damping)) all.dashpot = of(c.dashpot);
  if constexpr (adhesive) {
    const auto at_once = detaches<adhesive>(c);
    const Real of_jump = of(zero);
    all.elastic = select(at_once, jump * of_jump + (one - jump) * all.elastic, all.elastic);
    all.damping = select(at_once, of_jump, all.damping);
    all.dashpot = select(at_once, of_jump, all.dashpot);
    all.spring = select(at_once, of(one), all.spring);
  }
  return all;
}

/// push A dt^p times the second term, where `elastic` is the force now.
template <Event which, bool adhesive, class Real>
Real second_force(const SecondOrderRow<Real> &c, const ContactLanes<Real> &s,
                  const EventErrors<Real> &start, Real elastic, const EventStep<Real> &event,
                  double dt)
{
  const Real zero = splat<Real>(0.0);
  const Real most = power(start.ratio, c.elastic) * elastic;
  const Real push = dt * dt * s.inverse_mass * most / event.step_overlap;
  const Real force = push * most * second_term<which>(c.elastic, event.theta);
  const auto has_one = event.happens & (c.elastic >= splat<Real>(adhesive ? 1.25 : 0.0));
  return select(has_one, which == Event::BEGIN ? -force : force, zero);
}

}    // namespace Talus

#endif
