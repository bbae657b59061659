// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Powers with exponents that are not integers, of one number or of each of a vector, from operations that every
// processor rounds alike: those of a C library have other last bits on other processors, and trajectories would
// depend on where they are computed.

#ifndef TALUS_BASE_POWER_H
#define TALUS_BASE_POWER_H

#include "base/cube_root.h"
#include "base/simd.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace Talus {

/* The bits of numbers as integers, and back. */

inline std::int64_t bits_in(double x)
{
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
template <class Vector> TALUS_INLINE bool_of<Vector> bits_in(Vector x)
{
  return (bool_of<Vector>) x;
}
template <class Real, class Bits> TALUS_INLINE Real number_with(Bits bits)
{
  if constexpr (sizeof(Real) == sizeof(double)) {
    double x;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  } else
    return (Real) bits;
}

/// n 2^52, the exponent of a number.
inline std::int64_t as_exponent(std::int64_t n)
{
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(n) << 52);
}
template <class Bits> TALUS_INLINE Bits as_exponent(Bits n)
{
  return n << 52;
}

/// Its last bits count whole numbers: what is added to it is rounded to them.
inline constexpr double counting_wholes = 6755399441055744.0;    // 1.5 2^52

/// Natural logarithm of normal numbers > 0, to two units in the last place of max(1, |result|): of
/// x = 2^n m by the series of the area tangent of (m - 1)/(m + 1), Abramowitz and Stegun 4.1.27.
template <class Real> TALUS_INLINE Real logarithm(Real x)
{
  // m between sqrt(1/2) and sqrt(2)
  const auto bits = bits_in(x);
  const auto n = (bits - std::int64_t{0x3fe6a09e667f3bcd}) >> 52;
  const Real m = number_with<Real>(bits - as_exponent(n)),
             whole = number_with<Real>(n + bits_in(counting_wholes)) - counting_wholes;
  const Real s = (m - 1.0) / (m + 1.0), s2 = s * s, s4 = s2 * s2;
  const Real odd = 1.0 / 3.0 +
                   s4 * (1.0 / 7.0 + s4 * (1.0 / 11.0 + s4 * (1.0 / 15.0 + s4 * (1.0 / 19.0)))),
             even = 1.0 / 5.0 +
                    s4 * (1.0 / 9.0 + s4 * (1.0 / 13.0 + s4 * (1.0 / 17.0 + s4 * (1.0 / 21.0))));
  return whole * 0.69314718055994530942 + 2.0 * (s + s * (s2 * odd + s4 * even));
}

/// e^y for -700 < y < 700, to two units in the last place of the result: 2^n times the series of Taylor.
template <class Real> TALUS_INLINE Real exponential(Real y)
{
  const Real counted = y * 1.44269504088896340736 + counting_wholes, n = counted - counting_wholes;
  // ln 2 in two parts, the first of which times n is exact
  const Real f = (y - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10;
  Real sum = splat<Real>(1.0 / 87178291200.0);    // 1/14!
  constexpr double factorial[] = {1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0,
                                  1.0 / 3628800.0,    1.0 / 362880.0,    1.0 / 40320.0,
                                  1.0 / 5040.0,       1.0 / 720.0,       1.0 / 120.0,
                                  1.0 / 24.0,         1.0 / 6.0,         0.5};
  for (const double term : factorial) sum = sum * f + term;
  const auto power_of_two = as_exponent(bits_in(counted) + std::int64_t{1023});
  return ((sum * f + 1.0) * f + 1.0) * number_with<Real>(power_of_two);
}

/// Cube root of each, with the bits of that of one number.
template <class Vector> inline Vector cube_root(Vector a)
{
  const Vector zero{}, one = splat<Vector>(1.0), size = magnitude(a);
  const auto is_zero = a == zero;
  const auto is_normal = (size >= splat<Vector>(std::numeric_limits<double>::min())) &
                         (size <= splat<Vector>(std::numeric_limits<double>::max()));
  if (any(~(is_normal | is_zero)))
    return for_each_lane(a, [](double number) { return cube_root(number); });
  // size = 2^n m, m from 0.5 to 1, and 3 third + 0, 1 or 2 = n
  const auto bits = bits_in(select(is_zero, one, size));
  const auto n = (bits >> 52) - std::int64_t{1022};
  const Vector m = number_with<Vector>(bits - as_exponent(n)),
               counted = number_with<Vector>(n + bits_in(counting_wholes)) - counting_wholes;
  const auto third =
      bits_in((counted - 1.0) * (1.0 / 3.0) + counting_wholes) - bits_in(counting_wholes);
  const auto power_of_two = [](auto exponent) {
    return number_with<Vector>(as_exponent(exponent + std::int64_t{1023}));
  };
  const Vector root =
      cube_root_near_one(m * power_of_two(n - third - third - third)) * power_of_two(third);
  return select(is_zero, a, select(a < zero, -root, root));
}
template <class Half> TALUS_INLINE DoubleWidth<Half> cube_root(DoubleWidth<Half> a)
{
  return {cube_root(a.low), cube_root(a.high)};
}

template <class Half> TALUS_INLINE DoubleWidth<Half> logarithm(DoubleWidth<Half> x)
{
  return {logarithm(x.low), logarithm(x.high)};
}
template <class Half> TALUS_INLINE DoubleWidth<Half> exponential(DoubleWidth<Half> y)
{
  return {exponential(y.low), exponential(y.high)};
}

/// x^e for x >= 0 and e > 0 with e ln x < 690, to a relative error of 3.1e-16 (1 + |e ln x|). Results below e^-690 are 0.
template <class Real> TALUS_INLINE Real real_power(Real x, Real e)
{
  const Real zero = splat<Real>(0.0), least = splat<Real>(-690.0);
  const auto is_zero = x < splat<Real>(1.0e-300);
  const Real y = e * logarithm(select(is_zero, splat<Real>(1.0), x));
  const Real found = exponential(larger(y, least));
  return select(is_zero | (y < least), zero, found);
}

/// x^e for one exponent > 0 and many x >= 0, not above e^690: by products and square roots where that is possible,
/// else as real_power().
class Power {
 public:
  explicit Power(double e) : exponent(e)
  {
    constexpr int most = 32;
    for (int root = 0; root < 3; root++)
      for (int n = 1; n <= most && !factors; n++)
        if (e * (1 << root) == n) {
          factors = n;
          roots = root;
        }
  }
  template <class Real> TALUS_INLINE Real operator()(Real x) const
  {
    if (!factors) return real_power(x, splat<Real>(exponent));
    for (int k = 0; k < roots; k++) x = square_root(x);
    Real product = factors & 1 ? x : splat<Real>(1.0);
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
