// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_HOST_PARTICLE_VOLUME_H
#define TALUS_SYSTEM_HOST_PARTICLE_VOLUME_H

#include "system/shapes/shaped_particles.h"

#include "atom.h"

namespace Talus {

/// Volume of a particle (local index): of a sphere, or of its shape. `shapes`: of the system.
inline double particle_volume(const LAMMPS_NS::Atom &atom, const ShapedParticles *shapes, int i)
{
  constexpr double sphere = 4.18879020478639098462;
  const int type = atom.type[i];
  const double r = atom.radius[i];
  return shapes && shapes->is_shaped(type) ? shapes->table().of(type)->shape().volume()
                                           : sphere * r * r * r;
}

}    // namespace Talus

#endif
