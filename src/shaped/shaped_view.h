// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_SHAPED_VIEW_H
#define TALUS_SHAPED_SHAPED_VIEW_H

#include "base/linear_algebra.h"
#include "particles/change_record.h"

namespace Talus {

/// The host's arrays, of owned particles and then ghosts, as contacts with shapes see them: rows of
/// three doubles, of four for orientations (w x y z, zero of spheres). Forces and torques of owned
/// particles are added to.
struct ShapedView {
  int owned, total;
  const double *x, *v, *omega;
  const double *radius, *mass;
  const double *mass_override;    ///< nullptr, or per particle: > 0 replaces its mass
  const int *type;                ///< counts from 1
  const double *orientation;
  double *f, *torque;
  const ChangeRecord *change = nullptr;    ///< nullptr, or of all, see ParticleRecords::change

  static Vector3<double> row(const double *of, int i)
  {
    return {of[3L * i], of[3L * i + 1], of[3L * i + 2]};
  }
  Eigen::Quaterniond turn(int i) const
  {
    const double *q = orientation + 4L * i;
    return {q[0], q[1], q[2], q[3]};
  }
  /// Of the point `place` of a particle.
  Vector3<double> velocity_at(int i, const Vector3<double> &place) const
  {
    return row(v, i) + cross(row(omega, i), place - row(x, i));
  }
  /// What that velocity lacks of the one at the time of the positions; 0 if changes are not kept.
  Vector3<double> change_at(int i, const Vector3<double> &place) const
  {
    if (!change) return {0.0, 0.0, 0.0};
    const float *c = change[i].c;
    const double per_radius = 1.0 / radius[i];
    const Vector3<double> turn{per_radius * c[4], per_radius * c[5], per_radius * c[6]};
    return Vector3<double>{c[0], c[1], c[2]} + cross(turn, place - row(x, i));
  }
  double inverse_mass(int i) const
  {
    return 1.0 / (mass_override && mass_override[i] > 0.0 ? mass_override[i] : mass[i]);
  }
};

}    // namespace Talus

#endif
