// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a rigid body turns about its center of mass: large bodies, clumps and convex particles.
//
// The angular momentum L is kicked in the axes of space and then kept. The free rotation is split
// (as in Dullweber, Leimkuhler, McLachlan, J. Chem. Phys. 107 (1997) 5840) into rotations that are
// exact: with the moments A, B, C about principal axes, A the one in the middle,
//
//   L.I^-1.L/2 = |L|^2/(2 A) + l_B^2 (1/B - 1/A)/2 + l_C^2 (1/C - 1/A)/2 .
//
// The first term turns the body about L, and commutes with the others; these turn it about its
// axes B and C, half of B, C, half of B. So L is kept to rounding, the energy has an error of
// second order in dt that does not grow with time, the map is reversible, and a body with two or
// three equal moments turns exactly.

#ifndef TALUS_BODY_MOTION_FREE_ROTATION_H
#define TALUS_BODY_MOTION_FREE_ROTATION_H

#include "base/linear_algebra.h"
#include "body/motion/quaternion.h"

namespace Talus {

/// One body or eight: `turn` leads from its principal axes, of which y is that of the moment in the
/// middle, to those of space, and goes on for dt. `momentum`: in the axes of space; `along`: the
/// same in those of the body, before; returns what it is after. `inverse`: 1/moments.
template <class Real>
inline Vector3<Real> rotate_freely(Quaternion<Real> &quat, const Vector3<Real> &momentum,
                                   Vector3<Real> along, const Vector3<Real> &inverse, double dt)
{
  const Real two = splat<Real>(2.0);
  struct HalfAngle {
    Real cosine, sine;
  };
  const auto half_angle = [](Real half) {
    const Angle<Real> angle = angle_of_square<Real>(half * half);
    return HalfAngle{angle.cosine, half * angle.sine_ratio};
  };
  // momentum in axes that turn, by twice a half angle
  const auto turned_back = [two](const HalfAngle &h, Real &a, Real &b) {
    const Real c = h.cosine * h.cosine - h.sine * h.sine, s = two * h.cosine * h.sine;
    const Real was = a;
    a = c * was + s * b;
    b = c * b - s * was;
  };
  const Real of_x = splat<Real>(0.25 * dt) * (inverse.x - inverse.y),
             of_z = splat<Real>(0.5 * dt) * (inverse.z - inverse.y);
  const HalfAngle first = half_angle(of_x * along.x);
  turned_back(first, along.y, along.z);
  const HalfAngle second = half_angle(of_z * along.z);
  turned_back(second, along.x, along.y);
  const HalfAngle third = half_angle(of_x * along.x);
  turned_back(third, along.y, along.z);

  const Quaternion<Real> two_of_them{first.cosine * second.cosine, first.sine * second.cosine,
                                     -(first.sine * second.sine), first.cosine * second.sine};
  const Real c = third.cosine, s = third.sine;
  const Quaternion<Real> all{
      two_of_them.w * c - two_of_them.x * s, two_of_them.x * c + two_of_them.w * s,
      two_of_them.y * c + two_of_them.z * s, two_of_them.z * c - two_of_them.y * s};
  quat = (rotation_in(inverse.y * momentum, dt) * (quat * all)).renormalized();
  return along;
}

/// What has to be known of one body or eight, with orientations that lead from any axes of theirs to those of space.
template <class Real> struct Inertia {
  Vector3<Real> inverse, moments;    ///< about principal axes; y: in the middle
  Quaternion<Real> principal;        ///< from these axes to those of the body

  Vector3<Real> angular_momentum(const Quaternion<Real> &orientation,
                                 const Vector3<Real> &omega) const
  {
    const PrincipalAxes<Real> frame = (orientation * principal).axes();
    return frame.to_space(by_component(moments, frame.to_body(omega)));
  }
  /// The inverse.
  Vector3<Real> omega_of(const Quaternion<Real> &orientation, const Vector3<Real> &momentum) const
  {
    const PrincipalAxes<Real> frame = (orientation * principal).axes();
    return frame.to_space(by_component(inverse, frame.to_body(momentum)));
  }
  /// One step with this angular momentum; `omega` becomes that of the end. What does not turn stays as it is.
  void rotate(Quaternion<Real> &orientation, Vector3<Real> &omega, const Vector3<Real> &momentum,
              double dt) const
  {
    const Real zero = splat<Real>(0.0);
    Quaternion<Real> frame = orientation * principal;
    const Vector3<Real> along =
        rotate_freely(frame, momentum, frame.axes().to_body(momentum), inverse, dt);
    const auto turns = dot(momentum, momentum) > zero;
    omega = select(turns, frame.axes().to_space(by_component(inverse, along)),
                   Vector3<Real>{zero, zero, zero});
    const Quaternion<Real> after = (frame * principal.conjugate()).over_length();
    orientation = {select(turns, after.w, orientation.w), select(turns, after.x, orientation.x),
                   select(turns, after.y, orientation.y), select(turns, after.z, orientation.z)};
  }

 private:
  static Vector3<Real> by_component(const Vector3<Real> &a, const Vector3<Real> &b)
  {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
};

/// One body.
class FreeRotation {
 public:
  FreeRotation() = default;
  /// Principal moments (mass length^2), all > 0, and the rotation from principal axes to those of
  /// the body.
  FreeRotation(const double (&moments)[3], const Eigen::Quaterniond &axes);

  /// One step: `torque` (mass length^2/time^2, axes of space) acts during dt. `orientation` leads
  /// from the axes of the body to those of space.
  void advance(Eigen::Quaterniond &orientation, Vector3<double> &omega,
               const Vector3<double> &torque, double dt) const
  {
    rotate(orientation, omega, angular_momentum(orientation, omega) + dt * torque, dt);
  }
  /// The same from the angular momentum, which is kept; `omega` becomes that of the end.
  void rotate(Eigen::Quaterniond &orientation, Vector3<double> &omega,
              const Vector3<double> &momentum, double dt) const;

  Vector3<double> angular_momentum(const Eigen::Quaterniond &orientation,
                                   const Vector3<double> &omega) const;
  /// The inverse.
  Vector3<double> omega_of(const Eigen::Quaterniond &orientation,
                           const Vector3<double> &momentum) const;
  double energy(const Eigen::Quaterniond &orientation, const Vector3<double> &omega) const
  {
    return 0.5 * dot(omega, angular_momentum(orientation, omega));
  }
  /// For eight bodies at a time.
  const Inertia<double> &inertia() const { return of_body; }

 private:
  Inertia<double> of_body{{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 0.0, 0.0, 0.0}};
};

}    // namespace Talus

#endif
