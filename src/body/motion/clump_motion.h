// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a clump, a rigid set of spheres, moves between two evaluations of its contacts: kicks of its
// velocity and angular momentum, then the drift of its place and orientation. Many clumps move in
// each step, and none of them is held by anything: what RigidBody has for locks is left out.
//
// One clump (Real = double) or eight (Vec8), with the same bits.

#ifndef TALUS_BODY_MOTION_CLUMP_MOTION_H
#define TALUS_BODY_MOTION_CLUMP_MOTION_H

#include "base/vector3.h"

#include <algorithm>
#include <cmath>

namespace Talus {

/// Unit vectors along the principal axes of a body, in space: the columns of its rotation.
template <class Real> struct PrincipalAxes {
  Vector3<Real> x, y, z;

  Vector3<Real> to_space(const Vector3<Real> &v) const { return v.x * x + v.y * y + v.z * z; }
  Vector3<Real> to_body(const Vector3<Real> &v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

/// A rotation: w + x i + y j + z k, of length 1.
template <class Real> struct Turn {
  Real w, x, y, z;

  Turn normalized() const
  {
    const Real scale = splat<Real>(1.0) / square_root(w * w + x * x + y * y + z * z);
    return {scale * w, scale * x, scale * y, scale * z};
  }

  PrincipalAxes<Real> axes() const
  {
    const Real ww = w * w, xx = x * x, yy = y * y, zz = z * z, two = splat<Real>(2.0);
    return {{ww + xx - yy - zz, two * (x * y + w * z), two * (x * z - w * y)},
            {two * (x * y - w * z), ww - xx + yy - zz, two * (y * z + w * x)},
            {two * (x * z + w * y), two * (y * z - w * x), ww - xx - yy + zz}};
  }
};

/// First b, then a.
template <class Real> inline Turn<Real> operator*(const Turn<Real> &a, const Turn<Real> &b)
{
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

/// Cosine of an angle and its sine over the angle, from the square of the angle.
struct HalfTurn {
  double cosine, sine;
};
inline HalfTurn half_turn(double square)
{
  const double angle = std::sqrt(square);
  return {std::cos(angle), std::sin(angle) / angle};
}

/// The same in each lane where the square is not small.
inline void correct_large(double square, double limit, double &cosine, double &sine)
{
  if (square < limit) return;
  const HalfTurn its = half_turn(square);
  cosine = its.cosine;
  sine = its.sine;
}
inline void correct_large(Vec8 square, double limit, Vec8 &cosine, Vec8 &sine)
{
  alignas(64) double of[3][lanes];
  store(of[0], square);
  if (*std::max_element(of[0], of[0] + lanes) < limit) return;
  store(of[1], cosine);
  store(of[2], sine);
  for (int k = 0; k < lanes; k++) correct_large(of[0][k], limit, of[1][k], of[2][k]);
  cosine = load8(of[1]);
  sine = load8(of[2]);
}

/// Made by an angular velocity in a time. In a usual step a grain turns by less than a degree: the
/// terms of the series have all digits below an angle of 3 degrees.
template <class Real> inline Turn<Real> turn_in(const Vector3<Real> &omega, double dt)
{
  constexpr double limit = 1.0e-3;
  const double half = 0.5 * dt;
  const Real one = splat<Real>(1.0), a = (half * half) * dot(omega, omega);
  Real sine =
      one - (1.0 / 6.0) * a *
                (one - (1.0 / 20.0) * a * (one - (1.0 / 42.0) * a * (one - (1.0 / 72.0) * a)));
  Real cosine =
      one -
      0.5 * a * (one - (1.0 / 12.0) * a * (one - (1.0 / 30.0) * a * (one - (1.0 / 56.0) * a)));
  correct_large(a, limit, cosine, sine);
  const Real scale = half * sine;
  return {cosine, scale * omega.x, scale * omega.y, scale * omega.z};
}

/// A clump in units of mass, length, time. Quantities of motion are those of its center of mass;
/// angular ones have the axes of space.
template <class Real> struct ClumpState {
  Real mass;
  Vector3<Real> inverse_inertia;    ///< of the principal moments; 0 for a moment that is 0: a line
                                    ///< does not turn about its axis
  Vector3<Real> position, velocity;
  Vector3<Real> momentum, omega;    ///< angular momentum and velocity
  Turn<Real> turn;
  PrincipalAxes<Real> axes;    ///< those of `turn`

  /// Of its angular momentum, in its present orientation.
  Vector3<Real> omega_now() const { return omega_of(axes); }

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
    position = position + splat<Real>(dt) * velocity;
    const Vector3<Real> omega_at_first = omega_now();
    const Turn<Real> whole = moved(turn, omega_at_first, dt);
    const Turn<Real> half = moved(turn, omega_at_first, 0.5 * dt);
    omega = omega_of(half.axes());
    const Turn<Real> halves = moved(half, omega, 0.5 * dt);
    const Real two = splat<Real>(2.0);
    turn = Turn<Real>{two * halves.w - whole.w, two * halves.x - whole.x, two * halves.y - whole.y,
                      two * halves.z - whole.z}
               .normalized();
    axes = turn.axes();
  }

  /// position += dt velocity; the orientation turns by exp(dt omega), where omega is taken half
  /// way (explicit midpoint), so that free rotation keeps its angular momentum to rounding and its
  /// energy to second order, see RigidBody; `omega` is that of the end of the step.
  void drift_exponential(double dt)
  {
    position = position + splat<Real>(dt) * velocity;
    const Turn<Real> half_way = turn_in(omega_now(), 0.5 * dt) * turn;
    turn = (turn_in(omega_of(half_way.normalized().axes()), dt) * turn).normalized();
    axes = turn.axes();
    omega = omega_now();
  }

 private:
  Vector3<Real> omega_of(const PrincipalAxes<Real> &its_axes) const
  {
    const Vector3<Real> l = its_axes.to_body(momentum);
    return its_axes.to_space(
        {l.x * inverse_inertia.x, l.y * inverse_inertia.y, l.z * inverse_inertia.z});
  }

  /// q + h omega q/2, normalized.
  static Turn<Real> moved(const Turn<Real> &q, const Vector3<Real> &w, double h)
  {
    const Turn<Real> rate = Turn<Real>{Real{}, w.x, w.y, w.z} * q;
    const Real s = splat<Real>(0.5 * h);
    return Turn<Real>{q.w + s * rate.w, q.x + s * rate.x, q.y + s * rate.y, q.z + s * rate.z}
        .normalized();
  }
};

}    // namespace Talus

#endif
