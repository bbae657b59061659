// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Vectors of the slow programs that engine and laws are compared with.

#ifndef TALUS_TEST_REFERENCE_VECTOR_H
#define TALUS_TEST_REFERENCE_VECTOR_H

#include <array>
#include <cmath>
#include <type_traits>

namespace reference {

template <class T> using Triple = std::array<T, 3>;

template <class T> Triple<T> operator+(const Triple<T> &a, const Triple<T> &b)
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T> Triple<T> operator-(const Triple<T> &a, const Triple<T> &b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T> Triple<T> operator*(std::common_type_t<T> s, const Triple<T> &a)
{
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T> T inner(const Triple<T> &a, const Triple<T> &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T> Triple<T> outer(const Triple<T> &a, const Triple<T> &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T> T norm(const Triple<T> &a)
{
  return std::sqrt(inner(a, a));
}

}    // namespace reference

#endif
