// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Vectors of the laws, for one contact (Real = double) or eight (Real = Vec8).

#ifndef TALUS_BASE_VECTOR3_H
#define TALUS_BASE_VECTOR3_H

#include "base/simd.h"

#include <cmath>

namespace Talus {

template <class Real> struct Vector3 {
  Real x, y, z;
};

template <class Real> inline Vector3<Real> operator+(Vector3<Real> a, Vector3<Real> b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real> inline Vector3<Real> operator-(Vector3<Real> a, Vector3<Real> b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real> inline Vector3<Real> operator*(Real s, Vector3<Real> a)
{
  return {s * a.x, s * a.y, s * a.z};
}

template <class Real> inline Vector3<Real> operator-(Vector3<Real> a)
{
  return {-a.x, -a.y, -a.z};
}

template <class Real> inline Real dot(Vector3<Real> a, Vector3<Real> b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real> inline Vector3<Real> cross(Vector3<Real> a, Vector3<Real> b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vector3<double> &a)
{
  return std::sqrt(dot(a, a));
}

/// The same vector in every lane.
template <class Real> inline Vector3<Real> in_all_lanes(const Vector3<double> &v)
{
  return {splat<Real>(v.x), splat<Real>(v.y), splat<Real>(v.z)};
}

template <class Mask, class Real>
inline Vector3<Real> select(Mask mask, Vector3<Real> yes, Vector3<Real> no)
{
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}    // namespace Talus

#endif
