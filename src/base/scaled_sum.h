// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums of many numbers below a bound that is known before: as integers, in units of 2^-72 of the bound,
// so that the sum has the same bits in any order, over any number of ranks and threads. Two integers
// instead of the 68 of an ExactSum, for sums of which there are millions; what a number is less than
// half of a unit it loses.

#ifndef TALUS_BASE_SCALED_SUM_H
#define TALUS_BASE_SCALED_SUM_H

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace Talus {

/// Plain data: those of several ranks are added number by number (MPI_SUM of int64). Up to 2^26
/// additions in all.
struct ScaledSum {
  std::int64_t high = 0, low = 0;

  void add(const ScaledSum &other)
  {
    high += other.high;
    low += other.low;
  }
};

/// What the sums of one quantity are in.
class SumScale {
 public:
  /// Of numbers that are not larger than this, which is finite.
  explicit SumScale(double bound)
  {
    int exponent = 0;
    std::frexp(bound, &exponent);
    exponent = std::max(exponent, smallest);
    to_high = std::ldexp(1.0, digit_bits - exponent);
    from_high = std::ldexp(1.0, exponent - digit_bits);
  }

  void add(double value, ScaledSum &to) const
  {
    const double scaled = value * to_high;
    auto whole = static_cast<std::int64_t>(scaled);
    whole -= static_cast<double>(whole) > scaled;    // floor, without a call
    to.high += whole;
    to.low += nearest((scaled - static_cast<double>(whole)) * digit);
  }
  double value(const ScaledSum &sum) const
  {
    return from_high *
           (static_cast<double>(sum.high) + static_cast<double>(sum.low) * (1.0 / digit));
  }

 private:
  /// Of a number below 2^51: what adding 1.5 2^52 leaves.
  static std::int64_t nearest(double value)
  {
    constexpr double large = 6755399441055744.0;
    return static_cast<std::int64_t>((value + large) - large);
  }

  static constexpr int digit_bits = 36, smallest = -980;    // so that scales are numbers
  static constexpr double digit = 68719476736.0;            // 2^36

  double to_high, from_high;
};

}    // namespace Talus

#endif
