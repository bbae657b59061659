// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contacts of second order do otherwise whose normal law has adhesion of its own, dmt and jkr;
// see second_order.h. The pull-off force F_p is taken out of the elastic force before and added
// again behind with the share of p = 0, so that what is left, r = F_e + F_p, is never below 0.
//
//   * Damping is not limited, the normal force has either sign: -gn v ends with a jump or as the
//     damping coefficient does.
//   * Friction is limited by mu (r + F_p), without damping, above 0 at both ends.
//   * r of dmt is Hertz' force. That of jkr begins, at overlap 0, with F_p/9 and goes on with a
//     slope, and all coefficients are above 0 there: p = 0 and 1. It ends by pull-off where the
//     attraction is largest, r = dr/d overlap = 0: r needs nothing at this end, all the rest is p =
//     0. (Johnson, Kendall and Roberts 1971: F_e = -8/9 F_p at overlap 0, -F_p where it separates
//     under load.)

#ifndef TALUS_LAWS_TANGENTIAL_ADHESIVE_CONTACT_H
#define TALUS_LAWS_TANGENTIAL_ADHESIVE_CONTACT_H

#include "base/power.h"
#include "laws/tangential/midpoint.h"

namespace Talus {

/// r of jkr at overlap 0, over F_p.
inline constexpr double jkr_begin = 1.0 / 9.0;

/// A friction that grows as t^p from the begin of a contact on, is `trial` after the time t and
/// limited to less, or falls so to its end: what its integral lacks of limit t, over that. For p = 0,
/// 1/2, 1, 3/2; laws with adhesion have no others.
template <class Real> TALUS_INLINE Real missing_share(Real limit, Real trial, Real p)
{
  const Real one = splat<Real>(1.0), ratio = limit / trial, square = ratio * ratio;
  const Real x = select(p < splat<Real>(0.75), square,
                        select(p < splat<Real>(1.25), ratio, cube_root(square)));
  return select(p < splat<Real>(0.25), splat<Real>(0.0), x * p / (one + p));
}

/// 0 where `by` is not above it.
template <class Real> TALUS_INLINE Real quotient(Real x, Real by)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  return select(by > zero, x / select(by > zero, by, one), zero);
}

/// d overlap/da of jkr, 2 a/R - sqrt(pi gamma/(E a)), at the contact radius a; kn = 4/3 E a of the
/// present one, F_p = 3 pi gamma R.
template <class Real> TALUS_INLINE Real jkr_slope(const ContactLanes<Real> &s, Real a)
{
  const Real of_now = quotient(4.0 / 9.0 * s.pulloff_force, s.radius * s.kn);
  return 2.0 * a / s.radius - square_root(of_now * quotient(s.contact_radius, a));
}

/// Contact radius of jkr before the overlap grew by `way`, over that of now; by the midpoint rule.
template <class Real> TALUS_INLINE Real jkr_radius_ratio(const ContactLanes<Real> &s, Real way)
{
  const Real zero = splat<Real>(0.0), a = s.contact_radius;
  const Real half_way = a - 0.5 * quotient(way, jkr_slope(s, a));
  const Real old = a - quotient(way, jkr_slope(s, half_way));
  return quotient(select(old > zero, old, zero), a);
}

/// What stiffness and dashpot of a contact that slides follow in the place of the overlap: of jkr
/// the square of the contact radius. The elastic force a step ago with F_p in it.
template <class Real> struct AdhesiveStep {
  Real overlap, old_overlap, old_elastic;
};

/// `rest`: r. `detaches`: the law is jkr.
template <class Real>
TALUS_INLINE AdhesiveStep<Real> adhesive_step(const ContactLanes<Real> &s, Real rest,
                                              bool_of<Real> detaches, double dt)
{
  const Real zero = splat<Real>(0.0);
  const auto not_negative = [&](Real x) { return select(x > zero, x, zero); };
  const Real way = -dt * s.normal_velocity, old_overlap = not_negative(s.overlap - way);
  AdhesiveStep<Real> step{s.overlap, old_overlap,
                          rest * power(quotient(old_overlap, s.overlap), splat<Real>(1.5))};
  if (!any(detaches)) return step;
  const Real a = s.contact_radius, old_a = not_negative(a - quotient(way, jkr_slope(s, a)));
  step.overlap = select(detaches, a * a, step.overlap);
  step.old_overlap = select(detaches, old_a * old_a, step.old_overlap);
  step.old_elastic = select(detaches, not_negative(rest - s.tangent_n * way), step.old_elastic);
  return step;
}

}    // namespace Talus

#endif
