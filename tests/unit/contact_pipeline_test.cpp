// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The whole way from positions to forces on one rank, against brute force over all pairs.

#include "packing.h"
#include "test_rank.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

using namespace Talus;
using namespace slow;

namespace {

constexpr double tolerance = 1e-12;    // of the sums of magnitudes; histories add up over the steps
constexpr double dt = 1e-3;

struct Scene {
  std::string name;
  LawTable laws;
};

std::vector<Scene> scenes()
{
  std::vector<Scene> list{{"mixed", mixed_laws()}};
  for (named::NamedLaw law : reference::stock_laws())
    for (bool spread : {false, true})
      list.push_back(
          {reference::title(law) + (spread ? " spread" : " uniform"), single_law(law, spread)});
  return list;
}

bool close(const Vector &a, const Vector &b, double scale)
{
  return norm(axpy(-1.0, b, a)) <= tolerance * scale;    // false if anything is not a number
}

void expect_same_sums(const TestRank &rank, const BruteForce &slow_reference, const Packing &p)
{
  const BruteForce::Sums sums = slow_reference.sums(p.size());
  for (int i = 0; i < p.size(); i++) {
    ASSERT_TRUE(close(rank.force[i], sums.force[i], sums.scale[i])) << "force on " << i;
    ASSERT_TRUE(close(rank.torque[i], sums.torque[i], sums.scale[i])) << "torque on " << i;
  }
}

void expect_same_contacts(const TestRank &rank, const BruteForce &slow_reference, const Packing &p,
                          bool with_history)
{
  ASSERT_EQ(rank.tally.size(), slow_reference.contacts.size());
  ASSERT_EQ(ContactSurvey(rank.pipeline).count_contacts(),
            static_cast<double>(slow_reference.contacts.size()));
  std::set<std::pair<int, int>> seen;
  std::array<double, VirialSums::size> virial{}, scale{};
  for (const TalliedContact &r : rank.tally) {
    const int i = rank.particle[r.i], j = rank.particle[r.j];
    for (int n = 0; n < VirialSums::size; n++) {
      constexpr int of_force[] = {0, 1, 2, 1, 2, 2}, of_separation[] = {0, 1, 2, 0, 0, 1};
      const double one = 0.5 * ((r.i < rank.owned) + (r.j < rank.owned)) * r.force[of_force[n]] *
                         r.separation[of_separation[n]];
      virial[n] += one;
      scale[n] += std::fabs(one);
    }
    ASSERT_TRUE(seen.insert(std::minmax(i, j)).second) << "reported twice";
    const auto found = slow_reference.contacts.find(std::minmax(i, j));
    ASSERT_NE(found, slow_reference.contacts.end()) << "reported without contact";
    const PairOutcome &expected = found->second;
    const double side = i < j ? 1.0 : -1.0;
    for (int d = 0; d < 3; d++) {
      const double force = side * expected.weight * expected.out.force[d];
      ASSERT_NEAR(r.force[d], force, tolerance * expected.scale);
      ASSERT_EQ(r.separation[d], p.x[i][d] - p.x[j][d]);
    }
    if (!with_history) continue;
    const Record h = rank.history_of(i, j);
    for (int d = 0; d < 3; d++)
      ASSERT_NEAR(h.c[d], side * expected.out.history[d],
                  tolerance * expected.out.history_scale * expected.scale /
                      expected.out.force_scale);
    ASSERT_TRUE(!expected.out.clear_case || (h.c[3] > 0.0) == expected.out.sliding);
  }
  for (int n = 0; n < VirialSums::size; n++)
    ASSERT_NEAR(rank.virial[n], virial[n], 1e-13 * scale[n]) << n;
}

class Pipeline : public testing::TestWithParam<Scene> {};

TEST_P(Pipeline, AgreesWithBruteForce)
{
  const LawTable &laws = GetParam().laws;
  for (bool weighted : {false, true}) {
    RandomSource random(weighted ? 3 : 4);
    Packing p = random_packing(300, random);
    TestRank rank(laws);
    BruteForce reference;
    rank.rebuild(p, everyone(p), candidates(p, 1.0, weighted), {}, random);
    EXPECT_EQ(ContactSurvey(rank.pipeline).count_candidates(),
              static_cast<double>(candidates(p, 1.0, weighted).size()));
    for (int step = 0; step < 12; step++) {
      const bool advance = step != 0 && step != 6;    // as in the set-up of a run
      rank.compute(p, dt, advance);
      reference.compute(p, laws, dt, advance, weighted);
      ASSERT_GT(reference.contacts.size(), 500U);
      ASSERT_NO_FATAL_FAILURE(expect_same_sums(rank, reference, p)) << "step " << step;
      ASSERT_NO_FATAL_FAILURE(
          expect_same_contacts(rank, reference, p, laws.has_history() && advance))
          << "step " << step;
      p.move(20.0 * dt, 0.2, random);
    }
  }
}

// Between runs pairs stay, also where large memory is released at rebuilds; what is asked about
// them then is what it was in the last step.
TEST_P(Pipeline, AnswersAfterARunAreThoseOfItsLastStep)
{
  const auto survey = [](const ContactPipeline &contacts) {
    const DeepestContact deepest = ContactSurvey(contacts).deepest_contact();
    return std::vector<double>{ContactSurvey(contacts).count_contacts(),
                               ContactSurvey(contacts).count_candidates(),
                               ContactSurvey(contacts).smallest_contact_period(),
                               ContactSurvey(contacts).largest_relative_speed(),
                               deepest.overlap_ratio,
                               static_cast<double>(deepest.i),
                               static_cast<double>(deepest.j)};
  };
  RandomSource random(6);
  Packing p = random_packing(60, random);
  TestRank rank(GetParam().laws);
  rank.pipeline.set_release_threshold(0.0);
  rank.rebuild(p, everyone(p), candidates(p, 1.0, false), {}, random);
  std::vector<double> before;
  for (int step = 0; step < 2; step++) {
    rank.compute(p, dt, true);
    const std::vector<double> at_end = survey(rank.pipeline);
    for (int n = 0; n < 5; n++) EXPECT_GT(at_end[n], 0.0) << n;
    EXPECT_NE(at_end, before);
    HistoryStore aside;
    rank.pipeline.motion().leave();
    rank.pipeline.keep_history(aside, {true, false}, true);
    EXPECT_TRUE(rank.pipeline.has_pairs());
    EXPECT_EQ(survey(rank.pipeline), at_end);
    before = at_end;
    p.move(20.0 * dt, 0.2, random);
  }
  rank.pipeline.release();
  EXPECT_FALSE(rank.pipeline.has_pairs());
}

// Blocks of 64 contacts and vectors of 8 with every kind of remainder.
TEST_P(Pipeline, HandlesAnyNumberOfContacts)
{
  const LawTable &laws = GetParam().laws;
  RandomSource random(5);
  std::set<std::size_t> counts;
  for (int n = 1; n <= 60; n++) {
    const Packing p = random_packing(n, random);
    TestRank rank(laws);
    BruteForce reference;
    rank.rebuild(p, everyone(p), candidates(p, 0.3, false), {}, random);
    rank.compute(p, dt, true);
    reference.compute(p, laws, dt, true, false);
    ASSERT_NO_FATAL_FAILURE(expect_same_sums(rank, reference, p)) << reference.contacts.size();
    ASSERT_NO_FATAL_FAILURE(expect_same_contacts(rank, reference, p, laws.has_history()));
    counts.insert(reference.contacts.size() % 8);
  }
  EXPECT_EQ(counts.size(), 8U);
}

TEST_P(Pipeline, EmptyRank)
{
  RandomSource random(6);
  const Packing p = random_packing(0, random);
  TestRank rank(GetParam().laws);
  for (int n = 0; n < 2; n++) {
    Luggage luggage;
    rank.depart(luggage);
    rank.rebuild(p, {}, {}, luggage, random);
    rank.compute(p, dt, true);
    EXPECT_TRUE(rank.tally.empty());
    EXPECT_EQ(ContactSurvey(rank.pipeline).count_contacts(), 0.0);
    EXPECT_EQ(ContactSurvey(rank.pipeline).count_candidates(), 0.0);
  }
}

TEST_P(Pipeline, CoincidentCentersGiveNoForce)
{
  RandomSource random(7);
  Packing p = random_packing(40, random);
  for (int i = 0; i < 40; i += 2) p.x[i] = p.x[i + 1];
  TestRank rank(GetParam().laws);
  BruteForce reference;
  rank.rebuild(p, everyone(p), candidates(p, 1.0, false), {}, random);
  for (int step = 0; step < 3; step++) {
    rank.compute(p, dt, true);
    reference.compute(p, GetParam().laws, dt, true, false);
    ASSERT_NO_FATAL_FAILURE(expect_same_sums(rank, reference, p));
    EXPECT_EQ(ContactSurvey(rank.pipeline).count_contacts(),
              static_cast<double>(reference.contacts.size()));
  }
}

/// The partners of each owned particle, in the order in which their contacts were reported.
std::map<int, std::vector<int>> partners_in_order(const TestRank &rank)
{
  std::map<int, std::vector<int>> partners;
  for (const TalliedContact &r : rank.tally) {
    EXPECT_TRUE(r.for_i || r.for_j);
    if (r.for_i && r.i < rank.owned) partners[rank.particle[r.i]].push_back(rank.particle[r.j]);
    if (r.for_j && r.j < rank.owned) partners[rank.particle[r.j]].push_back(rank.particle[r.i]);
  }
  return partners;
}

// On a rank with ghosts: contacts are computed and counted as often as in one phase without threads, that is once,
// and each end of them is reported once, in the same order for every particle, with the same bits of the sums.
TEST_P(Pipeline, ThreadsAndPhasesComputeEveryPairOnce)
{
  const LawTable &laws = GetParam().laws;
  RandomSource random(8);
  Packing p = random_packing(300, random);
  const std::vector<int> mine = [&] {
    std::vector<int> some;
    for (int i = 0; i < p.size(); i++)
      if (p.x[i][0] < 0.5) some.push_back(i);
    return some;
  }();
  for (const int threads : {1, 2, 3}) {
    TestRank simple(laws), divided(laws);
    divided.divide(threads, true);
    for (TestRank *rank : {&simple, &divided})
      rank->rebuild(p, mine, candidates(p, 1.0, true), {}, random);
    EXPECT_EQ(ContactSurvey(divided.pipeline).count_candidates(),
              ContactSurvey(simple.pipeline).count_candidates());
    const double share = ContactSurvey(divided.pipeline).early_share();
    EXPECT_TRUE(share > 0.2 && share < 1.0) << share;
    for (int step = 0; step < 3; step++) {
      for (TestRank *rank : {&simple, &divided}) rank->compute(p, dt, true);
      ASSERT_GT(simple.tally.size(), 200U);
      EXPECT_EQ(ContactSurvey(divided.pipeline).count_contacts(),
                ContactSurvey(simple.pipeline).count_contacts());
      EXPECT_EQ(partners_in_order(divided), partners_in_order(simple));
      EXPECT_EQ(divided.force, simple.force);
      EXPECT_EQ(divided.torque, simple.torque);
      EXPECT_EQ(divided.virial, simple.virial);
      p.move(20.0 * dt, 0.2, random);
    }
    for (TestRank *rank : {&simple, &divided}) {
      rank->reports = false;    // which one thread makes
      rank->compute(p, dt, true);
    }
    EXPECT_EQ(divided.force, simple.force);
    EXPECT_EQ(divided.virial, simple.virial);
  }
}

// Masses may be replaced or not, and angular velocities are not looked at where nothing needs them.
TEST(ContactPipeline, TakesOnlyWhatTheSceneNeeds)
{
  double x[] = {0.0, 0.0, 0.0, 1.5, 0.0, 0.0}, v[] = {1.0, 2.0, 0.0, 0.0, 0.0, 0.0};
  const double radius[] = {1.0, 1.0}, mass[] = {2.0, 2.0};
  const LawTable laws = single_law({named::Normal::HOOKE, named::Tangential::NONE}, false);
  ContactPipeline pipeline;
  pipeline.set_laws(laws);
  EXPECT_FALSE(pipeline.keeps_history());
  EXPECT_FALSE(pipeline.keeps_omega());
  NeighborLists lists(2);
  lists.add(1, 0, 1.0);
  pipeline.set_pairs({2, {0, 0}, {1, 2}, nullptr}, lists.view());
  HistoryStore nothing_kept;
  pipeline.start_pairs(nothing_kept);
  double f[6] = {10.0, 20.0, 30.0, 40.0, 50.0, 60.0};    // forces are added
  pipeline.compute({x, v, nullptr, radius, mass, nullptr, f, nullptr}, {dt, true});
  const double push = 800.0 * 0.5 + 1.0 * 3.0 * 1.0;    // kn overlap + m_eff gn (approach)
  EXPECT_DOUBLE_EQ(f[0], 10.0 - push);
  EXPECT_DOUBLE_EQ(f[3], 40.0 + push);
  EXPECT_EQ(f[1], 20.0);
  EXPECT_EQ(f[5], 60.0);
}

// A chain of spheres so long that its memory is worth giving back between two lists.
TEST(ContactPipeline, GoesOnAfterMemoryWasGivenBack)
{
  constexpr int n = 450000;
  std::vector<double> x, v, omega, radius(n, 1.0), mass(n, 2.0);
  std::vector<std::uint64_t> key;
  std::vector<std::int64_t> tag;
  NeighborLists lists(n);
  for (int i = 0; i < n; i++) {
    x.insert(x.end(), {1.99 * i, 0.0, 0.0});
    v.insert(v.end(), {0.0, 0.01 * (i % 7), 0.0});
    omega.insert(omega.end(), {0.0, 0.0, 0.02 * (i % 5)});
    key.push_back(i);
    tag.push_back(i + 1);
    if (i) lists.add(i, i - 1, 1.0);
  }
  ContactPipeline pipeline;
  pipeline.set_laws(single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, false));
  HistoryStore store;
  store.resize(n);
  const auto start = [&] {
    pipeline.set_pairs({n, key, tag, nullptr}, lists.view());
    pipeline.start_pairs(store);
    store.number(pipeline.particle_order());
  };
  const auto forces = [&](bool advance) {
    std::vector<double> f(3 * n, 0.0), torque(3 * n, 0.0);
    pipeline.compute({x.data(), v.data(), omega.data(), radius.data(), mass.data(), nullptr,
                      f.data(), torque.data()},
                     {dt, advance});
    f.insert(f.end(), torque.begin(), torque.end());
    return f;
  };
  start();
  const std::vector<double> first = forces(true), before = forces(true);
  ASSERT_TRUE(first != before);    // there is a history
  const double used = pipeline.memory_usage();
  ASSERT_GT(used, release_threshold);
  pipeline.keep_history(store, {false, false}, false);
  pipeline.release();
  EXPECT_LT(pipeline.memory_usage(), 0.6 * used);    // the states of the particles stay
  start();
  EXPECT_TRUE(forces(false) == before);
}

INSTANTIATE_TEST_SUITE_P(AllScenes, Pipeline, testing::ValuesIn(scenes()), [](const auto &info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

}    // namespace
