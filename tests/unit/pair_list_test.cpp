// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/pair_list.h"
#include "random_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

using namespace Talus;
using namespace slow;

namespace {

TEST(PairList, SortsPairsAndKeepsTheirWeights)
{
  RandomSource random(2);
  PairList list;    // used again and again, as at rebuilds
  ParticleOrder order;
  for (int n : {40, 0, 7, 120, 2, 300}) {
    const Particles p = random_particles(n, random);
    order.arrange(p.owned, p.key, p.tag);
    Pairs pairs(order, 0.2, 0.25, random);    // 300: rows of more than the few that are usual
    const WorkPartition work(order);
    list.collect(order, work, PairRows(order, pairs.lists.view()), 0);

    ASSERT_EQ(list.num_pairs(), static_cast<std::int64_t>(pairs.by_slots.size()));
    std::int64_t c = 0;
    for (const auto &[slots, weight] : pairs.by_slots) {
      ASSERT_EQ(list.first[c], slots.first);
      ASSERT_EQ(list.second[c], slots.second);
      ASSERT_EQ(list.weighted() ? list.weights[c] : 1.0, weight);
      ASSERT_EQ(list.find(slots.first, slots.second), c);
      ASSERT_EQ(list.find(slots.second, slots.first), c);
      c++;
    }
    for (int a = 0; a < n; a++)
      for (int b = a; b < n; b++)
        ASSERT_EQ(list.find(a, b) >= 0, pairs.by_slots.count({a, b}) == 1);
  }
}

TEST(PairList, NamesDistantPairs)
{
  constexpr int n = 6000;
  std::vector<std::uint64_t> key(n);
  std::vector<std::int64_t> tag(n);
  for (int a = 0; a < n; a++) {
    key[a] = a;
    tag[a] = a + 1;
  }
  ParticleOrder order;
  order.arrange(n, key, tag);
  slow::NeighborLists lists(n);
  RandomSource random(5);
  for (int k = 0; k < 4000; k++) {
    const int i = random.below(n - 1);
    lists.add(i, i + 1 + random.below(n - i - 1), 1.0);
  }
  PairList list;
  const WorkPartition work(order);
  list.collect(order, work, PairRows(order, lists.view()), 0);
  std::size_t found = 0;
  for (std::int64_t c = 0; c < list.num_pairs(); c++) {
    if (list.second[c] - list.first[c] <= 2048) continue;
    ASSERT_LT(found, list.distant.size());
    EXPECT_EQ(list.distant[found].pair, c);
    EXPECT_EQ(list.distant[found].slot, list.first[c]);
    found++;
  }
  EXPECT_GT(found, 100U);
  EXPECT_EQ(list.distant.size(), found);
}

TEST(PairList, StoresWeightsOnlyIfOneIsNotOne)
{
  PairList list;
  ParticleOrder order;
  for (double weight : {1.0, 0.5, 1.0}) {
    order.arrange(3, {7, 7, 7}, {3, 1, 2});
    slow::NeighborLists lists(3);
    lists.add(0, 1, 1.0);
    lists.add(2, 0, weight);
    const WorkPartition work(order);
    list.collect(order, work, PairRows(order, lists.view()), 0);
    EXPECT_EQ(list.weighted(), weight != 1.0);
    EXPECT_GT(list.memory_usage(), 0.0);
  }
}

TEST(PairList, ChunksHoldEveryPairOnce)
{
  RandomSource random(3);
  for (int threads : {1, 2, 3, 8})
    for (bool two_phases : {false, true}) {
      const Divided divided(200, threads, two_phases, random);
      BySlots<int> found;
      for (int c = 0; c < divided.work.num_chunks(); c++) {
        const PairList &list = divided.lists[c];
        for (std::int64_t n = 0; n < list.num_pairs(); n++) {
          const std::pair<int, int> slots{list.first[n], list.second[n]};
          found[slots]++;
          ASSERT_EQ(divided.work.chunk_with_pair(slots.first, slots.second), c);
          ASSERT_EQ(list.find(slots.second, slots.first), n);
          ASSERT_EQ(list.weighted() ? list.weights[n] : 1.0, divided.pairs.by_slots.at(slots));
          ASSERT_TRUE(list.slots().holds(slots.second));
          ASSERT_EQ(list.is_foreign(slots.first), !list.slots().holds(slots.first));
          const bool with_ghost =
              !divided.order.owns_slot(slots.first) || !divided.order.owns_slot(slots.second);
          ASSERT_EQ(list.is_late(), two_phases && with_ghost);
          if (n == 0) continue;
          const std::pair<int, int> before{list.first[n - 1], list.second[n - 1]};
          ASSERT_TRUE(InOrder()(before, slots));
        }
      }
      ASSERT_EQ(found.size(), divided.pairs.by_slots.size());
      for (const auto &one : found) ASSERT_EQ(one.second, 1);
    }
}

TEST(PairList, FrontierIsWhereForcesAreDeferred)
{
  RandomSource random(4);
  for (int threads : {1, 2, 5})
    for (bool two_phases : {false, true}) {
      const Divided divided(200, threads, two_phases, random);
      std::size_t at_frontier = 0;
      for (const PairList &list : divided.lists) {
        std::set<int> foreign;
        std::vector<std::uint32_t> frontier;
        for (std::uint32_t c = 0; c < list.num_pairs(); c++) {
          bool deferred = false;
          for (const int slot : {list.first[c], list.second[c]}) {
            const bool is_foreign = !list.slots().holds(slot);
            const bool has_late = two_phases && divided.work.is_late(slot);
            if (is_foreign) foreign.insert(slot);
            ASSERT_EQ(list.has_late(slot), has_late);
            ASSERT_EQ(list.defers(slot), is_foreign || has_late);
            deferred = deferred || is_foreign || has_late;
          }
          ASSERT_EQ(list.reaches_frontier(0, c), deferred || !frontier.empty());
          ASSERT_EQ(list.reaches_frontier(c, c), deferred);
          if (!list.frontier().empty()) {
            ASSERT_EQ(list.is_at_frontier(c), deferred);
            ASSERT_EQ(list.frontier_before(c), frontier.size());
          }
          if (deferred) frontier.push_back(c);
        }
        EXPECT_EQ(list.foreign, std::vector<int>(foreign.begin(), foreign.end()));
        EXPECT_EQ(list.frontier(), frontier);
        if (list.is_late()) {
          EXPECT_EQ(static_cast<std::int64_t>(frontier.size()), list.num_pairs());
        }
        at_frontier += frontier.size();
      }
      EXPECT_EQ(at_frontier > 0, threads > 1 || two_phases);
    }
}

TEST(PairList, PrefetchesForeignParticlesWhereTheyComeFirst)
{
  RandomSource random(7);
  const Divided divided(300, 3, false, random);
  std::size_t prefetched = 0;
  for (const PairList &list : divided.lists) {
    std::set<int> seen;
    std::vector<std::pair<std::uint32_t, int>> expected, found;
    for (std::uint32_t c = 0; c < list.num_pairs(); c++)
      if (list.is_foreign(list.first[c]) && seen.insert(list.first[c]).second)
        expected.emplace_back(c, list.first[c]);
    for (const auto &one : list.distant) found.emplace_back(one.pair, one.slot);
    EXPECT_EQ(found, expected);
    prefetched += found.size();
  }
  EXPECT_GT(prefetched, 100U);
}

TEST(PairList, PrefetchesAllOfLatePairs)
{
  RandomSource random(8);
  const Divided divided(300, 2, true, random);
  for (const PairList &list : divided.lists) {
    if (!list.is_late()) continue;
    std::set<int> wanted, prefetched;
    for (std::int64_t c = 0; c < list.num_pairs(); c++)
      wanted.insert({list.first[c], list.second[c]});
    for (const auto &one : list.distant) prefetched.insert(one.slot);
    EXPECT_EQ(prefetched, wanted);
    EXPECT_FALSE(wanted.empty());
  }
}

/// Foreign particles are read where their copies stand, all others where they are.
TEST(PairList, ReadsCopiesOfForeignParticles)
{
  RandomSource random(9);
  for (bool two_phases : {false, true}) {
    Divided divided(300, 3, two_phases, random);
    std::vector<int> copy(divided.order.size());
    for (int s = 0; s < divided.order.size(); s++) copy[s] = 1000 + s;
    for (PairList &list : divided.lists) {
      list.read_copies(copy);
      for (std::int64_t c = 0; c < list.num_pairs(); c++) {
        const int first = list.first[c];
        ASSERT_EQ(list.state_of_first()[c], list.is_foreign(first) ? copy[first] : first);
      }
      for (const auto &one : list.distant)
        EXPECT_TRUE(one.slot >= 1000 || !list.is_foreign(one.slot));
    }
  }
}

}    // namespace
