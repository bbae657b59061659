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

/// number_of(k), k = 0 ... 7, or vector_of(k), becomes lane k.
template <class NumberOf> TALUS_INLINE Vec8 eight_numbers(NumberOf number_of)
{
  alignas(64) double number[lanes];
  for (int k = 0; k < lanes; k++) number[k] = number_of(k);
  return load8(number);
}
template <class VectorOf> TALUS_INLINE Vector3<Vec8> eight_vectors(VectorOf vector_of)
{
  alignas(64) double number[3][lanes];
  for (int k = 0; k < lanes; k++) {
    const Vector3<double> v = vector_of(k);
    number[0][k] = v.x;
    number[1][k] = v.y;
    number[2][k] = v.z;
  }
  return {load8(number[0]), load8(number[1]), load8(number[2])};
}
/// The reverse: to(k, vector).
template <class To> TALUS_INLINE void for_each_of_eight(const Vector3<Vec8> &v, int count, To to)
{
  alignas(64) double number[3][lanes];
  store(number[0], v.x);
  store(number[1], v.y);
  store(number[2], v.z);
  for (int k = 0; k < count; k++) to(k, Vector3<double>{number[0][k], number[1][k], number[2][k]});
}

template <class Mask, class Real>
inline Vector3<Real> select(Mask mask, Vector3<Real> yes, Vector3<Real> no)
{
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}    // namespace Talus

#endif
