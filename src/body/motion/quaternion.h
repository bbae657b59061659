// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rotations of one body (Real = double) or of eight (Vec8), with the same bits.

#ifndef TALUS_BODY_MOTION_QUATERNION_H
#define TALUS_BODY_MOTION_QUATERNION_H

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

/// Unit quaternion w + x i + y j + z k: a rotation.
template <class Real> struct Quaternion {
  Real w, x, y, z;

  Quaternion conjugate() const { return {w, -x, -y, -z}; }
  Quaternion normalized() const { return scaled(splat<Real>(1.0) / square_root(square())); }
  /// The same if the length is 1 to a few digits: one step of Newton's method.
  Quaternion renormalized() const { return scaled(splat<Real>(1.5) - splat<Real>(0.5) * square()); }

  /// As Eigen does it, to the same bits.
  Quaternion over_length() const
  {
    const Real length = square_root((x * x + y * y) + (z * z + w * w));
    return {w / length, x / length, y / length, z / length};
  }

  PrincipalAxes<Real> axes() const
  {
    const Real ww = w * w, xx = x * x, yy = y * y, zz = z * z, two = splat<Real>(2.0);
    return {{ww + xx - yy - zz, two * (x * y + w * z), two * (x * z - w * y)},
            {two * (x * y - w * z), ww - xx + yy - zz, two * (y * z + w * x)},
            {two * (x * z + w * y), two * (y * z - w * x), ww - xx - yy + zz}};
  }

 private:
  Real square() const { return w * w + x * x + y * y + z * z; }
  Quaternion scaled(Real s) const { return {s * w, s * x, s * y, s * z}; }
};

/// First b, then a.
template <class Real>
inline Quaternion<Real> operator*(const Quaternion<Real> &a, const Quaternion<Real> &b)
{
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

/// Cosine of an angle and its sine over the angle.
template <class Real> struct Angle {
  Real cosine, sine_ratio;
};

/// Where the square of an angle is not small.
inline void correct_large(double square, double limit, Angle<double> &result)
{
  if (square < limit) return;
  const double angle = std::sqrt(square);
  result = {std::cos(angle), std::sin(angle) / angle};
}
inline void correct_large(Vec8 square, double limit, Angle<Vec8> &angle)
{
  alignas(64) double of[3][lanes];
  store(of[0], square);
  if (*std::max_element(of[0], of[0] + lanes) < limit) return;
  store(of[1], angle.cosine);
  store(of[2], angle.sine_ratio);
  for (int k = 0; k < lanes; k++) {
    Angle<double> one{of[1][k], of[2][k]};
    correct_large(of[0][k], limit, one);
    of[1][k] = one.cosine;
    of[2][k] = one.sine_ratio;
  }
  angle = {load8(of[1]), load8(of[2])};
}

/// From the square of the angle. In a usual step a grain turns by less than a degree: the terms of
/// the series have all digits below 1.8 degrees.
template <class Real> inline Angle<Real> angle_of_square(Real a)
{
  constexpr double limit = 1.0e-3;
  const Real one = splat<Real>(1.0);
  Angle<Real> angle;
  angle.sine_ratio =
      one - (1.0 / 6.0) * a *
                (one - (1.0 / 20.0) * a * (one - (1.0 / 42.0) * a * (one - (1.0 / 72.0) * a)));
  angle.cosine =
      one -
      0.5 * a * (one - (1.0 / 12.0) * a * (one - (1.0 / 30.0) * a * (one - (1.0 / 56.0) * a)));
  correct_large(a, limit, angle);
  return angle;
}

/// Rotation by an angular velocity during dt.
template <class Real> inline Quaternion<Real> rotation_in(const Vector3<Real> &omega, double dt)
{
  const double half = 0.5 * dt;
  const Angle<Real> angle = angle_of_square<Real>((half * half) * dot(omega, omega));
  const Real scale = half * angle.sine_ratio;
  return {angle.cosine, scale * omega.x, scale * omega.y, scale * omega.z};
}

}    // namespace Talus

#endif
