// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The search for neighbors against comparing all spheres with all.

#include "neighbors/neighbor_search.h"

#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

using namespace Talus;

namespace {

struct Scene {
  std::vector<double> x, radius;
  int owned = 0;
  double skin = 0.1;

  int size() const { return static_cast<int>(radius.size()); }
  NeighborSearch::Spheres spheres() const { return {owned, size(), x.data(), radius.data(), skin}; }
  bool alike() const
  {
    const double mean = std::accumulate(radius.begin(), radius.end(), 0.0) / size();
    return *std::max_element(radius.begin(), radius.end()) < 1.5 * mean;
  }
  /// Distance of the surfaces.
  double gap(int i, int j) const
  {
    return std::hypot(x[3 * i] - x[3 * j], x[3 * i + 1] - x[3 * j + 1],
                      x[3 * i + 2] - x[3 * j + 2]) -
           radius[i] - radius[j];
  }
};

/// n spheres in a box of the given edges around `center`, the last third of them ghosts.
Scene random_scene(int n, const double *edge, double center, double smallest, double largest,
                   RandomSource &random)
{
  Scene s;
  for (int a = 0; a < n; a++) {
    for (int d = 0; d < 3; d++) s.x.push_back(center + edge[d] * random.uniform(-0.5, 0.5));
    // about as many large ones as fill the same room as the small ones
    s.radius.push_back(std::min(largest, smallest / std::cbrt(random.uniform(1.0e-9, 1.0))));
  }
  s.owned = n - n / 3;
  s.skin = 0.2 * smallest;
  return s;
}

using Found = std::map<std::pair<int, int>, int>;

Found find(NeighborSearch &search, const Scene &scene, int threads,
           const std::function<bool(int, int)> &excluded = {})
{
  Found found;
  search.find(scene.spheres(), threads, excluded);
  search.view().for_each_pair([&](int i, int j, double weight) {
    EXPECT_EQ(weight, 1.0);
    // the row of the larger one, or where sizes are alike that of the higher index
    const bool larger = scene.radius[i] >= scene.radius[j] * (1.0 - 1.0e-6);
    EXPECT_TRUE(scene.alike() ? i > j : larger);
    found[std::minmax(i, j)]++;
  });
  return found;
}

/// Every pair that has to be there is there once, and none that is far or between two ghosts.
void expect_all_pairs(const Found &found, const Scene &scene, double rounding)
{
  std::size_t wanted = 0;
  for (int i = 0; i < scene.owned; i++)
    for (int j = i + 1; j < scene.size(); j++) {
      if (scene.gap(i, j) > scene.skin) continue;
      wanted++;
      const auto pair = found.find({i, j});
      ASSERT_TRUE(pair != found.end()) << i << " " << j;
      ASSERT_EQ(pair->second, 1);
    }
  std::size_t extra = 0;
  for (const auto &[pair, times] : found) {
    ASSERT_EQ(times, 1);
    ASSERT_LT(pair.first, scene.owned);
    ASSERT_LE(scene.gap(pair.first, pair.second), scene.skin + rounding);
    extra += scene.gap(pair.first, pair.second) > scene.skin;
  }
  EXPECT_EQ(found.size(), wanted + extra);
  EXPECT_LE(extra, wanted / 100 + 2);
}

struct Case {
  const char *name;
  int n;
  double edge[3], center, smallest, largest;
};
constexpr Case cases[] = {
    {"equal", 1500, {12, 9, 10}, 0.0, 0.5, 0.5},
    {"some sizes", 1500, {12, 9, 14}, -1.0e3, 0.45, 0.6},
    {"many sizes", 2000, {14, 15, 16}, 5.0, 0.2, 20.0},
    {"flat", 700, {25, 28, 0.0}, 0.0, 0.5, 0.55},
    {"a line", 300, {0.0, 0.0, 300.0}, 0.0, 0.5, 0.55},
    {"sparse", 300, {1.0e4, 1.0e4, 1.0e4}, 0.0, 0.5, 0.5},
    {"dense", 400, {3, 3, 3}, 0.0, 0.5, 0.5},
    {"in one place", 40, {0, 0, 0}, 7.0, 0.5, 0.5},
    {"small units", 1500, {12e-12, 9e-12, 14e-12}, 0.0, 0.45e-12, 0.6e-12},
    {"large units", 1500, {12e12, 9e12, 14e12}, 1.0e13, 0.45e12, 0.6e12},
    {"one", 1, {1, 1, 1}, 0.0, 0.5, 0.5},
};

}    // namespace

TEST(NeighborSearch, FindsEveryPairOnce)
{
  RandomSource random(21);
  NeighborSearch search;    // used again and again, as at rebuilds
  for (const Case &c : cases)
    for (int threads : {1, 3}) {
      SCOPED_TRACE(c.name);
      const Scene scene = random_scene(c.n, c.edge, c.center, c.smallest, c.largest, random);
      const double longest = std::max({c.edge[0], c.edge[1], c.edge[2], 2.0 * c.largest});
      expect_all_pairs(find(search, scene, threads), scene, 1.0e-5 * longest);
    }
}

using Pairs = std::vector<std::pair<int, int>>;

Pairs in_order_of_the_list(NeighborSearch &search, const Scene &scene, int threads)
{
  Pairs all;
  search.find(scene.spheres(), threads, {});
  search.view().for_each_pair([&](int i, int j, double) { all.emplace_back(i, j); });
  return all;
}

TEST(NeighborSearch, ThreadsDoNotShow)
{
  RandomSource random(23);
  NeighborSearch search;
  const double edge[3] = {30, 20, 25};
  // enough for several of the blocks that are added up, one of them not full
  for (double largest : {0.5, 0.6, 8.0}) {
    const Scene scene = random_scene(9000, edge, 3.0, 0.4, largest, random);
    const Pairs expected = in_order_of_the_list(search, scene, 1);
    EXPECT_GT(expected.size(), 9000U);
    for (int threads : {2, 3, 11})
      EXPECT_EQ(in_order_of_the_list(search, scene, threads), expected);
  }
}

TEST(NeighborSearch, OneLargeAmongManySmall)
{
  RandomSource random(22);
  const double edge[3] = {10, 10, 10};
  Scene scene = random_scene(3000, edge, 0.0, 0.2, 0.2, random);
  for (const int large : {17, 2999}) {    // owned and ghost
    scene.radius[large] = 4.0;
    NeighborSearch search;
    expect_all_pairs(find(search, scene, 2), scene, 1.0e-3);
    scene.radius[large] = 0.2;
  }
}

TEST(NeighborSearch, LeavesOutWhatIsExcluded)
{
  RandomSource random(23);
  const double edge[3] = {8, 8, 8};
  const Scene scene = random_scene(800, edge, 0.0, 0.5, 0.6, random);
  NeighborSearch search;
  Found all = find(search, scene, 1);
  const auto excluded = [](int i, int j) { return (i + j) % 3 == 0; };
  const Found rest = find(search, scene, 2, excluded);
  for (auto pair = all.begin(); pair != all.end();)
    pair = excluded(pair->first.first, pair->first.second) ? all.erase(pair) : std::next(pair);
  EXPECT_EQ(rest, all);
}

TEST(NeighborSearch, NothingAndOnlyGhosts)
{
  NeighborSearch search;
  Scene scene;
  EXPECT_TRUE(find(search, scene, 2).empty());
  scene.x.assign(30, 0.5);
  scene.radius.assign(10, 1.0);
  EXPECT_TRUE(find(search, scene, 2).empty());
  scene.owned = 1;
  EXPECT_EQ(find(search, scene, 2).size(), 9U);
  search.clear();
  EXPECT_EQ(search.view().rows, 0);
  EXPECT_GT(search.memory_usage(), 0.0);    // little is kept
}

TEST(NeighborSearch, PointsWithoutASkin)
{
  RandomSource random(24);
  const double edge[3] = {8, 8, 8};
  Scene scene = random_scene(300, edge, 0.0, 0.5, 0.5, random);
  scene.radius.assign(scene.size(), 0.0);
  scene.skin = 0.0;
  NeighborSearch search;
  expect_all_pairs(find(search, scene, 1), scene, 1.0e-4);
}

TEST(NeighborSearch, RefusesWhatIsNotANumber)
{
  NeighborSearch search;
  Scene scene;
  scene.x.assign(30, 0.5);
  scene.radius.assign(10, 1.0);
  scene.owned = 10;
  // among four that are looked at together, and behind the last four
  for (const std::size_t place : {13, 25})
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      const double good = std::exchange(scene.x[place], bad);
      EXPECT_THROW(find(search, scene, 1), std::domain_error);
      scene.x[place] = good;
      EXPECT_NO_THROW(find(search, scene, 1));
    }
}
