// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A slow search for the least value of a function of a direction, which knows nothing but its values.

#ifndef TALUS_TEST_ALL_DIRECTIONS_H
#define TALUS_TEST_ALL_DIRECTIONS_H

#include "base/vector3.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Talus {

/// f(n) of unit vectors n: a spiral of directions over the sphere, and from the best of them steps that are halved
/// where none is better.
template <class Function> double least_of_all_directions(Function f)
{
  using Vector = Vector3<double>;
  constexpr int count = 3000, starts = 6;
  std::vector<std::pair<double, Vector>> best;
  for (int k = 0; k < count; k++) {
    const double z = 1.0 - (2.0 * k + 1.0) / count, r = std::sqrt(1.0 - z * z),
                 angle = 2.39996323 * k;
    const Vector n{r * std::cos(angle), r * std::sin(angle), z};
    best.emplace_back(f(n), n);
  }
  std::partial_sort(best.begin(), best.begin() + starts, best.end(),
                    [](const auto &one, const auto &other) { return one.first < other.first; });
  double least = best[0].first;
  for (int k = 0; k < starts; k++) {
    Vector n = best[k].second;
    double here = best[k].first;
    for (double step = 0.05; step > 1.0e-9;) {
      Vector s = std::abs(n.x) < 0.6 ? Vector{0.0, -n.z, n.y} : Vector{-n.y, n.x, 0.0};
      s = (1.0 / length(s)) * s;
      const Vector t = cross(n, s);
      bool better = false;
      for (int way = 0; way < 8 && !better; way++) {
        const double angle = 0.785398163 * way;
        Vector next = n + step * (std::cos(angle) * s + std::sin(angle) * t);
        next = (1.0 / length(next)) * next;
        const double there = f(next);
        if (there >= here) continue;
        here = there;
        n = next;
        better = true;
      }
      if (!better) step *= 0.5;
    }
    least = std::min(least, here);
  }
  return least;
}

}    // namespace Talus

#endif
