// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rows of numbers, as in the arrays of LAMMPS, as vectors and quaternions.

#ifndef TALUS_BASE_ROWS_H
#define TALUS_BASE_ROWS_H

#include "base/linear_algebra.h"

namespace Talus {

inline Vector3<double> row(const double *of)
{
  return {of[0], of[1], of[2]};
}

inline void put(const Vector3<double> &v, double *to)
{
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

inline Eigen::Quaterniond quaternion(const double *wxyz)
{
  return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

inline void put(const Eigen::Quaterniond &q, double *wxyz)
{
  wxyz[0] = q.w();
  wxyz[1] = q.x();
  wxyz[2] = q.y();
  wxyz[3] = q.z();
}

/// Not that of a sphere, or of a particle that has none yet.
inline bool is_known(const double *wxyz)
{
  return wxyz[0] != 0.0 || wxyz[1] != 0.0 || wxyz[2] != 0.0 || wxyz[3] != 0.0;
}

}    // namespace Talus

#endif
