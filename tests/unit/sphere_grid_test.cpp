// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres near a place, against a search of all.

#include "packing/sphere_grid.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace Talus;

namespace {

using V = Vector3<double>;

struct Scene {
  std::vector<V> x;
  std::vector<double> radius;
};

double nearest(double d, double period)
{
  return period > 0.0 ? d - period * std::round(d / period) : d;
}

/// What is found of one sphere, and what a search of all finds.
void compare(const GridBox &box, const Scene &scene, double skin)
{
  const double largest = *std::max_element(scene.radius.begin(), scene.radius.end());
  SphereGrid grid(box, largest, skin, 10);
  const int count = static_cast<int>(scene.x.size());
  for (int i = 0; i < count; i++) grid.add(i, scene.x[i], scene.radius[i]);
  const double period[3] = {box.periodic[0] ? box.hi.x - box.lo.x : 0.0,
                            box.periodic[1] ? box.hi.y - box.lo.y : 0.0,
                            box.periodic[2] ? box.hi.z - box.lo.z : 0.0};
  long near_pairs = 0;
  for (int i = 0; i < count; i++) {
    std::multiset<int> found;
    for (int n = 0; n < grid.num_classes(); n++)
      grid.visit_near(n, scene.x[i], scene.radius[i], [&](int j) { found.insert(j); });
    for (const int j : found) ASSERT_EQ(found.count(j), 1U);
    for (int j = 0; j < count; j++) {
      const V d = scene.x[i] - scene.x[j];
      const double reach = scene.radius[i] + scene.radius[j] + skin;
      const bool near = std::hypot(nearest(d.x, period[0]), nearest(d.y, period[1]),
                                   nearest(d.z, period[2])) < reach;
      near_pairs += near;
      ASSERT_GE(found.count(j), near ? 1U : 0U) << i << " " << j;
    }
  }
  EXPECT_GT(near_pairs, count);
}

Scene random_scene(RandomSource &random, const GridBox &box, int count, double least, double widest,
                   double beyond)
{
  Scene scene;
  for (int i = 0; i < count; i++) {
    const auto along = [&](double lo, double hi) {
      return random.uniform(lo - beyond, hi + beyond);
    };
    scene.x.push_back(
        {along(box.lo.x, box.hi.x), along(box.lo.y, box.hi.y), along(box.lo.z, box.hi.z)});
    scene.radius.push_back(widest * std::pow(least / widest, random.uniform(0.0, 1.0)));
  }
  return scene;
}

TEST(SphereGridTest, FindsAllAndEachOnce)
{
  RandomSource random(11);
  for (const double least : {0.5, 0.1, 0.005})
    for (int periodic = 0; periodic < 8; periodic++)
      for (const double beyond : {0.0, 0.2}) {
        const GridBox box{
            {-1, 0, 2}, {5, 4, 5}, {(periodic & 1) != 0, (periodic & 2) != 0, (periodic & 4) != 0}};
        compare(box, random_scene(random, box, 400, least, 0.5, beyond), 0.03);
      }
}

TEST(SphereGridTest, SmallPeriods)
{
  RandomSource random(12);
  for (const double edge : {1.05, 2.2, 3.3, 4.4}) {
    const GridBox box{{0, 0, 0}, {edge, 2 * edge, 3 * edge}, {true, true, true}};
    compare(box, random_scene(random, box, 60, 0.05, 0.5, 0.0), 0.0);
  }
}

// A hundred times smaller, and ten thousand times as many: hardly more is looked at than is near.
TEST(SphereGridTest, DoesNotLookAtMoreForOtherSizes)
{
  RandomSource random(13);
  const GridBox box{{0, 0, 0}, {4, 4, 4}, {true, true, false}};
  SphereGrid grid(box, 1.0, 0.002, 20000);
  grid.add(0, {2, 2, 2}, 1.0);
  std::vector<V> small;
  for (int i = 1; i < 20000; i++) {
    small.push_back({random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4)});
    grid.add(i, small.back(), 0.01);
  }
  long found = 0, looked = 0;
  for (const V &x : small)
    for (int n = 0; n < grid.num_classes(); n++)
      looked += grid.visit_near(n, x, 0.01, [&](int) { found++; });
  const auto count = static_cast<double>(small.size());
  EXPECT_LT(static_cast<double>(found) / count, 3.0);
  EXPECT_LT(static_cast<double>(looked) / count, 3.0 * 27 * 2);    // cells of two classes
}

// Nor for more than were expected.
TEST(SphereGridTest, Grows)
{
  RandomSource random(14);
  constexpr int count = 50000;
  const GridBox box{{0, 0, 0}, {1, 1, 1}, {true, true, true}};
  SphereGrid grid(box, 0.01, 0.0, 0);
  for (int i = 0; i < count; i++)
    grid.add(i, {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)}, 0.01);
  long looked = 0, found = 0;
  constexpr int queries = 1000;
  for (int i = 0; i < queries; i++)
    looked += grid.visit_near(0, {0.507, random.uniform(0, 1), 0.507}, 0.01, [&](int) { found++; });
  EXPECT_GT(found, 5 * queries);
  EXPECT_LT(looked, 27 * queries + 2 * found);
}

}    // namespace
