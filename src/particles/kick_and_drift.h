// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Time integration of a sphere or disc:
//
//   v     += kick F/m + gravity_kick
//   omega += kick T/(c m r^2)           c = 2/5, of discs 1/2
//   x     += dt v                       with the new v
//
// Semi-implicit (symplectic) Euler: one kick of dt, and the drift. Velocity Verlet: a kick of dt/2
// and the drift, then with the new forces a kick of dt/2. Used for particles in the records and for
// those in the arrays of LAMMPS, so that both have the same bits: the order of the operations
// counts.

#ifndef TALUS_PARTICLES_KICK_AND_DRIFT_H
#define TALUS_PARTICLES_KICK_AND_DRIFT_H

#include "particles/record.h"

namespace Talus {

/// One step of an integrator for spheres: kicks, once or twice, then the drift. A particle of infinite
/// mass only drifts.
struct RecordStep {
  double dt, kick;           ///< time; kick times LAMMPS' force/(mass acceleration)
  double gravity_kick[3];    ///< change of velocity by gravity, in each kick
  double inertia;            ///< 2/5 for spheres, 1/2 for discs
  /// Two for velocity Verlet: with the forces of the last step the kick that ends it, and the one
  /// that begins this step.
  bool two_kicks = false;
  /// Where changes are kept: the time by which velocities are behind positions after the step, over
  /// the time of the kick.
  double extrapolation = 0.0;
};

/// Such a step of one sphere after another. The fourth numbers of records, 1/m, r and 1/r, stay as
/// they are: 0 is added to them.
class KickAndDrift {
 public:
  explicit KickAndDrift(const RecordStep &step) :
      kick(four(step.kick, step.kick, step.kick, 0.0)), dt(four(step.dt, step.dt, step.dt, 0.0)),
      gravity_kick(four(step.gravity_kick[0], step.gravity_kick[1], step.gravity_kick[2], 0.0)),
      inverse_c(1.0 / step.inertia), twice(step.two_kicks)
  {
  }

  /// The new velocity record; `falls`: gravity acts on it.
  TALUS_INLINE Vec4 velocity(Vec4 v, Vec4 force, bool falls) const
  {
    return kicked(v, fourth_of(v) * kick * force + kept_if(falls, gravity_kick));
  }
  /// The new omega record; `v`: velocity record.
  TALUS_INLINE Vec4 omega(Vec4 w, Vec4 v, Vec4 torque) const
  {
    const Vec4 inverse_radius = clear_fourth(fourth_of(w));
    return kicked(w, fourth_of(v) * kick * (inverse_radius * inverse_radius) * inverse_c * torque);
  }
  /// The new position record; `v`: the new velocity.
  TALUS_INLINE Vec4 position(Vec4 x, Vec4 v) const { return x + dt * v; }

 private:
  TALUS_INLINE Vec4 kicked(Vec4 from, Vec4 change) const
  {
    const Vec4 once = from + change;
    return twice ? once + change : once;
  }

  Vec4 kick, dt, gravity_kick;
  double inverse_c;
  bool twice;
};

}    // namespace Talus

#endif
