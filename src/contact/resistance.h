// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rolling and spinning resistance after Schwartz, Richardson and Michel 2012 (Granular Matter 14,
// 363), as the penalty solver of Project Chrono has them: torques of constant size against the
// relative rotation, none below a threshold of speed.

#ifndef TALUS_CONTACT_RESISTANCE_H
#define TALUS_CONTACT_RESISTANCE_H

#include "contact/normal_laws.h"
#include "contact/vector3.h"

namespace Talus {

/// When resistance acts.
enum class Resistance { NONE, AT_ONCE, DELAYED };

/// Rolling: v_rot = (r_1 omega_1 + r_2 omega_2) x n; the torque on body i is -r_i moment with
/// moment = mu_roll F_n n x v_rot/|v_rot|.
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

/// Spinning: couple on body 1, its opposite on body 2: -mu_spin r_c F_n (w.n) n/|w| with w =
/// omega_1 - omega_2 and r_c the radius of the circle in which the surfaces intersect.
template <class Real>
inline Vector3<Real> spinning_couple(Real strength, Real spin_min, const Vector3<Real> &relative,
                                     const Vector3<Real> &normal)
{
  const Real speed = square_root(dot(relative, relative));
  const auto spins = (speed > spin_min) & (speed > splat<Real>(0.0));
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
