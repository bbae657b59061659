// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Orientations of spheres that lie in arrays by particle, eight at a time and on all threads.

#ifndef TALUS_BODY_MOTION_TURN_SPHERES_H
#define TALUS_BODY_MOTION_TURN_SPHERES_H

#include "particles/particle_rows.h"

namespace Talus {

/// Particles 0 ... count-1 with one of the bits `group` in `mask`; angular velocities in space, orientations in rows of
/// four (w, x, y, z).
struct TurningSpheres {
  int count;
  const int *mask;
  int group;
  ParticleRows omega;
  double *orientation;
};

/// By extrapolated_turn() of dt; the bits of one particle do not depend on the others.
void turn_spheres(const TurningSpheres &spheres, double dt, int threads);

}    // namespace Talus

#endif
