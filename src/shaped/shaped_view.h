// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_SHAPED_VIEW_H
#define TALUS_SHAPED_SHAPED_VIEW_H

#include "base/linear_algebra.h"

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

  static Vector3<double> row(const double *of, int i)
  {
    return {of[3L * i], of[3L * i + 1], of[3L * i + 2]};
  }
  Eigen::Quaterniond turn(int i) const
  {
    const double *q = orientation + 4L * i;
    return {q[0], q[1], q[2], q[3]};
  }
  double inverse_mass(int i) const
  {
    return 1.0 / (mass_override && mass_override[i] > 0.0 ? mass_override[i] : mass[i]);
  }
};

}    // namespace Talus

#endif
