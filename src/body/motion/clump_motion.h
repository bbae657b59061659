// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a clump, a rigid set of spheres, moves between two evaluations of its contacts: kicks of its
// velocity and angular momentum, then the drift of its place and orientation. Many clumps move in
// each step, and none of them is held by anything: what RigidBody has for locks is left out.

#ifndef TALUS_BODY_MOTION_CLUMP_MOTION_H
#define TALUS_BODY_MOTION_CLUMP_MOTION_H

#include "base/vector3.h"

namespace Talus {

/// Unit vectors along the principal axes of a body, in space: the columns of its rotation.
struct PrincipalAxes {
  Vector3<double> x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};

  Vector3<double> to_space(const Vector3<double> &v) const { return v.x * x + v.y * y + v.z * z; }
  Vector3<double> to_body(const Vector3<double> &v) const
  {
    return {dot(x, v), dot(y, v), dot(z, v)};
  }
};

/// A rotation: w + x i + y j + z k, of length 1.
struct Turn {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;

  Turn normalized() const;
  PrincipalAxes axes() const;
};
/// First b, then a.
Turn operator*(const Turn &a, const Turn &b);
/// Made by an angular velocity in a time: exact, by the series where the angle is small.
Turn turn_in(const Vector3<double> &omega, double dt);

/// A clump in units of mass, length, time. Quantities of motion are those of its center of mass;
/// angular ones have the axes of space.
struct ClumpState {
  double mass;
  Vector3<double> inertia;    ///< principal moments; 0: a line, which does not turn about this axis
  Vector3<double> position, velocity;
  Vector3<double> momentum, omega;    ///< angular momentum and velocity
  Turn turn;
  PrincipalAxes axes;    ///< those of `turn`

  /// Of its angular momentum, in its present orientation.
  Vector3<double> omega_now() const { return omega_of(axes); }

  /// velocity += kick (force/mass), momentum += kick torque.
  void kick(double kick, const Vector3<double> &force, const Vector3<double> &torque);

  /// position += dt velocity; the orientation by Richardson's extrapolation of one step of dt and
  /// two of dt/2 of dq/dt = omega q/2, normalized (Miller et al., J. Chem. Phys. 116 (2002) 8649
  /// discuss this and others); `omega` is that of the middle of the step. What fix rigid/small of
  /// LAMMPS does, to rounding.
  void drift_extrapolated(double dt);

  /// position += dt velocity; the orientation turns by exp(dt omega), where omega is taken half
  /// way (explicit midpoint), so that free rotation keeps its angular momentum to rounding and its
  /// energy to second order without drift, see RigidBody; `omega` is that of the end of the step.
  void drift_exponential(double dt);

 private:
  Vector3<double> omega_of(const PrincipalAxes &its_axes) const;
};

}    // namespace Talus

#endif
