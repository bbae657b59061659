// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Numbers in messages: what is above a limit is told as a number above it, and advice that is
// followed to the letter is enough.

#ifndef TALUS_BASE_TOLD_NUMBERS_H
#define TALUS_BASE_TOLD_NUMBERS_H

#include <cmath>

namespace Talus {

/// A number above this times its limit differs from the limit in the three digits that are told.
inline constexpr double visibly = 1.005;

/// A positive number with so many decimal digits, not less than it but for rounding.
inline double rounded_up(double number, int digits)
{
  const double unit = std::pow(10.0, std::floor(std::log10(number)) + 1 - digits);
  return std::ceil(number / unit * (1.0 - 1.0e-12)) * unit;
}

/// The same, not more than it.
inline double rounded_down(double number, int digits)
{
  const double unit = std::pow(10.0, std::floor(std::log10(number)) + 1 - digits);
  return std::floor(number / unit * (1.0 + 1.0e-12)) * unit;
}

}    // namespace Talus

#endif
