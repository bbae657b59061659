// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_MOTION_FREE_ROTATION_H
#define TALUS_BODY_MOTION_FREE_ROTATION_H

#include "base/linear_algebra.h"

namespace Talus {

/// How a rigid particle turns about its center of mass.
///
/// The angular momentum L is kicked in the axes of space and then kept. The free rotation is split
/// (as in Dullweber, Leimkuhler, McLachlan, J. Chem. Phys. 107 (1997) 5840) into rotations that are
/// exact: with the moments A, B, C about principal axes, A the one in the middle,
///
///   L.I^-1.L/2 = |L|^2/(2 A) + l_B^2 (1/B - 1/A)/2 + l_C^2 (1/C - 1/A)/2 .
///
/// The first term turns the body about L, and commutes with the others; these turn it about its
/// axes B and C, half of B, C, half of B. So L is kept to rounding, the energy has an error of
/// second order in dt that does not grow with time, the map is reversible, and a body with two or
/// three equal moments turns exactly.
class FreeRotation {
 public:
  FreeRotation() = default;
  /// Principal moments (mass length^2), all > 0, and the rotation from principal axes to those of
  /// the body.
  FreeRotation(const double (&moments)[3], const Eigen::Quaterniond &axes);

  /// One step: `torque` (mass length^2/time^2, axes of space) acts during dt. `orientation` leads
  /// from the axes of the body to those of space.
  void advance(Eigen::Quaterniond &orientation, Vector3<double> &omega,
               const Vector3<double> &torque, double dt) const;

  Vector3<double> angular_momentum(const Eigen::Quaterniond &orientation,
                                   const Vector3<double> &omega) const;
  /// The inverse.
  Vector3<double> omega_of(const Eigen::Quaterniond &orientation,
                           const Vector3<double> &momentum) const;
  double energy(const Eigen::Quaterniond &orientation, const Vector3<double> &omega) const
  {
    return 0.5 * dot(omega, angular_momentum(orientation, omega));
  }

 private:
  Eigen::Vector3d inverse{1.0, 1.0, 1.0}, inertia{1.0, 1.0, 1.0};
  Eigen::Quaterniond principal = Eigen::Quaterniond::Identity();
  int order[3] = {0, 1, 2};    ///< the axes A, B, C
};

}    // namespace Talus

#endif
