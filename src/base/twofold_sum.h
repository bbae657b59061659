// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums of doubles, or of eight at a time (Vec8), in twice their precision: rounding to a double gives the same bits in any
// order, over any number of threads, but for a chance of about 2^-50 where few of the numbers cancel. At the cost of
// six additions for each number; where that is not sure enough, see exact_sum.h and binned_sum.h.
//
// Source: Ogita, Rump and Oishi 2005, SIAM J. Sci. Comput. 26, 1955 (Sum2).

#ifndef TALUS_BASE_TWOFOLD_SUM_H
#define TALUS_BASE_TWOFOLD_SUM_H

#include "base/simd.h"

namespace Talus {

template <class Real> class TwofoldSum {
 public:
  TALUS_INLINE void add(Real value)
  {
    const Real total = sum + value, of_value = total - sum;
    rest = rest + ((sum - (total - of_value)) + (value - of_value));
    sum = total;
  }
  void add(const TwofoldSum &other)
  {
    add(other.sum);
    rest = rest + other.rest;
  }
  Real value() const { return sum + rest; }

  /// One of eight.
  TwofoldSum<double> lane(int k) const { return {sum[k], rest[k]}; }

  TwofoldSum() = default;
  TwofoldSum(Real its_sum, Real its_rest) : sum(its_sum), rest(its_rest) {}

 private:
  Real sum{}, rest{};
};

}    // namespace Talus

#endif
