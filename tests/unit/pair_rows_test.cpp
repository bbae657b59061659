// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbor_lists.h"
#include "neighbors/pair_rows.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <vector>

using namespace Talus;

namespace {

using Rows = std::map<int, std::map<int, double>>;    // second -> first -> scale

/// Particles in random order; pairs at random, in the row of either particle.
struct Scene {
  ParticleOrder order;
  slow::NeighborLists lists;
  Rows rows;

  Scene(int owned, int total, double chance, std::vector<double> scales, RandomSource &random) :
      lists(owned)
  {
    std::vector<std::uint64_t> key;
    for (int a = 0; a < total; a++) key.push_back(random.bits());
    std::vector<std::int64_t> tag(total);
    std::iota(tag.begin(), tag.end(), 1);
    order.arrange(owned, key, tag);
    for (int i = 0; i < owned; i++)
      for (int j = i + 1; j < total; j++) {
        if (!random.chance(chance)) continue;
        const double scale = scales[random.below(static_cast<int>(scales.size()))];
        const bool swapped = random.chance(0.5);
        lists.add(swapped ? j : i, swapped ? i : j, scale);
        const auto [first, second] = std::minmax({order.slot_of_atom[i], order.slot_of_atom[j]});
        if (scale != 0.0) rows[second][first] = scale;
      }
  }
};

void expect_rows(const PairRows &rows, const ParticleOrder &order, Rows expected)
{
  for (int s = 0; s < order.size(); s++) {
    const auto &row = expected[s];
    ASSERT_EQ(rows.size(s), static_cast<int>(row.size()));
    std::vector<int> firsts(row.size(), -1), without_scales = firsts;
    std::vector<double> scales(row.size(), -1.0);
    rows.copy(s, firsts.data(), scales.data());
    rows.copy(s, without_scales.data(), nullptr);
    EXPECT_EQ(without_scales, firsts);
    std::size_t n = 0;
    for (const auto &[first, scale] : row) {
      EXPECT_EQ(firsts[n], first);
      EXPECT_EQ(scales[n++], scale);
    }
    std::map<int, double> visited;
    rows.for_each(s, [&](int first, double scale) { visited[first] = scale; });
    EXPECT_EQ(visited, row);
  }
}

TEST(PairRows, HoldEveryPairOnceInTheRowOfItsSecond)
{
  RandomSource random(11);
  for (const int total : {0, 1, 2, 5, 40, 200})
    for (const int threads : {1, 2, 3, 8, 64}) {
      const int owned = (total + 1) / 2;
      // in the largest scene most rows are longer than the sixteen that are usual
      Scene scene(owned, total, total == 200 ? 0.4 : 0.2, {1.0}, random);
      const PairRows rows(scene.order, scene.lists.view(), threads);
      EXPECT_FALSE(rows.weighted());
      expect_rows(rows, scene.order, scene.rows);
    }
}

TEST(PairRows, KnowScalesAndLeaveOutZero)
{
  RandomSource random(12);
  for (const int threads : {1, 3}) {
    Scene scene(60, 90, 0.3, {1.0, 0.5, 0.0}, random);
    const PairRows rows(scene.order, scene.lists.view(), threads);
    EXPECT_TRUE(rows.weighted());
    expect_rows(rows, scene.order, scene.rows);
  }
  Scene none(60, 90, 0.3, {1.0, 0.0}, random);
  const PairRows rows(none.order, none.lists.view(), 2);
  EXPECT_FALSE(rows.weighted());
  expect_rows(rows, none.order, none.rows);
}

/// Nobody's list has that, but nothing must be left unset.
TEST(PairRows, SamePairTwice)
{
  ParticleOrder order;
  order.arrange(3, {1, 2, 3}, {1, 2, 3});
  slow::NeighborLists lists(3);
  for (const int first : {1, 0, 1, 0, 0}) lists.add(2, first, 1.0);
  const PairRows rows(order, lists.view());
  ASSERT_EQ(rows.size(2), 5);
  std::vector<int> firsts(5, -1);
  rows.copy(2, firsts.data(), nullptr);
  EXPECT_EQ(firsts, (std::vector<int>{0, 0, 0, 1, 1}));
}

/// As NeighborSearch has them: all particles have a row, of lower ones.
TEST(PairRows, RowsThatAreInOrderAlready)
{
  constexpr int n = 100;
  RandomSource random(13);
  std::vector<std::uint64_t> key(n);
  std::vector<std::int64_t> tag(n);
  std::iota(key.begin(), key.end(), 0);
  std::iota(tag.begin(), tag.end(), 1);
  ParticleOrder order;
  order.arrange(n, key, tag);
  Rows expected;
  std::vector<std::vector<int>> entries(n);
  std::vector<int> size;
  std::vector<const int *> begin;
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < i; j++)
      if (random.chance(0.1)) {
        entries[i].push_back(j);
        expected[i][j] = 1.0;
      }
    random.shuffle(entries[i]);
    size.push_back(static_cast<int>(entries[i].size()));
    begin.push_back(entries[i].data());
  }
  const NeighborView view{n, nullptr, size.data(), begin.data()};
  for (const int threads : {1, 2, 7}) expect_rows(PairRows(order, view, threads), order, expected);
}

}    // namespace
