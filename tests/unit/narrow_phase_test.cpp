// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/narrow_phase.h"
#include "neighbor_lists.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Talus;

namespace {

bool touch(const Record &a, const Record &b)
{
  const double x = a.c[0] - b.c[0], y = a.c[1] - b.c[1], z = a.c[2] - b.c[2];
  const double reach = a.c[3] + b.c[3];
  return x * x + y * y + z * z < reach * reach;
}

constexpr int num_particles = 30;

/// A list of exactly `count` pairs of random particles, all different.
struct RandomPairs {
  ParticleOrder order;
  WorkPartition work;
  PairList list;

  RandomPairs(int count, RandomSource &random)
  {
    std::vector<std::uint64_t> key;
    std::vector<std::int64_t> tag;
    for (int a = 0; a < num_particles; a++) {
      key.push_back(random.bits());
      tag.push_back(1 + a);
    }
    order.arrange(num_particles, key, tag);
    work = WorkPartition(order);
    std::vector<std::pair<int, int>> all;
    for (int i = 0; i < num_particles; i++)
      for (int j = i + 1; j < num_particles; j++) all.emplace_back(i, j);
    random.shuffle(all);
    slow::NeighborLists lists(num_particles);
    for (int c = 0; c < count; c++) lists.add(all[c].first, all[c].second, 1.0);
    list.collect(order, work, PairRows(order, lists.view()), 0);
  }
};

/// All at once, or in stretches of a few pairs.
std::vector<std::uint32_t> find_all(const PairList &pairs, const std::vector<Record> &position,
                                    ContactHistory *history, std::int64_t stretch = 1 << 20)
{
  std::vector<std::uint32_t> found(pairs.num_pairs() + 8);
  std::int64_t n = 0;
  for (std::int64_t begin = 0; begin < pairs.num_pairs(); begin += stretch)
    n += find_contacts(pairs, begin, std::min(begin + stretch, pairs.num_pairs()), position.data(),
                       history, &found[n]);
  found.resize(n);
  return found;
}

std::vector<Record> random_positions(RandomSource &random)
{
  std::vector<Record> position;    // half of the pairs touch
  for (int a = 0; a < num_particles; a++) {
    const auto x = random.in_cube(1.0);
    position.push_back({{x[0], x[1], x[2], random.uniform(0.3, 0.75)}});
  }
  return position;
}

std::vector<std::uint32_t> by_brute_force(const PairList &pairs,
                                          const std::vector<Record> &position)
{
  std::vector<std::uint32_t> found;
  for (std::uint32_t c = 0; c < pairs.num_pairs(); c++)
    if (touch(position[pairs.first[c]], position[pairs.second[c]])) found.push_back(c);
  return found;
}

TEST(NarrowPhase, FindsWhatTouchesForAnyNumberOfPairs)
{
  RandomSource random(1);
  int touching = 0, pairs_seen = 0;
  for (int count = 0; count <= 40; count++)
    for (int round = 0; round < 50; round++) {
      const RandomPairs random_pairs(count, random);
      const PairList &pairs = random_pairs.list;
      const std::vector<Record> position = random_positions(random);
      const std::vector<std::uint32_t> found = find_all(pairs, position, nullptr);
      ASSERT_EQ(found, by_brute_force(pairs, position)) << count << " pairs";
      ASSERT_EQ(find_all(pairs, position, nullptr, 8), found);
      ASSERT_EQ(find_all(pairs, position, nullptr, 24), found);
      touching += static_cast<int>(found.size());
      pairs_seen += count;
    }
  EXPECT_GT(touching, pairs_seen / 4);
  EXPECT_LT(touching, 3 * pairs_seen / 4);
}

TEST(NarrowPhase, SpheresThatJustReachEachOtherDoNotTouch)
{
  RandomSource random(2);
  constexpr int all = num_particles * (num_particles - 1) / 2;
  const RandomPairs random_pairs(all, random);
  const PairList &pairs = random_pairs.list;
  const auto count = [&](const std::vector<Record> &p) {
    return find_all(pairs, p, nullptr).size();
  };
  std::vector<Record> position(num_particles, Record{{0.0, 0.0, 0.0, 0.5}});
  EXPECT_EQ(count(position), static_cast<std::size_t>(all));    // even with the same center
  for (int a = 0; a < num_particles; a++) position[a].c[0] = a;
  EXPECT_EQ(count(position), static_cast<std::size_t>(0));
  for (Record &p : position) p.c[3] = std::nextafter(0.5, 1.0);
  EXPECT_EQ(count(position), static_cast<std::size_t>(num_particles - 1));
}

TEST(NarrowPhase, MasksWhatTouchesAndForgetsTheRest)
{
  RandomSource random(3);
  int forgotten = 0;
  for (int count = 0; count <= 40; count++) {
    const RandomPairs random_pairs(count, random);
    const PairList &pairs = random_pairs.list;
    ContactHistory history;
    history.fetch(pairs, HistoryStore());
    std::vector<Record> expected(count);
    for (int step = 0; step < 20; step++) {
      const std::vector<Record> position = random_positions(random);
      find_all(pairs, position, &history, step % 2 ? 8 : 1 << 20);
      for (int c = 0; c < count; c++) {
        const bool now = touch(position[pairs.first[c]], position[pairs.second[c]]);
        ASSERT_EQ(history.touches(c), now);
        forgotten += !now && expected[c].c[0] != 0.0;
        if (!now) expected[c] = Record{};
        if (!now) continue;
        ASSERT_TRUE(std::equal(expected[c].c, expected[c].c + 4, history.record(c).c));
        // what a kernel would write
        expected[c] = {{random.uniform(1.0, 2.0), -1.0, 3.0, 1.0}};
        history.record(c) = expected[c];
      }
      for (int beyond = count; beyond % 8; beyond++) ASSERT_FALSE(history.touches(beyond));
    }
  }
  EXPECT_GT(forgotten, 1000);
}

/// By limits of any sign, and a question that is asked of those alone that have ended.
TEST(NarrowPhase, FindsWhatTouchesBeyondOverlap)
{
  RandomSource random(4);
  int reached = 0, lasted = 0, held = 0;
  for (int count = 0; count <= 40; count++) {
    const RandomPairs random_pairs(count, random);
    const PairList &pairs = random_pairs.list;
    ContactHistory history;
    history.fetch(pairs, HistoryStore());
    AlignedVector<double> limits(count + 8);
    std::vector<char> before(count), holds(count);
    for (int c = 0; c < count; c++) {
      limits[c] = random.uniform(-4.0, 4.0);
      holds[c] = random.chance(0.3);
    }
    for (int step = 0; step < 20; step++) {
      const std::vector<Record> position = random_positions(random);
      const auto overlaps = [&](int c) {
        return touch(position[pairs.first[c]], position[pairs.second[c]]);
      };
      const auto within = [&](int c) {
        const Record &a = position[pairs.first[c]], &b = position[pairs.second[c]];
        double square = 0.0;
        for (int d = 0; d < 3; d++) square += (a.c[d] - b.c[d]) * (a.c[d] - b.c[d]);
        return square < limits[c] || (before[c] && square < -limits[c]);
      };
      const BeyondTouch::Lasts asked = [&](std::int64_t pair, unsigned ended) {
        unsigned found = 0;
        for (int k = 0; k < 8; k++)
          if (ended >> k & 1U) {
            const int c = static_cast<int>(pair) + k;
            EXPECT_TRUE(before[c] && !overlaps(c) && !within(c));
            if (holds[c]) found |= 1U << k;
          }
        return found;
      };
      std::vector<std::uint32_t> found(count + 8), expected;
      found.resize(find_contacts(pairs, 0, count, position.data(), &history, found.data(),
                                 {limits.data(), &asked}));
      for (int c = 0; c < count; c++) {
        const bool now = overlaps(c) || within(c) || (before[c] && holds[c]);
        reached += !overlaps(c) && within(c) && !before[c];
        lasted += !overlaps(c) && within(c) && limits[c] < 0.0;
        held += now && !overlaps(c) && !within(c);
        before[c] = now;
        if (now) expected.push_back(c);
      }
      ASSERT_EQ(found, expected);
    }
  }
  EXPECT_GT(reached, 300);
  EXPECT_GT(lasted, 300);
  EXPECT_GT(held, 300);
}

}    // namespace
