// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/free_rotation.h"

#include "body/motion/body_state.h"

#include <algorithm>
#include <cmath>

namespace Talus {

FreeRotation::FreeRotation(const double (&moments)[3], const Eigen::Quaterniond &axes) :
    principal(axes)
{
  for (int k = 0; k < 3; k++) {
    inertia(k) = moments[k];
    inverse(k) = 1.0 / moments[k];
  }
  std::sort(order, order + 3, [&](int a, int b) { return moments[a] < moments[b]; });
  std::swap(order[0], order[1]);    // the one in the middle first
}

void FreeRotation::advance(Eigen::Quaterniond &orientation, Vector3<double> &omega,
                           const Vector3<double> &torque, double dt) const
{
  Eigen::Quaterniond frame = orientation * principal;    // from principal axes to space
  const Eigen::Matrix3d before = frame.toRotationMatrix();
  const Eigen::Vector3d momentum =
      before * inertia.cwiseProduct(before.transpose() * to_eigen(omega)) + dt * to_eigen(torque);
  if (momentum.squaredNorm() == 0.0) {
    omega = {0.0, 0.0, 0.0};
    return;
  }
  const int a = order[0], b = order[1], c = order[2];
  const auto turn_about = [&](int axis, double time) {
    const double rate = inverse(axis) - inverse(a);
    if (rate == 0.0) return;
    const double along = (frame.conjugate() * momentum)(axis);
    const double half = 0.5 * time * rate * along;
    Eigen::Quaterniond turn(std::cos(half), 0.0, 0.0, 0.0);
    turn.vec()(axis) = std::sin(half);
    frame = frame * turn;
  };
  turn_about(b, 0.5 * dt);
  turn_about(c, dt);
  turn_about(b, 0.5 * dt);
  frame = (turn_of(from_eigen(inverse(a) * momentum), dt) * frame).normalized();
  const Eigen::Matrix3d after = frame.toRotationMatrix();
  omega = from_eigen(after * inverse.cwiseProduct(after.transpose() * momentum));
  orientation = (frame * principal.conjugate()).normalized();
}

Vector3<double> FreeRotation::angular_momentum(const Eigen::Quaterniond &orientation,
                                               const Vector3<double> &omega) const
{
  const Eigen::Matrix3d frame = (orientation * principal).toRotationMatrix();
  return from_eigen(frame * inertia.cwiseProduct(frame.transpose() * to_eigen(omega)));
}

Vector3<double> FreeRotation::omega_of(const Eigen::Quaterniond &orientation,
                                       const Vector3<double> &momentum) const
{
  const Eigen::Matrix3d frame = (orientation * principal).toRotationMatrix();
  return from_eigen(frame * inverse.cwiseProduct(frame.transpose() * to_eigen(momentum)));
}

}    // namespace Talus
