// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/free_rotation.h"

#include <algorithm>

namespace Talus {
namespace {

PrincipalAxes<double> axes_of(const Eigen::Quaterniond &q)
{
  return Quaternion<double>{q.w(), q.x(), q.y(), q.z()}.axes();
}

Vector3<double> by_component(const Vector3<double> &a, const Vector3<double> &b)
{
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

}    // namespace

/* Axes in cyclic order stay right-handed; of the other order one is turned round. */

FreeRotation::FreeRotation(const double (&moments)[3], const Eigen::Quaterniond &axes)
{
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int a, int b) { return moments[a] < moments[b]; });
  inertia = {moments[order[0]], moments[order[1]], moments[order[2]]};
  inverse = {1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z};
  Eigen::Matrix3d sorted = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; k++) sorted(order[k], k) = 1.0;
  if (sorted.determinant() < 0.0) sorted.col(2) = -sorted.col(2);
  principal = (axes * Eigen::Quaterniond(sorted)).normalized();
}

void FreeRotation::rotate(Eigen::Quaterniond &orientation, Vector3<double> &omega,
                          const Vector3<double> &momentum, double dt) const
{
  if (dot(momentum, momentum) == 0.0) {
    omega = {0.0, 0.0, 0.0};
    return;
  }
  const Eigen::Quaterniond q = orientation * principal;
  Quaternion<double> quat{q.w(), q.x(), q.y(), q.z()};
  const Vector3<double> along =
      rotate_freely(quat, momentum, quat.axes().to_body(momentum), inverse, dt);
  const Eigen::Quaterniond frame(quat.w, quat.x, quat.y, quat.z);
  omega = axes_of(frame).to_space(by_component(inverse, along));
  orientation = (frame * principal.conjugate()).normalized();
}

Vector3<double> FreeRotation::angular_momentum(const Eigen::Quaterniond &orientation,
                                               const Vector3<double> &omega) const
{
  const PrincipalAxes<double> frame = axes_of(orientation * principal);
  return frame.to_space(by_component(inertia, frame.to_body(omega)));
}

Vector3<double> FreeRotation::omega_of(const Eigen::Quaterniond &orientation,
                                       const Vector3<double> &momentum) const
{
  const PrincipalAxes<double> frame = axes_of(orientation * principal);
  return frame.to_space(by_component(inverse, frame.to_body(momentum)));
}

}    // namespace Talus
