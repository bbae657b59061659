// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A number and a few flags in one double. The number keeps 47 bits, the flags, 0 to 3, are a
// multiple of 2^-51 on top of it. Plain arithmetic, the same in every lane; |number| below 1e300,
// and above 1e-290 or zero. Zero carries no flags.

#ifndef TALUS_BASE_FLAGGED_NUMBER_H
#define TALUS_BASE_FLAGGED_NUMBER_H

#include "base/simd.h"

namespace Talus {

/// The number rounded to 47 bits (Dekker's splitting); also of one with flags.
template <class Real> TALUS_INLINE Real without_flags(Real value)
{
  const Real scaled = 65.0 * value;
  return scaled - (scaled - value);
}

/// `number` must be without_flags().
template <class Real> TALUS_INLINE Real with_flags(Real number, Real flags)
{
  constexpr double unit = 1.0 / 2251799813685248.0;    // 2^-51
  return number + (unit * flags) * number;
}

/// 0 to 3, give or take a quarter.
template <class Real> TALUS_INLINE Real flags_of(Real value)
{
  const Real number = without_flags(value), zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto none = number * number > zero;
  return select(none, 2251799813685248.0 * (value - number) / select(none, number, one), zero);
}

}    // namespace Talus

#endif
