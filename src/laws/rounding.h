// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// History values of laws of second order, rounded to fewer bits than a double has. What is held at rest by several
// contacts then goes on at rest: with all bits it is the noise of the last step that decides, and in a stack of spheres
// one run in nine has an error of first order. Plain arithmetic, the same in every lane; |number| below 1e290.

#ifndef TALUS_LAWS_ROUNDING_H
#define TALUS_LAWS_ROUNDING_H

#include "base/simd.h"

#include <cstdint>

namespace Talus {

/// To so many bits, 26 to 51 (Dekker's splitting).
template <int bits, class Real> TALUS_INLINE Real rounded(Real number)
{
  static_assert(bits >= 26 && bits < 52, "Dekker's splitting");
  constexpr double split = static_cast<double>((std::int64_t{1} << (53 - bits)) + 1);
  const Real scaled = split * number;
  return scaled - (scaled - number);
}

/// A share from -1 to 1 to what is left of it in number + share number 2^-(bits + 2); `number` must
/// be rounded<bits>(). As it is where that is 0.
template <int bits, class Real> TALUS_INLINE Real rounded_share(Real share, Real number)
{
  constexpr double unit = 1.0 / static_cast<double>(std::int64_t{1} << (bits + 2));
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto is = magnitude(number) > zero;
  const Real both = number + (unit * share) * number;
  return select(is, (1.0 / unit) * (both - number) / select(is, number, one), share);
}

}    // namespace Talus

#endif
