// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random numbers of the unit tests: the same with every compiler and standard library.

#ifndef TALUS_TEST_RANDOM_SOURCE_H
#define TALUS_TEST_RANDOM_SOURCE_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

/// To 40 digits: last ones of pow() and of long double are others on other processors.
inline double rounded(double number)
{
  int exponent;
  const double fraction = std::frexp(number, &exponent);
  return std::ldexp(std::round(fraction * 0x1p40), exponent - 40);
}

class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : engine(seed) {}

  std::uint64_t bits() { return engine(); }
  int below(int n) { return static_cast<int>(engine() % static_cast<std::uint64_t>(n)); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

  double uniform(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  }

  /// Uniform in the exponent: between 10^low and 10^high.
  double decade(double low, double high) { return rounded(std::pow(10.0, uniform(low, high))); }

  std::array<double, 3> in_cube(double half)
  {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }

  std::array<double, 3> unit_vector()
  {
    for (;;) {
      const std::array<double, 3> v = in_cube(1.0);
      const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (size > 0.1 && size < 1.0) return {v[0] / size, v[1] / size, v[2] / size};
    }
  }

  template <class T> void shuffle(std::vector<T> &list)
  {
    using std::swap;
    for (std::size_t n = list.size(); n > 1; n--) swap(list[n - 1], list[engine() % n]);
  }

 private:
  std::mt19937_64 engine;
};

#endif
