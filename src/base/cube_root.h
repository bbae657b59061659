// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The cube root, from operations that every processor rounds alike. That of a C library has other
// last bits on other processors, and trajectories would depend on where they are computed.

#ifndef TALUS_BASE_CUBE_ROOT_H
#define TALUS_BASE_CUBE_ROOT_H

#include <cmath>
#include <cstdint>
#include <cstring>

namespace Talus {

/// a * b = high + low, exactly as long as nothing underflows or overflows: Dekker, Numerische
/// Mathematik 18, 224 (1971). Without fused operations, which not all processors have.
template <class Real> struct ExactProduct {
  Real high, low;

  ExactProduct(Real a, Real b) : high(a * b)
  {
    const Real a1 = upper_half(a), a2 = a - a1, b1 = upper_half(b), b2 = b - b1;
    low = ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2;
  }

 private:
  /// The upper 26 bits.
  static Real upper_half(Real a)
  {
    const Real scaled = 134217729.0 * a;    // 2^27 + 1
    return scaled - (scaled - a);
  }
};

/// 2^n of a normal number: std::ldexp() takes as long as the iterations.
inline double power_of_two(int n)
{
  const std::uint64_t bits = static_cast<std::uint64_t>(1023 + n) << 52;
  double power;
  std::memcpy(&power, &bits, sizeof(power));
  return power;
}

/// Of numbers from 0.5 to 4. Halley's iteration triples the right digits; the last step is one of Newton, with a
/// remainder that is exact in its leading part.
template <class Real> inline Real cube_root_near_one(Real scaled)
{
  Real root = 0.71 + 0.23 * scaled;
  for (int k = 0; k < 3; k++) {
    const Real cube = root * root * root;
    root = root * (cube + 2.0 * scaled) / (2.0 * cube + scaled);
  }
  const ExactProduct<Real> square(root, root), cube(square.high, root);
  const Real remainder = ((scaled - cube.high) - cube.low) - square.low * root;
  return root + remainder / (3.0 * square.high);
}

/// Cube root of any number, to 0.501 units in the last place; those of a vector are in base/power.h.
inline double cube_root(double a)
{
  if (a == 0.0 || !std::isfinite(a)) return a;
  int exponent;
  const double fraction = std::frexp(std::abs(a), &exponent);             // 0.5 to 1
  const int third = (exponent + 3 * 400) / 3 - 400;                       // rounded down
  const double scaled = fraction * power_of_two(exponent - 3 * third);    // 0.5 to 4
  return std::copysign(cube_root_near_one(scaled) * power_of_two(third), a);
}

}    // namespace Talus

#endif
