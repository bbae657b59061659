// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rolling and spinning resistance after Schwartz, Richardson and Michel 2012 (Granular Matter 14,
// 363), as the penalty solver of Project Chrono has them: torques against the relative rotation
// that do not depend on its speed (type A of Ai et al. 2011, Powder Technology 206, 269), none
// below a threshold of speed.
//
// A constant torque cannot hold a body: it pushes it back and forth by what it does in one time
// step, and on a slope the body creeps. `delayed` resistance is so, as Chrono's. The other is
// limited to what stops the relative rotation, after the pattern of Coulomb friction with a return
// mapping: a body that does not roll is held up to mu_roll F_n, exactly.

#ifndef TALUS_LAWS_RESISTANCE_H
#define TALUS_LAWS_RESISTANCE_H

#include "base/vector3.h"
#include "laws/normal_laws.h"
#include "laws/tangential_laws.h"

namespace Talus {

/// When resistance acts.
enum class Resistance { NONE, AT_ONCE, DELAYED };

/// The part of the relative rotation that one contact may take away in a step: a body may have many
/// contacts, each of which would stop it. Spheres of one size have at most twelve, of which each
/// sees 2/3 of a rotation on the mean; stable if the sum is below 2.
inline constexpr double stopping_share = 0.25;

/// For each unit of the moment, the change in a step of r_1 omega_1 + r_2 omega_2; bodies are solid
/// spheres, I = 2/5 m r^2. (One that is harder to turn, as a member of a rigid body, is only
/// stopped in more steps.)
template <class Real> inline Real response(Real inverse_mass, double dt)
{
  return 2.5 * dt * inverse_mass;
}

/// Rolling that is held: moment M with which the rotation left after the step is 1 - stopping_share
/// of that before, whatever friction does: d(r_1 omega_1 + r_2 omega_2) = -response
/// (friction_moment
/// + M). Not longer than `strength` = mu_roll F_n >= 0.
template <class Real>
inline Vector3<Real> holding_moment(Real strength, Real roll_min, const Vector3<Real> &spin,
                                    const Vector3<Real> &normal, Real response,
                                    const Vector3<Real> &friction_moment)
{
  const Real zero = splat<Real>(0.0);
  const Vector3<Real> rotation = cross(spin, normal);
  const auto acts = square_root(dot(rotation, rotation)) >= roll_min;
  const Real stop = select(response > zero, stopping_share / response, zero);
  const Vector3<Real> needed = stop * cross(normal, rotation) - friction_moment;
  return select(acts, splat<Real>(1.0), zero) * capped(needed, strength);
}

/// Rolling, `delayed`: v_rot = (r_1 omega_1 + r_2 omega_2) x n; the torque on body i is -r_i moment
/// with moment = mu_roll F_n n x v_rot/|v_rot|.
template <class Real>
inline Vector3<Real> rolling_moment(Real strength, Real roll_min, const Vector3<Real> &spin,
                                    const Vector3<Real> &normal)
{
  const Vector3<Real> rotation = cross(spin, normal);
  const Real speed = square_root(dot(rotation, rotation));
  const auto rolls = (speed > roll_min) & (speed > splat<Real>(0.0));
  return select(rolls, strength / speed, splat<Real>(0.0)) * cross(normal, rotation);
}

/// Radius of the circle in which the surfaces of two spheres intersect, 0 if they do not. Loses no
/// digits at small overlaps, and none of its bits depends on which sphere comes first.
template <class Real>
inline Real circle_of_intersection(Real first_radius, Real second_radius, Real overlap)
{
  const Real zero = splat<Real>(0.0), sum = first_radius + second_radius;
  const Real distance = sum - overlap;
  const Real square = overlap * (2.0 * sum - overlap) *
                      ((2.0 * first_radius - overlap) * (2.0 * second_radius - overlap));
  return select((square > zero) & (distance > zero), square_root(square) / (2.0 * distance), zero);
}

/// Spinning that stops: as twisting_torque(), but not more than what leaves 1 - stopping_share of
/// the spin after the step; of unlike spheres it leaves more (1/r_1^2 + 1/r_2^2 is less than
/// inverse_radius squared).
template <class Real>
inline Vector3<Real> stopping_torque(Real strength, Real twist_min, const Vector3<Real> &relative,
                                     const Vector3<Real> &normal, Real response,
                                     Real inverse_radius)
{
  const Real zero = splat<Real>(0.0);
  const Real speed = square_root(dot(relative, relative));
  const auto spins = (speed >= twist_min) & (speed > zero);
  const Real wanted = strength / speed;
  const Real most = stopping_share / (response * inverse_radius * inverse_radius);
  const Real couple = -select(wanted < most, wanted, most) * dot(relative, normal);
  return select(spins & (response > zero), couple, zero) * normal;
}

/// Spinning, `delayed`: couple on body 1, its opposite on body 2: -mu_twist r_c F_n (w.n) n/|w| with
/// w = omega_1 - omega_2 and r_c the radius of the circle in which the surfaces intersect.
template <class Real>
inline Vector3<Real> twisting_torque(Real strength, Real twist_min, const Vector3<Real> &relative,
                                     const Vector3<Real> &normal)
{
  const Real speed = square_root(dot(relative, relative));
  const auto spins = (speed > twist_min) & (speed > splat<Real>(0.0));
  const Real couple = -strength * dot(relative, normal) / speed;
  return select(spins, couple, splat<Real>(0.0)) * normal;
}

/// Chrono's delay: 1 if resistance acts, 0 before the contact has lasted one collision time
/// pi sqrt(m/(k (1-d^2))), d = g/(2 m sqrt(k/m)); over-damped contacts (d >= 1) resist at once.
template <class Normal, class Real>
inline Real resistance_gate(const Stiffness<Real> &s, Real overlap, Real mass, Real age)
{
  const Real one = splat<Real>(1.0), zero = splat<Real>(0.0),
             pi = splat<Real>(3.14159265358979323846);
  const ReducedStiffness<Real> r = Normal::reduced(s, overlap);
  const Real damping = r.g / (2.0 * mass * square_root(r.k / mass));
  const Real duration = pi * square_root(mass / (r.k * (one - damping * damping)));
  return select((damping < one) & (age <= duration), zero, one);
}

}    // namespace Talus

#endif
