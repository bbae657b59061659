// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Orientations by Richardson's extrapolation: of one step of first order of dq/dt = omega q/2, and two of half the time.
// What LAMMPS does for spheres of atom style bpm/sphere and for its rigid bodies, to rounding.

#ifndef TALUS_BODY_MOTION_EXTRAPOLATED_TURN_H
#define TALUS_BODY_MOTION_EXTRAPOLATED_TURN_H

#include "base/vector3.h"
#include "body/motion/quaternion.h"

namespace Talus {

/// q + dt omega q/2, normalized. `omega` in space.
template <class Real>
inline Quaternion<Real> turned_once(const Quaternion<Real> &q, const Vector3<Real> &omega,
                                    double dt)
{
  const Quaternion<Real> rate = Quaternion<Real>{Real{}, omega.x, omega.y, omega.z} * q;
  const Real s = splat<Real>(0.5 * dt);
  return Quaternion<Real>{q.w + s * rate.w, q.x + s * rate.x, q.y + s * rate.y, q.z + s * rate.z}
      .normalized();
}

/// From what one step and two halves of it give.
template <class Real>
inline Quaternion<Real> extrapolated(const Quaternion<Real> &whole, const Quaternion<Real> &halves)
{
  const Real two = splat<Real>(2.0);
  return Quaternion<Real>{two * halves.w - whole.w, two * halves.x - whole.x,
                          two * halves.y - whole.y, two * halves.z - whole.z}
      .normalized();
}

/// A step of dt with a constant `omega`.
template <class Real>
inline Quaternion<Real> extrapolated_turn(const Quaternion<Real> &q, const Vector3<Real> &omega,
                                          double dt)
{
  const Quaternion<Real> half = turned_once(q, omega, 0.5 * dt);
  return extrapolated(turned_once(q, omega, dt), turned_once(half, omega, 0.5 * dt));
}

}    // namespace Talus

#endif
