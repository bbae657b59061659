// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A space for packings, and what overlaps in it.

#ifndef TALUS_TEST_CUBE_OF_SPHERES_H
#define TALUS_TEST_CUBE_OF_SPHERES_H

#include "packing/sphere_packing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Talus {

/// The unit cube, periodic along x and y.
class Cube : public PackingSpace {
 public:
  Cube()
  {
    lo = {0.0, 0.0, 0.0};
    hi = {1.0, 1.0, 1.0};
    periodic[0] = periodic[1] = true;
    periodic[2] = false;
  }
  Vector3<double> draw(RandomNumbers &random) const override
  {
    const double a = random.uniform(), b = random.uniform();
    return {a, b, random.uniform()};
  }
  bool contains(const Vector3<double> &x) const override { return x.z >= 0.0 && x.z < 1.0; }
  void find_walls(const Vector3<double> &x, double radius,
                  std::vector<std::pair<Vector3<double>, double>> &walls) const override
  {
    if (x.z < radius) walls.push_back({{0.0, 0.0, 1.0}, radius - x.z});
    if (1.0 - x.z < radius) walls.push_back({{0.0, 0.0, -1.0}, radius - (1.0 - x.z)});
  }
};

inline double nearest(double d)
{
  return d - std::round(d);
}

/// The largest overlap over the smaller radius, by a search of all pairs.
inline double deepest(const std::vector<Vector3<double>> &x, const std::vector<double> &radius)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); i++) {
    worst = std::max({worst, 1.0 - x[i].z / radius[i], 1.0 - (1.0 - x[i].z) / radius[i]});
    for (std::size_t j = 0; j < i; j++) {
      const Vector3<double> d{nearest(x[i].x - x[j].x), nearest(x[i].y - x[j].y), x[i].z - x[j].z};
      worst = std::max(worst, (radius[i] + radius[j] - length(d)) / std::min(radius[i], radius[j]));
    }
  }
  return worst;
}

}    // namespace Talus

#endif
