// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Powers with exponents that are not integers, from operations that every processor rounds alike: those
// of a C library have other last bits on other processors, and trajectories would depend on where they
// are computed.

#ifndef TALUS_BASE_POWER_H
#define TALUS_BASE_POWER_H

#include "base/cube_root.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace Talus {

/// Natural logarithm of a normal number > 0, to two units in the last place of max(1, |result|): of
/// x = 2^n m by the series of the area tangent of (m - 1)/(m + 1), Abramowitz and Stegun 4.1.27.
inline double logarithm(double x)
{
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  // m between sqrt(1/2) and sqrt(2)
  const std::uint64_t shifted = bits - 0x3fe6a09e667f3bcdULL;
  const auto n = static_cast<std::int64_t>(shifted) >> 52;
  bits -= static_cast<std::uint64_t>(n) << 52;
  double m;
  std::memcpy(&m, &bits, sizeof m);
  const double s = (m - 1.0) / (m + 1.0), s2 = s * s, s4 = s2 * s2;
  const double odd = 1.0 / 3.0 +
                     s4 * (1.0 / 7.0 + s4 * (1.0 / 11.0 + s4 * (1.0 / 15.0 + s4 * (1.0 / 19.0)))),
               even = 1.0 / 5.0 +
                      s4 * (1.0 / 9.0 + s4 * (1.0 / 13.0 + s4 * (1.0 / 17.0 + s4 * (1.0 / 21.0))));
  return static_cast<double>(n) * 0.69314718055994530942 + 2.0 * (s + s * (s2 * odd + s4 * even));
}

/// e^y for -700 < y < 700, to two units in the last place of the result: 2^n times the series of Taylor.
inline double exponential(double y)
{
  const double n = std::floor(y * 1.44269504088896340736 + 0.5);
  // ln 2 in two parts, the first of which times n is exact
  const double f = (y - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10;
  double sum = 1.0 / 87178291200.0;    // 1/14!
  constexpr double factorial[] = {1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0,
                                  1.0 / 3628800.0,    1.0 / 362880.0,    1.0 / 40320.0,
                                  1.0 / 5040.0,       1.0 / 720.0,       1.0 / 120.0,
                                  1.0 / 24.0,         1.0 / 6.0,         0.5};
  for (const double term : factorial) sum = sum * f + term;
  return ((sum * f + 1.0) * f + 1.0) * power_of_two(static_cast<int>(n));
}

/// x^e of x >= 0, not above e^690, and e > 0: a relative error of 3.1e-16 (1 + |e ln x|). Results below e^-690
/// are 0.
inline double power(double x, double e)
{
  if (e == 1.0) return x;
  if (x < 1.0e-300) return 0.0;
  const double y = e * logarithm(x);
  return y < -690.0 ? 0.0 : exponential(y);
}

/// x^e for one exponent > 0 and many x >= 0, see power(): by products and square roots where that is possible.
class Power {
 public:
  explicit Power(double e = 1.0) : exponent(e)
  {
    constexpr int most = 32;
    for (int root = 0; root < 3; root++)
      for (int n = 1; n <= most && !factors; n++)
        if (e * (1 << root) == n) {
          factors = n;
          roots = root;
        }
  }
  double operator()(double x) const
  {
    if (!factors) return power(x, exponent);
    for (int k = 0; k < roots; k++) x = std::sqrt(x);
    double product = factors & 1 ? x : 1.0;
    for (int n = factors >> 1; n; n >>= 1) {
      x = x * x;
      if (n & 1) product = product * x;
    }
    return product;
  }

 private:
  double exponent;
  int factors = 0, roots = 0;    ///< (2^roots-th root of x)^factors; no factors: not so
};

}    // namespace Talus

#endif
