// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbor_lists.h"
#include "neighbors/pair_list.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

using namespace Talus;

namespace {

/// Particles with few different keys, so that tags decide often; the last third are images of
/// others.
struct Particles {
  std::vector<std::uint64_t> key;
  std::vector<std::int64_t> tag;
  int owned = 0;

  int size() const { return static_cast<int>(tag.size()); }
};

Particles random_particles(int n, RandomSource &random)
{
  Particles p;
  for (int a = 0; a < n; a++) {
    p.key.push_back(random.bits() % 5 << (random.chance(0.5) ? 60 : 0));
    p.tag.push_back(1 + a);
  }
  random.shuffle(p.tag);
  const int originals = (2 * n + 2) / 3;
  for (int a = originals; a < n; a++) {
    const int original = random.below(originals);
    p.key[a] = p.key[original];
    p.tag[a] = p.tag[original];
  }
  p.owned = n / 2;
  return p;
}

TEST(ParticleOrder, OrdersParticlesByKeyThenTagThenHost)
{
  RandomSource random(1);
  for (int n : {0, 1, 2, 3, 50, 333}) {
    const Particles p = random_particles(n, random);
    ParticleOrder order;
    order.arrange(p.owned, p.key, p.tag);
    ASSERT_EQ(order.size(), n);
    ASSERT_EQ(order.num_chunks(), 1);
    EXPECT_EQ(order.tag, p.tag);
    for (int s = 0; s < n; s++) {
      ASSERT_EQ(order.slot_of_atom[order.atom_of_slot[s]], s);
      ASSERT_EQ(order.part(s), 0);
      if (s == 0) continue;
      const int a = order.atom_of_slot[s - 1], b = order.atom_of_slot[s];
      const auto rank = [&](int atom) { return std::tuple(p.key[atom], p.tag[atom], atom); };
      ASSERT_LT(rank(a), rank(b));
    }
  }
}

TEST(ParticleOrder, ThreadsDoNotShow)
{
  RandomSource random(6);
  for (int n : {0, 1, 5, 400})
    for (bool sorted : {false, true}) {
      Particles p = random_particles(n, random);
      if (sorted)
        for (int a = 0; a < p.owned; a++) p.key[a] = a;
      ParticleOrder one, several;
      one.arrange(p.owned, p.key, p.tag);
      for (int threads : {2, 3, 8}) {
        several.arrange(p.owned, p.key, p.tag, threads);
        EXPECT_EQ(several.atom_of_slot, one.atom_of_slot);
        EXPECT_EQ(several.slot_of_atom, one.slot_of_atom);
      }
    }
}

/// By the second slot, then the first.
struct InOrder {
  bool operator()(const std::pair<int, int> &a, const std::pair<int, int> &b) const
  {
    return std::tie(a.second, a.first) < std::tie(b.second, b.first);
  }
};
template <class T> using BySlots = std::map<std::pair<int, int>, T, InOrder>;

/// Random pairs of particles of which at least one is owned, as weights by slots.
struct Pairs {
  slow::NeighborLists lists;
  BySlots<double> by_slots;    // in the order wanted

  Pairs(const ParticleOrder &order, double chance, double odd_weight, RandomSource &random) :
      lists(order.owned)
  {
    std::vector<std::tuple<int, int, double>> pairs;
    for (int i = 0; i < order.owned; i++)
      for (int j = i + 1; j < order.size(); j++)
        if (random.chance(chance)) pairs.emplace_back(i, j, random.chance(0.8) ? 1.0 : odd_weight);
    random.shuffle(pairs);
    for (auto [i, j, weight] : pairs) {
      by_slots[std::minmax({order.slot_of_atom[i], order.slot_of_atom[j]})] = weight;
      if (random.chance(0.5)) std::swap(i, j);
      lists.add(i, j, weight);
    }
  }
};

TEST(PairList, SortsPairsAndKeepsTheirWeights)
{
  RandomSource random(2);
  PairList list;    // used again and again, as at rebuilds
  ParticleOrder order;
  for (int n : {40, 0, 7, 120, 2, 300}) {
    const Particles p = random_particles(n, random);
    order.arrange(p.owned, p.key, p.tag);
    Pairs pairs(order, 0.2, 0.25, random);    // 300: rows of more than the few that are usual
    list.collect(order, PairRows(order, pairs.lists.view()), 0);

    ASSERT_EQ(list.num_pairs(), static_cast<std::int64_t>(pairs.by_slots.size()));
    std::int64_t c = 0;
    for (const auto &[slots, weight] : pairs.by_slots) {
      ASSERT_EQ(list.first[c], slots.first);
      ASSERT_EQ(list.second[c], slots.second);
      ASSERT_EQ(list.weighted() ? list.weights[c] : 1.0, weight);
      ASSERT_EQ(list.find(slots.first, slots.second), c);
      ASSERT_EQ(list.find(slots.second, slots.first), c);
      ASSERT_TRUE(list.counts(c));
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
  list.collect(order, PairRows(order, lists.view()), 0);
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

TEST(PairList, CallsForeignParticlesWhereTheyComeFirst)
{
  RandomSource random(7);
  for (bool two_phases : {false, true}) {
    const Particles p = random_particles(300, random);
    ParticleOrder order;
    order.arrange(p.owned, p.key, p.tag);
    Pairs pairs(order, 0.02, 1.0, random);
    order.divide(PairRows(order, pairs.lists.view()), 3, two_phases);
    std::size_t called = 0;
    for (int part = 0; part < order.num_chunks(); part++) {
      PairList list;
      list.collect(order, PairRows(order, pairs.lists.view()), part);
      std::set<int> seen;
      std::vector<std::pair<std::uint32_t, int>> expected, found;
      for (std::uint32_t c = 0; c < list.num_pairs(); c++)
        for (int slot : {list.first[c], list.second[c]})
          if (!list.serves(slot) && seen.insert(slot).second) expected.emplace_back(c, slot);
      for (const auto &its : list.distant) found.emplace_back(its.pair, its.slot);
      EXPECT_EQ(found, expected);
      called += found.size();
    }
    EXPECT_GT(called, 100U);
  }
}

/// To the part of the second particle, in two phases to those of both.
bool belongs_to(int part, std::pair<int, int> slots, const ParticleOrder &order)
{
  return order.part(slots.second) == part ||
         (order.in_two_phases() && order.part(slots.first) == part);
}

TEST(PairList, ForeignSlotsAreThoseOfOtherParts)
{
  RandomSource random(4);
  for (int threads : {1, 2, 5})
    for (bool two_phases : {false, true}) {
      const Particles p = random_particles(200, random);
      ParticleOrder order;
      order.arrange(p.owned, p.key, p.tag);
      Pairs pairs(order, 0.02, 1.0, random);
      order.divide(PairRows(order, pairs.lists.view(), threads), threads, two_phases);
      for (int s = 0; s < order.size(); s++) {
        const int part = order.part(s);
        const bool is_ghost = !order.is_owned(order.atom_of_slot[s]);
        ASSERT_EQ(part == ParticleOrder::no_chunk, two_phases && is_ghost);
        if (part == ParticleOrder::no_chunk) continue;
        ASSERT_GE(s, order.range(part).begin);
        ASSERT_LT(s, order.range(part).end);
      }
      for (int part = 0; part < order.num_chunks(); part++) {
        const auto is_of_other = [&](int s) {
          return order.part(s) != part && order.part(s) != ParticleOrder::no_chunk;
        };
        std::set<int> expected;
        std::vector<std::uint32_t> handed_over;
        std::uint32_t c = 0;
        for (const auto &[slots, weight] : pairs.by_slots) {
          if (!belongs_to(part, slots, order)) continue;
          for (const int slot : {slots.first, slots.second})
            if (is_of_other(slot)) expected.insert(slot);
          if (!two_phases && is_of_other(slots.first)) handed_over.push_back(c);
          c++;
        }
        PairList list;
        list.collect(order, PairRows(order, pairs.lists.view()), part);
        EXPECT_EQ(list.foreign, std::vector<int>(expected.begin(), expected.end()));
        EXPECT_EQ(list.handed_over(), handed_over);
        EXPECT_EQ(list.hands_over(), !two_phases && part > 0);
      }
    }
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
    list.collect(order, PairRows(order, lists.view()), 0);
    EXPECT_EQ(list.weighted(), weight != 1.0);
    EXPECT_GT(list.memory_usage(), 0.0);
  }
}

TEST(ParticleOrder, RangesOfThreadsHaveTheSameWork)
{
  RandomSource random(8);
  for (int threads : {1, 2, 3, 8}) {
    const Particles p = random_particles(600, random);
    ParticleOrder order;
    order.arrange(p.owned, p.key, p.tag);
    Pairs pairs(order, 0.02, 1.0, random);
    order.divide(PairRows(order, pairs.lists.view(), threads), threads, false);
    std::vector<int> work(order.size());
    for (int s = 0; s < order.size(); s++) work[s] = order.is_owned(order.atom_of_slot[s]);
    for (const auto &[slots, weight] : pairs.by_slots) work[slots.second]++;
    const auto work_of = [&](ParticleOrder::Range range) {
      return std::accumulate(work.begin() + range.begin, work.begin() + range.end, 0.0);
    };
    const double share = work_of({0, order.size()}) / threads,
                 most = *std::max_element(work.begin(), work.end());
    int end = 0;
    for (int part = 0; part < order.num_chunks(); part++) {    // side by side, some smaller
      ASSERT_EQ(order.range(part).begin, end);
      end = order.range(part).end;
      EXPECT_LT(work_of(order.range(part)), share + 2.0 * most);
    }
    EXPECT_EQ(end, order.size());
    end = 0;
    for (int t = 0; t < threads; t++) {
      ASSERT_EQ(order.range_of_thread(t).begin, end);
      end = order.range_of_thread(t).end;
      EXPECT_NEAR(work_of(order.range_of_thread(t)), share, most);
    }
    EXPECT_EQ(end, order.size());
  }
}

TEST(ParticleOrder, EveryPartIsWanted)
{
  RandomSource random(9);
  for (int threads : {1, 2, 3, 8}) {
    const Particles p = random_particles(100, random);
    ParticleOrder order;
    order.arrange(p.owned, p.key, p.tag);
    order.divide(PairRows(order, Pairs(order, 0.1, 1.0, random).lists.view()), threads, false);
    std::set<int> first_wanted;
    std::vector<int> done;    // by one thread after the other
    for (int t = 0; t < threads; t++) {
      bool first = true;
      order.for_each_wanted(t, [&](int part) {
        ASSERT_GE(part, 0);
        ASSERT_LT(part, order.num_chunks());
        if (first) {
          EXPECT_TRUE(first_wanted.insert(part).second);
        }
        first = false;
        if (std::find(done.begin(), done.end(), part) == done.end()) done.push_back(part);
      });
    }
    EXPECT_EQ(static_cast<int>(done.size()), order.num_chunks());
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  }
}

TEST(PairList, PartsHoldEveryPairOfTheirParticles)
{
  RandomSource random(3);
  for (int threads : {1, 2, 3, 8})
    for (bool two_phases : {false, true}) {
      const Particles p = random_particles(200, random);
      ParticleOrder order;
      order.arrange(p.owned, p.key, p.tag);
      Pairs pairs(order, 0.02, 1.0, random);
      order.divide(PairRows(order, pairs.lists.view(), threads), threads, two_phases);
      if (two_phases) {
        ASSERT_EQ(order.num_chunks(), 2 * threads);
      }

      BySlots<int> counted;
      std::vector<int> particles_of_part(order.num_chunks(), 0);
      for (int part = 0; part < order.num_chunks(); part++) {
        PairList list;
        list.collect(order, PairRows(order, pairs.lists.view()), part);
        BySlots<double> expected;
        for (const auto &pair : pairs.by_slots)
          if (belongs_to(part, pair.first, order)) expected.insert(pair);
        ASSERT_EQ(list.num_pairs(), static_cast<std::int64_t>(expected.size()));
        std::int64_t c = 0;
        for (const auto &pair : expected) {
          ASSERT_EQ(std::pair(list.first[c], list.second[c]), pair.first);
          counted[pair.first] += list.counts(c);
          for (int slot : {list.first[c], list.second[c]}) {
            const bool needs_ghost = !order.is_owned(order.atom_of_slot[slot]);
            ASSERT_FALSE(two_phases && part < threads && needs_ghost);
          }
          c++;
        }
        for (int s = 0; s < order.size(); s++) {
          const bool owned = order.is_owned(order.atom_of_slot[s]);
          ASSERT_TRUE(!list.serves(s) || owned || !two_phases);
          particles_of_part[part] += owned && list.serves(s);
        }
      }
      for (const auto &pair : pairs.by_slots) ASSERT_EQ(counted[pair.first], 1);
      int total = 0;
      for (int n : particles_of_part) total += n;
      EXPECT_EQ(total, order.owned);
    }
}

}    // namespace
