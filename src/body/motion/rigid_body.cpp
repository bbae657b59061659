// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/rigid_body.h"

#include "body/motion/free_rotation.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

Eigen::Matrix3d inertia_in_space(const double (&moments)[3], const Eigen::Quaterniond &orientation)
{
  const Eigen::Matrix3d axes = orientation.toRotationMatrix();
  return axes * Eigen::Vector3d(moments[0], moments[1], moments[2]).asDiagonal() * axes.transpose();
}

}    // namespace

/* Locks hold the components of omega about axes of space at zero: what remains solves the free
   rows and columns of I omega = L. */

Vector3<double> RigidBody::omega_of(const Vector3<double> &momentum,
                                    const Eigen::Quaterniond &orientation) const
{
  Eigen::Matrix3d matrix = inertia_in_space(inertia, orientation);
  Eigen::Vector3d right = to_eigen(momentum);
  for (int k = 0; k < 3; k++) {
    if (!locked[3 + k]) continue;
    matrix.row(k).setZero();
    matrix.col(k).setZero();
    matrix(k, k) = 1.0;
    right(k) = 0.0;
  }
  return from_eigen(matrix.inverse() * right);
}

Vector3<double> RigidBody::angular_momentum(const BodyState &state) const
{
  const Eigen::Vector3d l = inertia_in_space(inertia, state.orientation) * to_eigen(state.omega);
  return {locked[3] ? 0.0 : l(0), locked[4] ? 0.0 : l(1), locked[5] ? 0.0 : l(2)};
}

double RigidBody::kinetic_energy(const BodyState &state) const
{
  return 0.5 * mass * dot(state.velocity, state.velocity) +
         0.5 * dot(state.omega, angular_momentum(state));
}

void RigidBody::advance(BodyState &state, const Vector3<double> &acceleration,
                        const Vector3<double> &torque, double kick, double dt) const
{
  Vector3<double> &v = state.velocity;
  v = v + kick * acceleration;
  v = {locked[0] ? 0.0 : v.x, locked[1] ? 0.0 : v.y, locked[2] ? 0.0 : v.z};
  state.position = state.position + dt * v;

  Vector3<double> momentum = angular_momentum(state) + kick * torque;
  momentum = {locked[3] ? 0.0 : momentum.x, locked[4] ? 0.0 : momentum.y,
              locked[5] ? 0.0 : momentum.z};
  if (dot(momentum, momentum) == 0.0) {
    state.omega = {0.0, 0.0, 0.0};
    return;
  }
  if (turns_freely())
    FreeRotation(inertia, Eigen::Quaterniond::Identity())
        .rotate(state.orientation, state.omega, momentum, dt);
  else
    turn_with_locks(state, momentum, dt);
}

/* The iterations gain a factor of about dt omega each; about one axis the first is exact. */

void RigidBody::turn_with_locks(BodyState &state, const Vector3<double> &momentum, double dt) const
{
  constexpr int most = 50;
  constexpr double rounding = 1.0e-15;
  const Eigen::Quaterniond now = state.orientation;
  Vector3<double> omega = omega_of(momentum, now);
  for (int n = 0; n < most; n++) {
    const Vector3<double> last = omega;
    omega = omega_of(momentum, (rotation_by(last, 0.5 * dt) * now).normalized());
    if (length(omega - last) <= rounding * length(omega)) break;
  }
  state.orientation = (rotation_by(omega, dt) * now).normalized();
  state.omega = omega_of(momentum, state.orientation);
}

void Servo::set_rate(BodyState &state, double rate) const
{
  (turns ? state.omega : state.velocity) = std::clamp(rate, -vmax, vmax) * axis;
}

void Servo::advance(BodyState &state, double rate, double dt) const
{
  set_rate(state, rate);
  if (turns)
    state.orientation = (rotation_by(state.omega, dt) * state.orientation).normalized();
  else
    state.position = state.position + dt * state.velocity;
}

}    // namespace Talus
