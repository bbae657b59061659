// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Coulomb's law of rotation to second order in the time step: while a relative rotation w is not 0
// a torque of the size `most` is against it, else the torque is what keeps it at 0. Used by rolling
// and spinning resistance with `order 2`, see holding_order_2.h. All torques here are in units of
// w: times the change of w in a step for each unit of torque.
//
// What other contacts do to w is known of the last step: change, the half of what w has changed in
// it, and the torque of this contact then tell their part, others = 2 change + torque.
//   * If they were steady, the flow w' = others - most w/|w| is followed through the step, exactly
//     where w comes to rest within the step or goes through 0.
//   * What is at rest is held by torque + share (w + 2 change): by that much more as a share of it
//     would stop the rotation within the step. The share because a body may have many contacts of
//     which each is held so. With g of them on one rotation the errors of successive steps obey
//     e'' = (2 - 2 g) e' - (1 - g) e, stable for g < 4/3: g is 8 shares in a crystal of spheres
//     with 12 neighbors, each of which turns as well and of which each sees 2/3 of a rotation.
//   * If the torque of the others has jumped, their other contacts come to rest or react to this
//     one: then the share also brings a contact to rest, so that they do not push each other on.
//
// The history holds the torque, what others do over `most`, not above `widest`, and whether it
// moved.

#ifndef TALUS_LAWS_ROLLING_HELD_ROTATION_H
#define TALUS_LAWS_ROLLING_HELD_ROTATION_H

#include "base/vector3.h"
#include "laws/rounding.h"
#include "laws/tangential/set_back.h"

namespace Talus {

inline constexpr double held_share = 0.15;    ///< 8 of them below 4/3
inline constexpr double steady_jump = 0.2;    ///< of what others do over `most`

inline constexpr double widest = 16.0;
inline constexpr int bits_of_torque = 26;    ///< of the torque in the history

/// Of the last step. In the history: the torque, what others did, and 0 for a new contact, 1 if it
/// was at rest, 2 if it moved.
template <class Real> struct HeldRotation {
  static constexpr int size = 7;
  Vector3<Real> torque, others;    ///< torque; what others did over `most`
  bool_of<Real> moved, known;
};

/// Of a contact that was not there all numbers are zero.
template <class Real> TALUS_INLINE HeldRotation<Real> held_rotation(const Real *stored)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  return {{stored[0], stored[1], stored[2]},
          {stored[3], stored[4], stored[5]},
          magnitude(stored[6] - one) > zero,
          stored[6] > zero};
}

/// The torque as it is stored; never 0, beside which a share would have no precision.
template <class Real> TALUS_INLINE Vector3<Real> as_stored(const Vector3<Real> &torque)
{
  const Real zero = splat<Real>(0.0), least = splat<Real>(1.0e-200);
  const auto one = [&](Real a) {
    return rounded<bits_of_torque>(select(magnitude(a) > zero, a, least));
  };
  return {one(torque.x), one(torque.y), one(torque.z)};
}

/// kept.torque: as from as_stored().
template <class Real> TALUS_INLINE void store_held(const HeldRotation<Real> &kept, Real *stored)
{
  const Real half = splat<Real>(0.5), one = splat<Real>(1.0);
  const Real side = select(kept.moved, half, -half);    // with it a share of x from -1 to 1
  const Real x =
      rounded_share<bits_of_torque>(1.0 / (4.0 * widest) * kept.others.x + side, kept.torque.x);
  const auto other = [](Real a, Real own) {
    return widest * rounded_share<bits_of_torque>(1.0 / widest * a, own);
  };
  stored[0] = kept.torque.x;
  stored[1] = kept.torque.y;
  stored[2] = kept.torque.z;
  stored[3] = 4.0 * widest * (x - side);
  stored[4] = other(kept.others.y, kept.torque.y);
  stored[5] = other(kept.others.z, kept.torque.z);
  stored[6] = one + select(kept.moved, one, splat<Real>(0.0));
}

/// Mean torque in the step.
template <class Real> struct RotationFlow {
  Vector3<Real> torque;
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
  flow.torque = select(goes_on, along, select(flow.stops, w + others, through));
  return flow;
}

/// The torque of this step; advances `kept` but for its own torque, which it takes in its units.
///   given   what is part of the torque and does not depend on w: that of friction
template <class Real>
TALUS_INLINE Vector3<Real> hold_rotation(const Vector3<Real> &w, const Vector3<Real> &change,
                                         const Vector3<Real> &given, Real most,
                                         HeldRotation<Real> &kept)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0), most_others = splat<Real>(widest);
  const auto over_most = [&](Real a) {
    const Real ratio = a / select(most > zero, most, one);
    const Real not_above = select(ratio < most_others, ratio, most_others);
    return select(most > zero, select(not_above > -most_others, not_above, -most_others), zero);
  };
  const Vector3<Real> before = kept.torque - given, twice = splat<Real>(2.0) * change;
  const Vector3<Real> others = twice + kept.torque;
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
  return select(by_flow, limited(flow.torque, most), limited(held, most, turns));
}

}    // namespace Talus

#endif
