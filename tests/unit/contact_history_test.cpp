// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The history of a contact over rebuilds: kept when pairs are renumbered or turned round, lost when
// the particles separate, and the same on both sides.

#include "packing.h"
#include "test_rank.h"

#include <gtest/gtest.h>

using namespace Talus;
using namespace slow;

namespace {

constexpr double dt = 1e-3;
constexpr std::size_t empty = 2 + 1;    // luggage without contacts: origin, header of the list

LawTable history_laws()
{
  return single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, true);
}

void rebuild(TestRank &rank, const Packing &p, double skin, RandomSource &random)
{
  Luggage luggage;
  rank.depart(luggage);
  rank.rebuild(p, everyone(p), candidates(p, skin, false), luggage, random);
}

bool is_zero(const Record &h)
{
  return h.c[0] == 0.0 && h.c[1] == 0.0 && h.c[2] == 0.0;
}

bool same(const Record &a, const Record &b)
{
  return std::equal(a.c, a.c + 4, b.c);
}

TEST(ContactHistory, SurvivesKeysThatTurnEveryPairRound)
{
  RandomSource random(1);
  Packing p = random_packing(200, random);
  TestRank rank(history_laws());
  BruteForce reference;
  rebuild(rank, p, 0.5, random);
  for (int step = 0; step < 3; step++) rank.compute(p, dt, true);
  reference.compute(p, history_laws(), dt, true, false);

  std::map<std::pair<int, int>, Record> before;
  for (const auto &contact : reference.contacts) {
    const auto [i, j] = contact.first;
    before[{i, j}] = rank.history_of(i, j);
    ASSERT_FALSE(is_zero(before[{i, j}]));
    ASSERT_TRUE(same(rank.history_of(j, i), mirrored(before[{i, j}])));
  }
  for (std::uint64_t &key : p.key) key = ~key;
  for (int round = 0; round < 2; round++) {    // the second one without a step in between
    rebuild(rank, p, 0.5, random);
    for (const auto &[pair, history] : before)
      ASSERT_TRUE(same(rank.history_of(pair.first, pair.second), history));
  }
}

TEST(ContactHistory, SurvivesInPlace)
{
  RandomSource random(7);
  Packing p = random_packing(200, random);
  for (const int threads : {1, 3}) {
    TestRank in_place(history_laws()), moving(history_laws());
    in_place.divide(threads, false);
    rebuild(in_place, p, 0.5, random);
    rebuild(moving, p, 0.5, random);
    for (int round = 0; round < 4; round++) {
      for (int step = 0; step < 3; step++)
        for (TestRank *rank : {&in_place, &moving}) rank->compute(p, dt, true);
      for (std::uint64_t &key : p.key)
        if (random.chance(0.5)) key = ~key;
      Luggage none;
      in_place.depart_and_keep(none, [](int) { return true; });
      EXPECT_TRUE(none.empty());
      in_place.rebuild(p, everyone(p), candidates(p, 0.5, false), none, random);
      rebuild(moving, p, 0.5, random);
      int found = 0;
      for (int i = 0; i < p.size(); i++)
        for (int j = 0; j < i; j++) {
          const Record history = moving.history_of(i, j);
          ASSERT_TRUE(same(in_place.history_of(i, j), history));
          found += !is_zero(history);
        }
      EXPECT_GT(found, 100);
    }
  }
}

TEST(ContactHistory, FollowsParticlesThatGetOtherTags)
{
  RandomSource random(8);
  Packing p = random_packing(200, random);
  TestRank rank(history_laws());
  BruteForce reference;
  rebuild(rank, p, 0.5, random);
  rank.compute(p, dt, true);
  reference.compute(p, history_laws(), dt, true, false);
  std::map<std::pair<int, int>, Record> before;
  for (const auto &contact : reference.contacts)
    before[contact.first] = rank.history_of(contact.first.first, contact.first.second);

  Luggage luggage;
  rank.depart(luggage);
  random.shuffle(p.tag);
  luggage.erase(7);    // a new particle in the place of an old one
  rank.rebuild(p, everyone(p), candidates(p, 0.5, false), luggage, random);
  int forgotten = 0;
  for (const auto &[pair, history] : before) {
    const auto [i, j] = pair;
    const bool is_new = i == 7 || j == 7;
    forgotten += is_new;
    ASSERT_TRUE(same(rank.history_of(i, j), is_new ? Record{} : history)) << i << " " << j;
  }
  EXPECT_GT(forgotten, 0);
}

TEST(ContactHistory, FollowsTheSlowReferenceOverRebuilds)
{
  RandomSource random(2);
  Packing p = random_packing(200, random);
  const LawTable laws = mixed_laws();
  TestRank rank(laws);
  BruteForce reference;
  for (int step = 0; step < 20; step++) {
    if (step % 5 == 0) {
      p.refresh_keys(0.3 + 0.05 * step);
      rebuild(rank, p, 1.5, random);
    }
    rank.compute(p, dt, true);
    reference.compute(p, laws, dt, true, false);
    for (const auto &[pair, contact] : reference.contacts) {
      const int row = laws.row(p.type[pair.first], p.type[pair.second]);
      const Record h = rank.history_of(pair.first, pair.second);
      if (!laws.law(row).has_history()) {
        ASSERT_TRUE(is_zero(h));
        continue;
      }
      const double condition = contact.scale / contact.out.force_scale;
      for (int d = 0; d < 3; d++)
        ASSERT_NEAR(h.c[d], contact.out.history[d], 1e-12 * contact.out.history_scale * condition);
    }
    p.move(20.0 * dt, 0.2, random);
  }
}

/// Two spheres that slide along each other.
Packing two_spheres()
{
  RandomSource random(3);
  Packing p = random_packing(2, random);
  p.x = {Vector{0.0, 0.0, 0.0}, Vector{1.9, 0.0, 0.0}};
  p.v = {Vector{0.0, 1.0, 0.0}, Vector{0.0, -1.0, 0.5}};
  p.radius = {1.0, 1.0};
  return p;
}

TEST(ContactHistory, IsLostOnSeparation)
{
  RandomSource random(4);
  for (bool rebuilt : {false, true}) {
    Packing p = two_spheres();
    TestRank rank(history_laws());
    rebuild(rank, p, 0.5, random);
    rank.compute(p, dt, true);
    ASSERT_FALSE(is_zero(rank.history_of(0, 1)));
    p.x[1][0] = 2.1;
    rank.compute(p, dt, true);
    EXPECT_TRUE(is_zero(rank.history_of(0, 1)));
    if (rebuilt) rebuild(rank, p, 0.5, random);
    p.x[1][0] = 1.9;
    rank.compute(p, dt, false);
    EXPECT_TRUE(is_zero(rank.history_of(0, 1)));
  }
}

TEST(ContactHistory, IsLostWithTheCandidatePair)
{
  RandomSource random(5);
  Packing p = two_spheres();
  TestRank rank(history_laws());
  rebuild(rank, p, 0.5, random);
  rank.compute(p, dt, true);
  p.x[1][0] = 9.0;
  rebuild(rank, p, 0.5, random);    // no pair any more
  rank.compute(p, dt, true);
  EXPECT_TRUE(is_zero(rank.history_of(0, 1)));
  p.x[1][0] = 1.9;
  rebuild(rank, p, 0.5, random);
  EXPECT_TRUE(is_zero(rank.history_of(0, 1)));
}

TEST(ContactHistory, OnlyAdvancingStepsChangeIt)
{
  RandomSource random(6);
  Packing p = random_packing(100, random);
  TestRank rank(history_laws());
  BruteForce reference;
  rebuild(rank, p, 0.5, random);
  rank.compute(p, dt, true);
  reference.compute(p, history_laws(), dt, true, false);
  const std::vector<Vector> force = rank.force;
  for (int repeat = 0; repeat < 3; repeat++) {
    rank.compute(p, dt, false);
    EXPECT_EQ(rank.force, force);    // set-up after a restart: the same force again
  }
  for (const auto &[pair, contact] : reference.contacts) {
    const Record h = rank.history_of(pair.first, pair.second);
    for (int d = 0; d < 3; d++)
      ASSERT_NEAR(h.c[d], contact.out.history[d], 1e-12 * contact.out.history_scale);
  }
}

TEST(ContactHistory, NoneWithoutLawsThatKeepIt)
{
  RandomSource random(7);
  const Packing p = two_spheres();
  TestRank rank(single_law({named::Normal::HERTZ, named::Tangential::ONESTEP}, true));
  rebuild(rank, p, 0.5, random);
  rank.compute(p, dt, true);
  EXPECT_FALSE(rank.pipeline.keeps_history());
  EXPECT_TRUE(is_zero(rank.history_of(0, 1)));
  Luggage luggage;
  rank.depart(luggage);
  EXPECT_EQ(luggage[0].size(), empty);
}

TEST(ContactHistory, DoesNotComeBackAfterALawWithoutIt)
{
  RandomSource random(9);
  const Packing p = two_spheres();
  TestRank rank(history_laws());
  rebuild(rank, p, 0.5, random);
  rank.compute(p, dt, true);
  Luggage with, without;
  rank.depart(with);
  EXPECT_EQ(with[0].size(), empty + 3U + 4U);    // partner, feature, number of values and history
  rank.pipeline.set_laws(single_law({named::Normal::HERTZ, named::Tangential::ONESTEP}, true));
  rank.depart(without);
  EXPECT_EQ(without[0].size(), empty);
}

}    // namespace
