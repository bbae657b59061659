// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two numbers in one double: one of `kept` bits, and one from -1 to 1 of 51 - kept bits, a multiple
// of 2^-(kept + 2) of the first on top of it. Plain arithmetic, the same in every lane; |first|
// below 1e290, and above 1e-290: zero carries no second number.

#ifndef TALUS_BASE_NUMBER_PAIR_H
#define TALUS_BASE_NUMBER_PAIR_H

#include "base/simd.h"

#include <cstdint>

namespace Talus {

template <int kept> struct NumberPair {
  static_assert(kept >= 26 && kept < 52, "Dekker's splitting");
  static constexpr double split = static_cast<double>((std::int64_t{1} << (53 - kept)) + 1);
  static constexpr double unit = 1.0 / static_cast<double>(std::int64_t{1} << (kept + 2));

  /// The first number of a pair, or any number rounded to what a pair keeps (Dekker's splitting).
  template <class Real> TALUS_INLINE static Real first(Real value)
  {
    const Real scaled = split * value;
    return scaled - (scaled - value);
  }

  /// `its_first` must be first().
  template <class Real> TALUS_INLINE static Real pair(Real its_first, Real its_second)
  {
    return its_first + (unit * its_second) * its_first;
  }

  template <class Real> TALUS_INLINE static Real second(Real value)
  {
    const Real its = first(value), zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const auto is = magnitude(its) > zero;
    return select(is, (1.0 / unit) * (value - its) / select(is, its, one), zero);
  }
};

/// Two numbers of like precision.
using EvenPair = NumberPair<26>;

/// A number of 47 bits, and flags: 0 to 3, read give or take a quarter.
using FlaggedNumber = NumberPair<47>;

template <class Real> TALUS_INLINE Real without_flags(Real value)
{
  return FlaggedNumber::first(value);
}

/// `number` must be without_flags().
template <class Real> TALUS_INLINE Real with_flags(Real number, Real flags)
{
  return FlaggedNumber::pair(number, 0.25 * flags);
}

template <class Real> TALUS_INLINE Real flags_of(Real value)
{
  return 4.0 * FlaggedNumber::second(value);
}

}    // namespace Talus

#endif
