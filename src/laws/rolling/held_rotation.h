// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Coulomb's law of rotation to second order in the time step: while a relative rotation w is not 0
// a moment of the size `most` is against it, else the moment is what keeps it at 0. Used by rolling
// and spinning resistance with `order 2`, see holding_order_2.h. All moments here are in units of
// w, times what a unit of moment changes it in a step.
//
// What other contacts do to w is known of the last step: change, the half of what w has changed in
// it, and the moment of this contact then tell their part, others = 2 change + own.
//   * If they were steady, the flow w' = others - most w/|w| is followed through the step, exactly
//     where w comes to rest within the step or goes through 0.
//   * What is at rest is held by M = own + share (w + 2 change): by that much more as a share of it
//     would stop the rotation within the step. The share because a body may have many contacts of
//     which each is held so. With g of them on one rotation the errors of successive steps obey
//     e'' = (2 - 2 g) e' - (1 - g) e, stable for g < 4/3: g is 8 shares in a crystal of spheres
//     with 12 neighbors, each of which turns as well and of which each sees 2/3 of a rotation.
//   * If the moment of the others has jumped, their other contacts come to rest or react to this
//     one: then the share also brings a contact to rest, so that they do not push each other on.
//
// A contact remembers the moment, what others do over `most`, not above `widest`, and whether it
// moved: in as many doubles as the moment has components.

#ifndef TALUS_LAWS_ROLLING_HELD_ROTATION_H
#define TALUS_LAWS_ROLLING_HELD_ROTATION_H

#include "base/number_pair.h"
#include "base/vector3.h"
#include "laws/tangential/set_back.h"

namespace Talus {

inline constexpr double held_share = 0.15;    ///< 8 of them below 4/3
inline constexpr double steady_jump = 0.2;    ///< of what others do over `most`

/// Of the last step.
template <class Real> struct HeldRotation {
  Vector3<Real> own, others;    ///< moment; what others did over `most`
  bool_of<Real> moved;
};

/// Of a contact that was not there all numbers are zero.
template <class Real> TALUS_INLINE HeldRotation<Real> held_rotation(const Real *stored)
{
  constexpr double widest = 16.0;
  const Real zero = splat<Real>(0.0), half = splat<Real>(0.5);
  const Real x = EvenPair::second(stored[0]);
  const auto rests = x < zero;
  const auto known = magnitude(stored[0]) > zero;
  const Real in_x = select(known, 4.0 * widest * (x - select(rests, -half, half)), zero);
  return {{EvenPair::first(stored[0]), EvenPair::first(stored[1]), EvenPair::first(stored[2])},
          {in_x, widest * EvenPair::second(stored[1]), widest * EvenPair::second(stored[2])},
          x >= zero};
}

/// The moment as it is remembered; never 0.
template <class Real> TALUS_INLINE Vector3<Real> as_remembered(const Vector3<Real> &moment)
{
  const Real zero = splat<Real>(0.0), least = splat<Real>(1.0e-200);
  const auto one = [&](Real a) { return EvenPair::first(select(magnitude(a) > zero, a, least)); };
  return {one(moment.x), one(moment.y), one(moment.z)};
}

/// its.own: as_remembered().
template <class Real> TALUS_INLINE void store_held(const HeldRotation<Real> &its, Real *stored)
{
  constexpr double widest = 16.0;
  const Real half = splat<Real>(0.5);
  const Real in_x = 1.0 / (4.0 * widest) * its.others.x;
  stored[0] = EvenPair::pair(its.own.x, in_x + select(its.moved, half, -half));
  stored[1] = EvenPair::pair(its.own.y, 1.0 / widest * its.others.y);
  stored[2] = EvenPair::pair(its.own.z, 1.0 / widest * its.others.z);
}

/// Mean moment in the step.
template <class Real> struct RotationFlow {
  Vector3<Real> moment;
  bool_of<Real> stops;
};

template <class Real>
TALUS_INLINE RotationFlow<Real> rotation_flow(const Vector3<Real> &w, const Vector3<Real> &others,
                                              Real most)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto unit = [&](const Vector3<Real> &v) { return with_length(one, v); };
  const Vector3<Real> u = unit(w), rate = others - most * u;
  const Real square = dot(rate, rate);
  const Real until = select(square > zero, -dot(w, rate) / square, zero);    // nearest to rest
  const auto goes_on = (dot(w, w) > zero) & ((until <= zero) | (until >= one));
  const Real later = one - until, rest = most * later;
  const Vector3<Real> left = w + until * rate + later * others;
  RotationFlow<Real> flow;
  flow.stops = (dot(left, left) <= rest * rest) & (select(goes_on, one, zero) < one);
  const Vector3<Real> through = until * most * u + rest * unit(left);
  const Vector3<Real> along = most * unit(w + splat<Real>(0.5) * rate);
  flow.moment = select(goes_on, along, select(flow.stops, w + others, through));
  return flow;
}

/// The moment of this step; advances `kept` but for its own moment, which it takes in its units.
///   given   what is part of the moment and does not depend on w: that of friction
template <class Real>
TALUS_INLINE Vector3<Real> hold_rotation(const Vector3<Real> &w, const Vector3<Real> &change,
                                         const Vector3<Real> &given, Real most,
                                         HeldRotation<Real> &kept)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), widest = splat<Real>(16.0);
  const auto over_most = [&](Real a) {
    const Real ratio = a / select(most > zero, most, one);
    const Real not_above = select(ratio < widest, ratio, widest);
    return select(most > zero, select(not_above > -widest, not_above, -widest), zero);
  };
  const Vector3<Real> before = kept.own - given, twice = splat<Real>(2.0) * change;
  const Vector3<Real> others = twice + kept.own;
  const Vector3<Real> now{over_most(others.x), over_most(others.y), over_most(others.z)};
  const Vector3<Real> jump = now - kept.others;
  const auto steady = dot(jump, jump) <= splat<Real>(steady_jump * steady_jump);

  const RotationFlow<Real> flow = rotation_flow(w, others - given, most);
  const auto by_flow = steady & ((select(flow.stops, zero, one) > zero) | kept.moved);
  const Real share = splat<Real>(held_share);
  const Vector3<Real> held = before + share * (w + twice), turns = before + share * (w + change);
  kept.moved = select(by_flow, select(flow.stops, zero, one),
                      select(dot(held, held) > most * most, one, zero)) > zero;
  kept.others = now;
  return select(by_flow, limited(flow.moment, most), limited(held, most, turns));
}

}    // namespace Talus

#endif
