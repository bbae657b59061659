// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a clump, a rigid set of spheres, moves between two evaluations of its contacts: kicks of its
// velocity and angular momentum, then the drift of its place and orientation. Many clumps move in
// each step, and none of them is held by anything: locks are a matter of RigidBody.
//
// One clump (Real = double) or eight (Vec8), with the same bits.

#ifndef TALUS_BODY_MOTION_CLUMP_MOTION_H
#define TALUS_BODY_MOTION_CLUMP_MOTION_H

#include "body/motion/extrapolated_turn.h"
#include "body/motion/free_rotation.h"

namespace Talus {

/// How the spheres of a clump move. `place`: of a sphere relative to the center of mass, along the
/// principal axes.
template <class Real> struct SphereMotion {
  Vector3<Real> velocity;       ///< of the center of mass
  PrincipalAxes<Real> rates;    ///< at which the axes move
  Vector3<Real> omega;

  Vector3<Real> velocity_at(const Vector3<Real> &place) const
  {
    return velocity + rates.to_space(place);
  }
};

/// Half way between two moments, to second order in the time between them.
template <class Real>
inline SphereMotion<Real> half_way_between(const SphereMotion<Real> &a, const SphereMotion<Real> &b)
{
  const Real half = splat<Real>(0.5);
  const auto mean = [half](const Vector3<Real> &u, const Vector3<Real> &v) {
    return half * (u + v);
  };
  return {mean(a.velocity, b.velocity),
          {mean(a.rates.x, b.rates.x), mean(a.rates.y, b.rates.y), mean(a.rates.z, b.rates.z)},
          mean(a.omega, b.omega)};
}

/// A clump in units of mass, length, time. Quantities of motion are those of its center of mass;
/// angular ones have the axes of space.
template <class Real> struct ClumpState {
  Real mass;
  Vector3<Real> inverse_inertia;    ///< of the principal moments; 0 for a moment that is 0: a line
                                    ///< does not turn about its axis
  Vector3<Real> position, velocity;
  Vector3<Real> momentum, omega;    ///< angular momentum and velocity
  Quaternion<Real> quat;
  PrincipalAxes<Real> axes;    ///< those of `turn`

  /// Of its angular momentum, in its present orientation.
  Vector3<Real> omega_now() const { return omega_of(axes); }

  /// Of its spheres, in its present orientation.
  SphereMotion<Real> sphere_motion() const
  {
    return {velocity, {cross(omega, axes.x), cross(omega, axes.y), cross(omega, axes.z)}, omega};
  }

  /// velocity += kick (force/mass), momentum += kick torque.
  void kick(double kick, const Vector3<Real> &force, const Vector3<Real> &torque)
  {
    velocity = velocity + (splat<Real>(kick) / mass) * force;
    momentum = momentum + splat<Real>(kick) * torque;
  }

  /// position += dt velocity; the orientation by Richardson's extrapolation of one step of dt and
  /// two of dt/2 of dq/dt = omega q/2, normalized; `omega` is that of the middle of the step. What
  /// fix rigid/small of LAMMPS does, to rounding.
  void drift_extrapolated(double dt)
  {
    move_center(dt);
    const Vector3<Real> omega_at_first = omega_now();
    const Quaternion<Real> whole = turned_once(quat, omega_at_first, dt);
    const Quaternion<Real> half = turned_once(quat, omega_at_first, 0.5 * dt);
    omega = omega_of(half.axes());
    quat = extrapolated(whole, turned_once(half, omega, 0.5 * dt));
    axes = quat.axes();
  }

  /// position += dt velocity; the orientation goes on as in free_rotation.h, for which y has to be
  /// the axis of the moment in the middle; `omega` is that of the end of the step.
  void drift_freely(double dt)
  {
    move_center(dt);
    const Vector3<Real> along =
        rotate_freely(quat, momentum, axes.to_body(momentum), inverse_inertia, dt);
    axes = quat.axes();
    omega = axes.to_space(by_inertia(along));
  }

  /// The same; returns the motion of its spheres half way, in which they get from place to place,
  /// for contacts of second order.
  SphereMotion<Real> drift_half_way(double dt)
  {
    omega = omega_now();
    const SphereMotion<Real> before = sphere_motion();
    drift_freely(dt);
    return half_way_between(before, sphere_motion());
  }

 private:
  void move_center(double dt) { position = position + splat<Real>(dt) * velocity; }

  Vector3<Real> by_inertia(const Vector3<Real> &l) const
  {
    return {l.x * inverse_inertia.x, l.y * inverse_inertia.y, l.z * inverse_inertia.z};
  }

  Vector3<Real> omega_of(const PrincipalAxes<Real> &present_axes) const
  {
    return present_axes.to_space(by_inertia(present_axes.to_body(momentum)));
  }
};

}    // namespace Talus

#endif
