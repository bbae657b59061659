// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Vectors of the slow programs that engine and laws are compared with.

#ifndef TALUS_TESTS_REFERENCE_VECTOR_H
#define TALUS_TESTS_REFERENCE_VECTOR_H

#include <cmath>

namespace Reference {

struct Vec {
  double x = 0.0, y = 0.0, z = 0.0;
};
inline Vec operator+(Vec a, Vec b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(double s, Vec a)
{
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vec a, Vec b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double length(Vec a)
{
  return std::sqrt(dot(a, a));
}
inline Vec cross(Vec a, Vec b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec unit(Vec a)
{
  const double l = length(a);
  return l > 0.0 ? (1.0 / l) * a : Vec{};
}
inline Vec across(Vec a, Vec n)
{
  return a - dot(a, n) * n;
}
/// a in the plane normal to n, with its length.
inline Vec turned(Vec a, Vec n)
{
  return length(a) * unit(across(a, n));
}

}    // namespace Reference

#endif
