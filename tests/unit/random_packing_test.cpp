// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random packings of spheres from equal ones to 1:100, uniform by mass: overlaps, work for a sphere,
// and that they are the same everywhere and in all directions.

#include "cube_of_spheres.h"
#include "packing/random_packing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

namespace {

constexpr double four_thirds_pi = 4.18879020478639098462;

/// Radii from 1 to `ratio`, each interval of which has the same mass, scaled to a solid fraction of
/// the unit cube; in no order.
std::vector<double> radii_of(int count, double ratio, double fraction)
{
  RandomNumbers random(3);
  std::vector<double> radius;
  double solid = 0.0;
  for (int k = 0; k < count; k++) {
    const double share = (k + 0.5) / count;
    radius.push_back(1.0 / std::sqrt(1.0 - share * (1.0 - 1.0 / (ratio * ratio))));
    solid += four_thirds_pi * std::pow(radius.back(), 3);
  }
  for (double &r : radius) r *= std::cbrt(fraction / solid);
  random.shuffle(radius);
  return radius;
}

/// Cells and spheres that were looked at, for each sphere.
double work(int count, double ratio, double fraction)
{
  const Cube cube;
  RandomNumbers random(11);
  RandomPacking packing(cube, radii_of(count, ratio, fraction), {}, {});
  EXPECT_TRUE(packing.pack(random, 1e-3, 1000)) << count << " " << ratio << " " << fraction;
  return static_cast<double>(packing.work()) / count;
}

bool same(const std::vector<Vector3<double>> &a, const std::vector<Vector3<double>> &b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto &p, const auto &q) {
    return p.x == q.x && p.y == q.y && p.z == q.z;
  });
}

}    // namespace

TEST(RandomPacking, holds_its_limit)
{
  const Cube cube;
  for (const double ratio : {1.0, 3.0, 30.0})
    for (const double fraction : {0.35, 0.58}) {
      const std::vector<double> radius = radii_of(4000, ratio, fraction);
      RandomNumbers random(5);
      RandomPacking packing(cube, radius, {}, {});
      ASSERT_TRUE(packing.pack(random, 1e-3, 10000)) << ratio << " " << fraction;
      const auto x = packing.places();
      EXPECT_LE(packing.largest_overlap(), 1e-3);
      EXPECT_NEAR(deepest(x, radius), packing.largest_overlap(), 1e-9);
      for (const auto &at : x) EXPECT_TRUE(cube.contains(at));
    }
}

TEST(RandomPacking, goes_beside_what_is_there)
{
  const Cube cube;
  std::vector<double> radius = radii_of(3000, 10.0, 0.4);
  const std::vector<Vector3<double>> fixed = {{0.01, 0.5, 0.5}, {0.5, 0.1, 0.3}};
  const std::vector<double> fixed_radii = {0.25, 0.02};
  RandomNumbers random(5);
  RandomPacking packing(cube, radius, fixed, fixed_radii);
  ASSERT_TRUE(packing.pack(random, 1e-3, 10000));
  auto x = packing.places();
  ASSERT_EQ(x.size(), radius.size());
  x.insert(x.end(), fixed.begin(), fixed.end());
  radius.insert(radius.end(), fixed_radii.begin(), fixed_radii.end());
  EXPECT_LE(deepest(x, radius), 1e-3 * (1 + 1e-9));
}

TEST(RandomPacking, has_the_places_of_its_seed)
{
  const Cube cube;
  const std::vector<double> radius = radii_of(10000, 10.0, 0.3);
  std::vector<std::vector<Vector3<double>>> all;
  for (const int seed : {1, 1, 2}) {
    RandomNumbers random(seed);
    RandomPacking packing(cube, radius, {}, {});
    ASSERT_TRUE(packing.pack(random, 1e-3, 10000));
    all.push_back(packing.places());
  }
  EXPECT_TRUE(same(all[0], all[1]));
  EXPECT_FALSE(same(all[0], all[2]));
}

TEST(RandomPacking, tells_what_it_reached)
{
  const Cube cube;
  const std::vector<double> radius = radii_of(2000, 10.0, 0.95);
  RandomNumbers random(1);
  RandomPacking packing(cube, radius, {}, {});
  EXPECT_FALSE(packing.pack(random, 1e-3, 500));
  EXPECT_LE(packing.steps(), 500);
  EXPECT_GT(packing.largest_overlap(), 1e-3);
}

// The work for a sphere grows neither with their number nor with the range of their sizes.
TEST(RandomPacking, work_is_linear)
{
  constexpr int few = 4000, many = 32000;
  const double fraction = 0.5, equal = work(few, 1.0, fraction);
  for (const double ratio : {1.0, 10.0, 30.0, 100.0})
    for (const int count : {few, many}) {
      if (ratio == 100.0 && count == few) continue;    // the largest does not fit in
      EXPECT_LT(work(count, ratio, fraction), 1.5 * equal) << count << " " << ratio;
    }
}

// Spheres of all sizes are everywhere, but for the layer at walls, and touch in all directions.
TEST(RandomPacking, is_homogeneous_and_isotropic)
{
  const Cube cube;
  constexpr int count = 40000, parts = 4;
  const std::vector<double> radius = radii_of(count, 10.0, 0.5);
  RandomNumbers random(8);
  RandomPacking packing(cube, radius, {}, {});
  ASSERT_TRUE(packing.pack(random, 1e-3, 10000));
  const auto x = packing.places();

  const double smallest = *std::min_element(radius.begin(), radius.end());
  for (const double least : {smallest, 2 * smallest, 4 * smallest}) {
    double sum = 0.0, layers[3][parts] = {};
    for (int i = 0; i < count; i++) {
      if (radius[i] < least || radius[i] >= 2 * least) continue;
      const double at[3] = {x[i].x, x[i].y, x[i].z};
      for (int d = 0; d < 3; d++) layers[d][std::min(parts - 1, static_cast<int>(parts * at[d]))]++;
      sum++;
    }
    for (const auto &along : layers)
      for (const double n : along)
        EXPECT_NEAR(n, sum / parts, 5.0 * std::sqrt(sum / parts)) << least / smallest;
  }

  // directions of pairs that touch, or nearly so, away from walls
  const double widest = *std::max_element(radius.begin(), radius.end());
  SphereGrid grid(cube.box(), widest, 0.05 * smallest, count);
  for (int i = 0; i < count; i++) grid.add(i, x[i], radius[i]);
  double squares[3] = {}, pairs = 0.0;
  for (int i = 0; i < count; i++) {
    if (std::fabs(x[i].z - 0.5) > 0.5 - 2.0 * widest) continue;
    for (int n = 0; n < grid.num_classes(); n++)
      grid.visit_near(n, x[i], radius[i], [&](int j) {
        const Vector3<double> d = NearestImage(cube.box())(x[i] - x[j]);
        const double r = length(d);
        if (i == j || r > radius[i] + radius[j] + 0.05 * smallest) return;
        squares[0] += d.x * d.x / (r * r);
        squares[1] += d.y * d.y / (r * r);
        squares[2] += d.z * d.z / (r * r);
        pairs++;
      });
  }
  EXPECT_GT(pairs, 10000);
  // of a random direction the variance of a square is 4/45; each pair is counted twice
  for (const double square : squares)
    EXPECT_NEAR(square / pairs, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / (0.5 * pairs)));
}
