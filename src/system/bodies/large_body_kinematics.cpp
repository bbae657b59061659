// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contacts of second order see of a large body that moves: its place and velocities at the
// time of the velocities of particles, half a step before, and at the time of positions. Some
// motions tell velocities at the time of positions, others those of the way since the step before.

#include "system/bodies/large_body_motion.h"

namespace Talus {

/* Velocities at the time of positions are as far ahead of those of the way as those of particles:
   by the accelerations of the last step. A region tells places only, and not where it comes from.
 */

void LargeBodyMotion::find_kinematics(const BodyState &old, double lag)
{
  const BodyState &state = now.state;
  half_way = half_way_between(old, state);
  present = state;
  if (kind == Kind::PRESCRIBED || kind == Kind::VARIABLE || kind == Kind::EXTERNAL) {
    half_way.velocity = 0.5 * (old.velocity + state.velocity);
    half_way.omega = 0.5 * (old.omega + state.omega);
  } else {
    half_way.velocity = state.velocity;
    half_way.omega = state.omega;
    const double ahead = behind == 0.0 && kind == Kind::REGION ? 0.0 : lag / (behind + lag);
    present.velocity = state.velocity + ahead * (state.velocity - old.velocity);
    present.omega = state.omega + ahead * (state.omega - old.omega);
    if (kind == Kind::SERVO)
      given.servo.set_rate(present, 2.0 * given.servo.rate_of(state) - servo_rate);
    if (kind == Kind::FREE) {
      const Vector3<double> momentum = given.rigid.angular_momentum(state);
      const Vector3<double> change = momentum - given.rigid.angular_momentum(old);
      half_way.omega = given.rigid.omega_of(momentum, half_way.orientation);
      present.omega = given.rigid.omega_of(momentum + ahead * change, state.orientation);
    }
  }
  show_kinematics();
}

/* Before the first step. */

void LargeBodyMotion::stand_still()
{
  half_way = present = now.state;
  show_kinematics();
}

void LargeBodyMotion::show_kinematics()
{
  now.half_way.set(half_way);
  now.present.set(present);
}

}    // namespace Talus
