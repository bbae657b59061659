// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contacts of second order see of a large body that moves: its place and velocities at the
// time of the velocities of particles, half a step before, and at the time of positions. Some
// motions tell velocities at the time of positions, others those of the way since the step before.

#include "fix/large_body_motion.h"

using namespace LAMMPS_NS;
using namespace Talus;

/* Velocities at the time of positions are as far ahead of those of the way as those of particles:
   by the accelerations of the last step. A region tells places only, and not where it comes from.
 */

void LargeBodyMotion::find_moments(const BodyState &old, double lag)
{
  const BodyState &its = now.state;
  half_way = half_way_between(old, its);
  present = its;
  if (kind == Kind::PRESCRIBED || kind == Kind::VARIABLE || kind == Kind::EXTERNAL) {
    half_way.velocity = 0.5 * (old.velocity + its.velocity);
    half_way.omega = 0.5 * (old.omega + its.omega);
  } else {
    half_way.velocity = its.velocity;
    half_way.omega = its.omega;
    const double ahead = behind == 0.0 && kind == Kind::REGION ? 0.0 : lag / (behind + lag);
    present.velocity = its.velocity + ahead * (its.velocity - old.velocity);
    present.omega = its.omega + ahead * (its.omega - old.omega);
    if (kind == Kind::SERVO) servo.set_rate(present, 2.0 * servo.rate_of(its) - servo_rate);
    if (kind == Kind::FREE) {
      const Vector3<double> momentum = rigid.angular_momentum(its);
      const Vector3<double> change = momentum - rigid.angular_momentum(old);
      half_way.omega = rigid.omega_of(momentum, half_way.orientation);
      present.omega = rigid.omega_of(momentum + ahead * change, its.orientation);
    }
  }
  show_moments();
}

/* Before the first step. */

void LargeBodyMotion::stand_still()
{
  half_way = present = now.state;
  show_moments();
}

void LargeBodyMotion::show_moments()
{
  now.half_way.set(half_way);
  now.present.set(present);
}
