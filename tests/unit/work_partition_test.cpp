// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/pair_rows.h"
#include "neighbors/work_partition.h"
#include "random_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

using namespace Talus;
using namespace slow;

namespace {

ParticleOrder random_order(int n, RandomSource &random)
{
  const Particles p = random_particles(n, random);
  ParticleOrder order;
  order.arrange(p.owned, p.key, p.tag);
  return order;
}

TEST(WorkPartition, OneChunkForAll)
{
  RandomSource random(1);
  for (const int n : {0, 1, 50}) {
    const ParticleOrder order = random_order(n, random);
    const WorkPartition work(order);
    EXPECT_EQ(work.num_chunks(), 1);
    EXPECT_FALSE(work.in_two_phases());
    EXPECT_EQ(work.range(0).begin, 0);
    EXPECT_EQ(work.range(0).end, n);
    EXPECT_EQ(work.range_of_thread(0).end, n);
    for (int s = 0; s < n; s++) EXPECT_EQ(work.chunk_with_pair(0, s), 0);
  }
}

TEST(WorkPartition, RangesOfThreadsHaveTheSameWork)
{
  RandomSource random(8);
  for (int threads : {1, 2, 3, 8})
    for (bool two_phases : {false, true}) {
      const ParticleOrder order = random_order(600, random);
      Pairs pairs(order, 0.02, 1.0, random);
      const WorkPartition work(order, PairRows(order, pairs.lists.view(), threads), threads,
                               two_phases);
      std::vector<int> work_of_slot(order.size());
      for (int s = 0; s < order.size(); s++) work_of_slot[s] = order.owns_slot(s);
      for (const auto &[slots, weight] : pairs.by_slots) work_of_slot[slots.second]++;
      const auto work_in = [&](SlotRange range) {
        return std::accumulate(work_of_slot.begin() + range.begin, work_of_slot.begin() + range.end,
                               0.0);
      };
      const double share = work_in({0, order.size()}) / threads,
                   most = *std::max_element(work_of_slot.begin(), work_of_slot.end());
      int end = 0;
      for (int r = 0; r < work.num_ranges(); r++) {    // side by side, some smaller
        ASSERT_EQ(work.range(r).begin, end);
        end = work.range(r).end;
        EXPECT_LT(work_in(work.range(r)), share + 2.0 * most);
        for (int s = work.range(r).begin; s < end; s++) ASSERT_EQ(work.range_of(s), r);
      }
      EXPECT_EQ(end, order.size());
      end = 0;
      for (int t = 0; t < threads; t++) {
        ASSERT_EQ(work.range_of_thread(t).begin, end);
        end = work.range_of_thread(t).end;
        EXPECT_NEAR(work_in(work.range_of_thread(t)), share, most);
      }
      EXPECT_EQ(end, order.size());
    }
}

TEST(WorkPartition, MoreThreadsThanParticles)
{
  RandomSource random(2);
  for (const int n : {0, 1, 7}) {
    const ParticleOrder order = random_order(n, random);
    Pairs pairs(order, 0.5, 1.0, random);
    const WorkPartition work(order, PairRows(order, pairs.lists.view(), 300), 300, true);
    std::vector<int> times(n, 0);
    for (int r = 0; r < work.num_ranges(); r++)
      for (int s = work.range(r).begin; s < work.range(r).end; s++) {
        times[s]++;
        EXPECT_EQ(work.range_of(s), r);
      }
    EXPECT_EQ(times, std::vector<int>(n, 1));
  }
}

TEST(WorkPartition, ParticlesBesideGhostsAreLate)
{
  RandomSource random(5);
  for (const int threads : {1, 3}) {
    const ParticleOrder order = random_order(200, random);
    Pairs pairs(order, 0.01, 1.0, random);
    const WorkPartition work(order, PairRows(order, pairs.lists.view(), threads), threads, true);
    std::set<int> beside;
    for (const auto &one : pairs.by_slots)
      for (const auto &[slot, partner] : {std::pair(one.first.first, one.first.second),
                                          std::pair(one.first.second, one.first.first)})
        if (order.owns_slot(slot) && !order.owns_slot(partner)) beside.insert(slot);
    ASSERT_GT(beside.size(), 10U);
    for (int s = 0; s < order.size(); s++) {
      EXPECT_EQ(work.is_late(s), beside.count(s) == 1);
      EXPECT_EQ(work.is_ghost(s), !order.owns_slot(s));
    }
    EXPECT_LT(beside.size(), static_cast<std::size_t>(order.owned));
  }
}

TEST(WorkPartition, EveryRangeIsWanted)
{
  RandomSource random(9);
  for (int threads : {1, 2, 3, 8}) {
    const ParticleOrder order = random_order(100, random);
    Pairs pairs(order, 0.1, 1.0, random);
    const WorkPartition work(order, PairRows(order, pairs.lists.view()), threads, false);
    std::set<int> first_wanted;
    std::vector<int> done;    // by one thread after the other
    for (int t = 0; t < threads; t++) {
      bool first = true;
      work.for_each_wanted(t, [&](int range) {
        ASSERT_GE(range, 0);
        ASSERT_LT(range, work.num_ranges());
        if (first) {
          EXPECT_TRUE(first_wanted.insert(range).second);
        }
        first = false;
        if (std::find(done.begin(), done.end(), range) == done.end()) done.push_back(range);
      });
    }
    EXPECT_EQ(static_cast<int>(done.size()), work.num_ranges());
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  }
}

}    // namespace
