// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What every contact begins with: normal velocity, effective mass and radius, and the impact of
// laws that keep it. Laws that are synchronized take all of it with the normal of half a step
// before.

#ifndef TALUS_LAWS_APPROACH_H
#define TALUS_LAWS_APPROACH_H

#include "laws/contact_lanes.h"

namespace Talus {

/// How a contact began.
template <class Real> struct ContactImpact {
  Real speed{};    ///< normal speed in the first step
  Real age{};      ///< time since the first step
  Real begun{};    ///< 1 after the first step
};

/// Impact speed and age at this step; `advance` counts the step. `speed`: that of a contact which
/// begins. One that has `separated` is reset after this step.
template <bool advance, class Real>
inline void follow_impact(ContactImpact<Real> &impact, Real speed, Real separated, double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto ends = separated > zero;
  const auto begun = (impact.begun > zero) | ends;
  impact.speed = select(begun, impact.speed, speed);
  if (!advance) return;
  impact.age = select(begun, impact.age + dt, zero);
  impact.begun = select(ends, zero, one);
}

/// v_t^2 over the distance of the centers.
template <class Real> TALUS_INLINE Real centrifugal(const ContactState<Real> &s, Real v_n)
{
  return s.inverse_distance * (dot(s.velocity, s.velocity) - v_n * v_n);
}

/// What a contact has lasted of the step that led here: one that began on the way overlap/(-v_n).
template <class Real> TALUS_INLINE Real share_of_step(const ContactLanes<Real> &s, double dt)
{
  const Real way = -s.normal_velocity * dt;
  return select(way > s.overlap, s.overlap / way, splat<Real>(1.0));
}

/// Normal speed in the step in which a contact begins; with the changes of velocities that laws of
/// second order read, that of the moment at which it does.
template <bool second_order, class Real>
TALUS_INLINE Real speed_at_begin(const ContactLanes<Real> &s, double dt)
{
  const Real v = s.normal_velocity;
  if constexpr (!second_order) return magnitude(v);
  const Real change = 2.0 * dot(s.velocity_change, s.normal) + 2.0 * s.lag * centrifugal(s, v);
  return magnitude(v + (splat<Real>(0.5) - share_of_step(s, dt)) * change);
}

/// The normal half a step before, dt/2: centers came here along straight lines, or a large body
/// tells how it has turned. Where centers coincide there is none.
template <class Real>
TALUS_INLINE Vector3<Real> normal_half_way(const ContactState<Real> &s, Real dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const Vector3<Real> half_way =
      s.normal - (0.5 * dt * s.inverse_distance) * s.velocity - splat<Real>(0.5) * s.normal_change;
  const Real length = square_root(dot(half_way, half_way));
  return select(length > zero, one / length, zero) * half_way;
}

/// Finds normal_velocity, mass and, if it is needed, radius. Between two infinitely heavy bodies
/// the effective mass is 0.
template <bool with_radius, class Real> TALUS_INLINE void approach(ContactLanes<Real> &s)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  s.normal_velocity = dot(s.velocity, s.normal);
  s.impact_speed = s.age = s.radius = zero;
  s.adhesive_share = one;
  const auto finite = s.inverse_mass > zero;
  if constexpr (with_radius) {    // two quotients for the price of one
    const Real inverse_mass = select(finite, s.inverse_mass, one);
    const Real inverse = one / (inverse_mass * s.inverse_radius);
    s.mass = select(finite, s.inverse_radius * inverse, zero);
    s.radius = inverse_mass * inverse;
  } else
    s.mass = select(finite, one / s.inverse_mass, zero);
}

}    // namespace Talus

#endif
