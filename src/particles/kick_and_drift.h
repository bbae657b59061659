// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Time integration of a sphere or disc, for one component (Real = double) or a record (Real =
// Vec4):
//
//   v     += kick F/m + fall                                           kicked()
//   x     += dt v                       with the new v                 drifted()
//   omega += kick T/(c m r^2)           c = 2/5, of discs 1/2          turned()
//
// kick (time) is the step of the velocities and fall their change by gravity, see RecordStep.
// Semi-implicit (symplectic) Euler: one kick of dt, and the drift. Velocity Verlet: a kick of dt/2
// and the drift, then with the new forces a kick of dt/2. Used for particles in the records and for
// those in the arrays of LAMMPS, so that both have the same bits: the order of the operations
// counts.

#ifndef TALUS_PARTICLES_KICK_AND_DRIFT_H
#define TALUS_PARTICLES_KICK_AND_DRIFT_H

namespace Talus {

/// `per_mass`: kick/m.
template <class Real> inline Real kicked(Real v, Real per_mass, Real force, Real gravity_kick)
{
  return v + (per_mass * force + gravity_kick);
}

template <class Real> inline Real drifted(Real x, Real dt, Real v)
{
  return x + dt * v;
}

/// kick/(c m r^2); `inverse_c`: 1/c.
template <class Real>
inline Real kick_per_inertia(Real per_mass, Real inverse_radius, double inverse_c)
{
  return per_mass * (inverse_radius * inverse_radius) * inverse_c;
}

template <class Real> inline Real kicked_omega(Real omega, Real per_inertia, Real torque)
{
  return omega + per_inertia * torque;
}

}    // namespace Talus

#endif
