// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/candidate_list.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
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

TEST(CandidateList, OrdersParticlesByKeyThenTagThenHost)
{
  RandomSource random(1);
  for (int n : {0, 1, 2, 3, 50, 333}) {
    const Particles p = random_particles(n, random);
    CandidateList list;
    list.order_particles(p.owned, p.key, p.tag);
    ASSERT_EQ(list.num_particles(), n);
    EXPECT_EQ(list.tag, p.tag);
    for (int s = 0; s < n; s++) {
      ASSERT_EQ(list.slot_of_atom[list.atom_of_slot[s]], s);
      ASSERT_EQ(list.is_owned(list.atom_of_slot[s]), list.atom_of_slot[s] < p.owned);
      if (s == 0) continue;
      const int a = list.atom_of_slot[s - 1], b = list.atom_of_slot[s];
      const auto rank = [&](int atom) { return std::tuple(p.key[atom], p.tag[atom], atom); };
      ASSERT_LT(rank(a), rank(b));
    }
  }
}

TEST(CandidateList, SortsPairsAndKeepsTheirWeights)
{
  RandomSource random(2);
  CandidateList list;    // used again and again, as at rebuilds
  for (int n : {40, 0, 7, 120, 2}) {
    const Particles p = random_particles(n, random);
    list.order_particles(p.owned, p.key, p.tag);
    std::map<std::pair<int, int>, double> expected;    // by slots, in the order wanted
    std::vector<std::tuple<int, int, double>> pairs;
    for (int i = 0; i < n; i++)
      for (int j = i + 1; j < n; j++)
        if (random.chance(0.2)) pairs.emplace_back(i, j, random.chance(0.8) ? 1.0 : 0.25);
    random.shuffle(pairs);
    for (auto [i, j, weight] : pairs) {
      expected[std::minmax({list.slot_of_atom[i], list.slot_of_atom[j]})] = weight;
      if (random.chance(0.5)) std::swap(i, j);
      list.add_pair(i, j, weight);
    }
    list.finish();

    ASSERT_EQ(list.num_pairs(), static_cast<std::int64_t>(expected.size()));
    std::int64_t c = 0;
    for (const auto &[slots, weight] : expected) {
      ASSERT_EQ(list.first[c], slots.first);
      ASSERT_EQ(list.second[c], slots.second);
      ASSERT_EQ(list.weighted() ? list.weights[c] : 1.0, weight);
      ASSERT_EQ(list.find(slots.first, slots.second), c);
      ASSERT_EQ(list.find(slots.second, slots.first), c);
      c++;
    }
    for (int a = 0; a < n; a++)
      for (int b = a; b < n; b++) ASSERT_EQ(list.find(a, b) >= 0, expected.count({a, b}) == 1);
  }
}

TEST(CandidateList, StoresWeightsOnlyIfOneIsNotOne)
{
  CandidateList list;
  for (double weight : {1.0, 0.5, 1.0}) {
    list.order_particles(3, {7, 7, 7}, {3, 1, 2});
    list.add_pair(0, 1, 1.0);
    list.add_pair(2, 0, weight);
    list.finish();
    EXPECT_EQ(list.weighted(), weight != 1.0);
    EXPECT_GT(list.memory_usage(), 0.0);
  }
}

}    // namespace
