// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_CONTACT_SHAPED_VIEW_H
#define TALUS_SHAPE_CONTACT_SHAPED_VIEW_H

#include "base/linear_algebra.h"
#include "particles/particle_state.h"

namespace Talus {

/// Owned particles and then ghosts, as contacts with shapes see them, with `orientation` in rows of
/// four (w x y z, zero of spheres) by local index. Forces and torques are added to owned ones.
struct ShapedView : ParticleState {
  ShapedView() = default;
  ShapedView(const ParticleState &particles, int owned_and_ghosts, const double *orientations) :
      ParticleState(particles), total(owned_and_ghosts), orientation(orientations)
  {
  }

  int total = 0;
  const double *orientation = nullptr;

  Eigen::Quaterniond quaternion(int i) const
  {
    const double *q = orientation + 4L * i;
    return {q[0], q[1], q[2], q[3]};
  }
  /// Of the point `place` of a particle.
  Vector3<double> velocity_at(int i, const Vector3<double> &place) const
  {
    return velocity(i) + cross(angular_velocity(i), place - position(i));
  }
  /// What that velocity lacks of the one at the time of the positions; 0 if changes are not kept.
  Vector3<double> change_at(int i, const Vector3<double> &place) const
  {
    const ChangeRecord *stored = change(i);
    if (!stored) return {0.0, 0.0, 0.0};
    const float *c = stored->c;
    const double per_radius = 1.0 / radius(i);
    const Vector3<double> omega_change{per_radius * c[4], per_radius * c[5], per_radius * c[6]};
    return Vector3<double>{c[0], c[1], c[2]} + cross(omega_change, place - position(i));
  }
};

}    // namespace Talus

#endif
