// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Quaternions, rotations and boxes are those of Eigen; here is what leads from the vectors of the
// contact code to them and back. cmake/TalusFlags.cmake turns Eigen's vector code off, so that all
// instruction sets give the same bits.

#ifndef TALUS_BASE_LINEAR_ALGEBRA_H
#define TALUS_BASE_LINEAR_ALGEBRA_H

#include "base/vector3.h"

#include <Eigen/Geometry>

namespace Talus {

#if defined(EIGEN_VECTORIZE) || EIGEN_MAX_ALIGN_BYTES != 0
#error "compile with EIGEN_DONT_VECTORIZE and EIGEN_MAX_ALIGN_BYTES=0: see cmake/TalusFlags.cmake"
#endif

inline Eigen::Vector3d to_eigen(const Vector3<double> &v)
{
  return {v.x, v.y, v.z};
}

inline Vector3<double> from_eigen(const Eigen::Vector3d &v)
{
  return {v.x(), v.y(), v.z()};
}

/// rotation * v and its inverse, for one vector or eight: the same bits for each.
template <class Real>
inline Vector3<Real> rotated(const Eigen::Matrix3d &rotation, const Vector3<Real> &v)
{
  const auto row = [&](int k) {
    return rotation(k, 0) * v.x + rotation(k, 1) * v.y + rotation(k, 2) * v.z;
  };
  return {row(0), row(1), row(2)};
}
template <class Real>
inline Vector3<Real> rotated_back(const Eigen::Matrix3d &rotation, const Vector3<Real> &v)
{
  const auto column = [&](int k) {
    return rotation(0, k) * v.x + rotation(1, k) * v.y + rotation(2, k) * v.z;
  };
  return {column(0), column(1), column(2)};
}

}    // namespace Talus

#endif
