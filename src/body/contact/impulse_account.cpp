// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/impulse_account.h"

namespace Talus {

void ImpulseAccount::see(const BodyFrame &frame, const Vector3<double> &velocity_then,
                         const Vector3<double> &omega_then)
{
  arm = frame.to_space(point);
  velocity = velocity_then;
  omega = omega_then;
  seen = true;
}

void ImpulseAccount::add(const BodyLoad &load, double time)
{
  if (time == 0.0) return;
  const Vector3<double> torque = load.torque - cross(arm, load.force);
  const double power = dot(load.force, velocity) + dot(load.torque, omega);
  const double rates[] = {load.force.x, load.force.y, load.force.z, torque.x,
                          torque.y,     torque.z,     power};
  for (int k = 0; k < size - 1; k++) sums[k].add(time * rates[k]);
}

void ImpulseAccount::begin_step(const BodyLoad &load, double before, double after, double dt)
{
  if (seen) add(load, owed + before);
  sums[size - 1].add(dt);
  owed = after;
  seen = false;
}

void ImpulseAccount::settle(const BodyLoad &load)
{
  if (!seen) return;
  add(load, owed);
  owed = 0.0;
}

void ImpulseAccount::take(double *to)
{
  for (int k = 0; k < size; k++) {
    to[k] = sums[k].value();
    sums[k].clear();
  }
}

}    // namespace Talus
