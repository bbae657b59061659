// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_MOTION_RIGID_BODY_H
#define TALUS_BODY_MOTION_RIGID_BODY_H

#include "body/motion/body_state.h"

#include <cmath>

namespace Talus {

/// A free rigid body whose reference point is its center of mass.
///
/// Semi-implicit Euler, as for particles: velocities first, from the force at the old place; then
/// the place, with the new velocity. The angular momentum L is kicked in the axes of space and then
/// kept: see free_rotation.h, so that a body with three equal moments of inertia turns as a particle
/// does. Where rotations are locked the others go on by the implicit midpoint rule, omega = I^-1 L
/// half way: what is left of L is kept, and the energy does not drift either.
class RigidBody {
 public:
  double mass = 0.0;
  double inertia[3] = {0.0, 0.0, 0.0};    ///< principal moments, axes of the body
  /// x y z and rotations about the axes x y z of space that do not happen.
  bool locked[6] = {false, false, false, false, false, false};

  bool translates() const { return !(locked[0] && locked[1] && locked[2]); }
  bool turns_freely() const { return !(locked[3] || locked[4] || locked[5]); }

  /// `acceleration` and `torque` (in units of mass, length, time) act during `kick`, then the body
  /// goes on for dt.
  void advance(BodyState &state, const Vector3<double> &acceleration, const Vector3<double> &torque,
               double kick, double dt) const;
  void advance(BodyState &state, const Vector3<double> &acceleration, const Vector3<double> &torque,
               double dt) const
  {
    advance(state, acceleration, torque, dt, dt);
  }

  /// Of omega from one step to the next, without what is due to the turn of the axes of inertia.
  Vector3<double> change_by_torque(const BodyState &before, const BodyState &now) const
  {
    return omega_of(angular_momentum(now) - angular_momentum(before), now.orientation);
  }
  /// Angular momentum about the center of mass, without the parts that locks take up.
  Vector3<double> angular_momentum(const BodyState &state) const;
  /// The inverse of it.
  Vector3<double> omega_of(const Vector3<double> &momentum,
                           const Eigen::Quaterniond &orientation) const;
  /// mass v^2/2 + omega . L/2.
  double kinetic_energy(const BodyState &state) const;

 private:
  void turn_with_locks(BodyState &state, const Vector3<double> &momentum, double dt) const;
};

/// Holds a force or torque by moving along, or turning about, one axis: the velocity is
/// vmax gain (target - pressed)/|target|, at most vmax either way, where `pressed` is what the
/// body exerts on the particles along the axis. See ServoResponse for how damping is dealt with.
struct Servo {
  bool turns = false;                     ///< holds a torque
  Vector3<double> axis{0.0, 0.0, 1.0};    ///< unit vector
  double target = 0.0, vmax = 0.0, gain = 1.0;

  /// `force` and `torque`: of the particles on the body.
  double pressed(const Vector3<double> &force, const Vector3<double> &torque) const
  {
    return -dot(turns ? torque : force, axis);
  }
  /// By which speed, or angular speed, changes with what is pressed.
  double slope() const { return gain * vmax / std::fabs(target); }
  /// Speed without the limit to vmax.
  double wanted(double pressed) const
  {
    return gain * vmax * (target - pressed) / std::fabs(target);
  }
  double rate_of(const BodyState &state) const
  {
    return dot(turns ? state.omega : state.velocity, axis);
  }
  /// Velocities at this rate, which is first limited to vmax.
  void set_rate(BodyState &state, double rate) const;
  void advance(BodyState &state, double rate, double dt) const;
};

}    // namespace Talus

#endif
