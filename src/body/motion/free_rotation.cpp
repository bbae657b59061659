// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/free_rotation.h"

#include <algorithm>

namespace Talus {
namespace {

Quaternion<double> own(const Eigen::Quaterniond &q)
{
  return {q.w(), q.x(), q.y(), q.z()};
}

}    // namespace

/* Axes in cyclic order stay right-handed; of the other order one is turned round. */

FreeRotation::FreeRotation(const double (&moments)[3], const Eigen::Quaterniond &axes)
{
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int a, int b) { return moments[a] < moments[b]; });
  of_body.moments = {moments[order[0]], moments[order[1]], moments[order[2]]};
  of_body.inverse = {1.0 / of_body.moments.x, 1.0 / of_body.moments.y, 1.0 / of_body.moments.z};
  Eigen::Matrix3d sorted = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; k++) sorted(order[k], k) = 1.0;
  if (sorted.determinant() < 0.0) sorted.col(2) = -sorted.col(2);
  of_body.principal = own((axes * Eigen::Quaterniond(sorted)).normalized());
}

void FreeRotation::rotate(Eigen::Quaterniond &orientation, Vector3<double> &omega,
                          const Vector3<double> &momentum, double dt) const
{
  Quaternion<double> q = own(orientation);
  of_body.rotate(q, omega, momentum, dt);
  orientation = {q.w, q.x, q.y, q.z};
}

Vector3<double> FreeRotation::angular_momentum(const Eigen::Quaterniond &orientation,
                                               const Vector3<double> &omega) const
{
  return of_body.angular_momentum(own(orientation), omega);
}

Vector3<double> FreeRotation::omega_of(const Eigen::Quaterniond &orientation,
                                       const Vector3<double> &momentum) const
{
  return of_body.omega_of(own(orientation), momentum);
}

}    // namespace Talus
