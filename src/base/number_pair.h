// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two numbers in one double: one to 26 bits, and one from -1 to 1 to 25 bits, a multiple of 2^-28
// of the first on top of it. Plain arithmetic, the same in every lane; |first| below 1e290, and
// above 1e-290: zero carries no second number.

#ifndef TALUS_BASE_NUMBER_PAIR_H
#define TALUS_BASE_NUMBER_PAIR_H

#include "base/simd.h"

namespace Talus {

/// The first number of a pair, or any number rounded to what a pair keeps (Dekker's splitting).
template <class Real> TALUS_INLINE Real first_of_pair(Real value)
{
  const Real scaled = 134217729.0 * value;
  return scaled - (scaled - value);
}

/// `first` must be first_of_pair().
template <class Real> TALUS_INLINE Real number_pair(Real first, Real second)
{
  constexpr double unit = 1.0 / 268435456.0;    // 2^-28
  return first + (unit * second) * first;
}

template <class Real> TALUS_INLINE Real second_of_pair(Real value)
{
  const Real first = first_of_pair(value), zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto is = magnitude(first) > zero;
  return select(is, 268435456.0 * (value - first) / select(is, first, one), zero);
}

}    // namespace Talus

#endif
