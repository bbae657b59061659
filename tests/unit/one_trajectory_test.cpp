// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces and histories must have the same bits however the particles are numbered, distributed to
// ranks, and however often the pairs are rebuilt.

#include "packing.h"
#include "test_rank.h"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>

using namespace Talus;
using namespace slow;

namespace {

constexpr double dt = 1e-3;
constexpr double skin = 1.5;

bool same_bits(const std::vector<Vector> &a, const std::vector<Vector> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vector)) == 0;
}

/// Several ranks that share a packing.
class Machine {
 public:
  Machine(int num_ranks, const LawTable &laws, std::uint64_t seed) : random(seed)
  {
    for (int r = 0; r < num_ranks; r++) ranks.emplace_back(laws, r);
  }

  void divide(int threads, bool two_phases)
  {
    for (TestRank &rank : ranks) {
      rank.divide(threads, two_phases);
      rank.reports = false;    // so that the parts run at the same time
    }
  }

  /// Distributes the particles again, at random, in slabs or so that most of them stay, and
  /// rebuilds all pairs. With `keep`, histories of those that stay are kept as they stand.
  enum Way { AT_RANDOM, SLABS, MOST_STAY };
  void rebuild(const Packing &p, Way way, bool keep = false)
  {
    const int n = static_cast<int>(ranks.size());
    std::vector<int> goes_to(p.size());
    for (int i = 0; i < p.size(); i++) {
      const bool stays = way == MOST_STAY && !rank_of.empty() && random.chance(0.8);
      goes_to[i] = stays ? rank_of[i] : random.below(n);
      if (way == SLABS) goes_to[i] = p.x[i][0] < 0.0 ? 0 : n - 1;
    }
    Luggage luggage;
    for (int r = 0; r < n; r++)
      if (keep)
        ranks[r].depart_and_keep(luggage, [&](int i) { return goes_to[i] == r; });
      else
        ranks[r].depart(luggage);
    rank_of = goes_to;
    for (int r = 0; r < n; r++)
      ranks[r].rebuild(p, owned_by(r), candidates(p, skin, true), luggage, random);
  }

  void compute(const Packing &p, bool advance)
  {
    force.assign(p.size(), Vector{});
    torque.assign(p.size(), Vector{});
    contacts = 0.0;
    for (TestRank &rank : ranks) {
      rank.compute(p, dt, advance);
      contacts += ContactSurvey(rank.pipeline).count_contacts();
      for (int a = 0; a < static_cast<int>(rank.particle.size()); a++) {
        const int i = rank.particle[a];
        if (a < rank.owned) {
          force[i] = rank.force[i];
          torque[i] = rank.torque[i];
        } else {
          EXPECT_EQ(rank.force[i], Vector{});    // ghosts get nothing
          EXPECT_EQ(rank.torque[i], Vector{});
        }
      }
    }
  }

  /// Histories of all contacts as their particles see them, from the ranks that own these.
  std::vector<Vector> histories(const BruteForce &reference) const
  {
    std::vector<Vector> all;
    for (const auto &contact : reference.contacts)
      for (const auto &[i, j] :
           {contact.first, std::pair(contact.first.second, contact.first.first)})
        for (const TestRank &rank : ranks)
          for (int a = 0; a < rank.owned; a++)
            if (rank.particle[a] == i) {
              const Record h = rank.history_of(i, j);
              all.push_back({h.c[0], h.c[1], h.c[2]});
            }
    return all;
  }

  std::vector<Vector> force, torque;
  double contacts = 0.0;

 private:
  std::vector<int> owned_by(int rank) const
  {
    std::vector<int> found;
    for (int i = 0; i < static_cast<int>(rank_of.size()); i++)
      if (rank_of[i] == rank) found.push_back(i);
    return found;
  }

  std::deque<TestRank> ranks;
  std::vector<int> rank_of;    // by particle
  RandomSource random;
};

void expect_same(const Machine &a, const Machine &b)
{
  EXPECT_TRUE(same_bits(a.force, b.force)) << "forces differ";
  EXPECT_TRUE(same_bits(a.torque, b.torque)) << "torques differ";
  EXPECT_EQ(a.contacts, b.contacts);
}

/// How the ranks of a machine divide their work, and whether they keep histories over rebuilds.
struct Division {
  int threads = 1;
  bool two_phases = false;
  bool keep = false;
};

/// Runs both machines over the same motion. Keys are refreshed every fourth step; machine b is
/// rebuilt then and at the steps that are multiples of `interval`.
void run_and_compare(const LawTable &laws, int ranks_a, int ranks_b, int interval,
                     Division division = {})
{
  RandomSource random(12);
  Packing p = random_packing(200, random);
  Machine a(ranks_a, laws, 1), b(ranks_b, laws, 2);
  b.divide(division.threads, division.two_phases);
  BruteForce reference;
  for (int step = 0; step < 12; step++) {
    const bool refresh = step % 4 == 0;
    if (refresh) {
      p.refresh_keys(0.3 + 0.1 * step);
      a.rebuild(p, Machine::AT_RANDOM);
    }
    constexpr Machine::Way ways[] = {Machine::SLABS, Machine::AT_RANDOM, Machine::MOST_STAY};
    // now and then by lists in between, as after a restart file
    if (refresh || step % interval == 0)
      b.rebuild(p, ways[step % 3], division.keep && step % 7 != 6);
    a.compute(p, step > 0);
    b.compute(p, step > 0);
    ASSERT_GT(a.contacts, 300.0);
    ASSERT_NO_FATAL_FAILURE(expect_same(a, b)) << "step " << step;
    reference.compute(p, laws, dt, step > 0, true);
    ASSERT_TRUE(same_bits(a.histories(reference), b.histories(reference))) << "step " << step;
    p.move(10.0 * dt, 0.2, random);
  }
}

class OneTrajectory : public testing::TestWithParam<int> {
 protected:
  LawTable laws() const
  {
    if (GetParam() == 0) return mixed_laws();
    const bool spread = GetParam() == 2;
    return single_law({named::Normal::HERTZ, named::Tangential::MULTISTEP}, spread);
  }
};

TEST_P(OneTrajectory, DoesNotDependOnTheNumbering)
{
  run_and_compare(laws(), 1, 1, 4);
}
TEST_P(OneTrajectory, DoesNotDependOnRebuilds)
{
  run_and_compare(laws(), 1, 1, 1);
}
TEST_P(OneTrajectory, TwoRanks)
{
  run_and_compare(laws(), 1, 2, 4);
}
TEST_P(OneTrajectory, ThreeRanksOneOfThemEmptyAtTimes)
{
  run_and_compare(laws(), 1, 3, 2);
}
TEST_P(OneTrajectory, TwoRanksAgainstFive)
{
  run_and_compare(laws(), 2, 5, 3);
}

TEST_P(OneTrajectory, Threads)
{
  for (int threads : {2, 3, 8}) run_and_compare(laws(), 1, 1, 4, {threads, false});
}
TEST_P(OneTrajectory, MoreThreadsThanParticles)
{
  run_and_compare(laws(), 1, 1, 4, {300, false});
}
TEST_P(OneTrajectory, GhostsThatArriveLate)
{
  for (int ranks : {1, 2, 5}) run_and_compare(laws(), 1, ranks, 3, {1, true});
}
TEST_P(OneTrajectory, RanksAndThreadsAndLateGhosts)
{
  run_and_compare(laws(), 1, 3, 3, {3, true});
  run_and_compare(laws(), 1, 3, 2, {2, false});
}

TEST_P(OneTrajectory, HistoriesThatAreKept)
{
  for (const int interval : {1, 2}) {
    for (const int ranks : {1, 2, 5}) run_and_compare(laws(), 1, ranks, interval, {1, false, true});
    run_and_compare(laws(), 1, 1, interval, {3, false, true});
    run_and_compare(laws(), 1, 3, interval, {1, true, true});
    run_and_compare(laws(), 1, 2, interval, {3, true, true});
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, OneTrajectory, testing::Values(0, 1, 2));

// Negative control: another order gives other bits, so the tests above can fail.
TEST(OneTrajectoryControl, AnotherOrderGivesOtherBits)
{
  RandomSource random(13);
  Packing p = random_packing(200, random);
  std::fill(p.key.begin(), p.key.end(), 0);
  const LawTable laws = mixed_laws();
  Machine a(1, laws, 1), b(1, laws, 2), c(1, laws, 3);
  a.rebuild(p, Machine::AT_RANDOM);
  a.compute(p, true);
  b.rebuild(p, Machine::AT_RANDOM);
  b.compute(p, true);
  EXPECT_TRUE(same_bits(a.force, b.force));
  for (std::int64_t &tag : p.tag) tag = p.size() + 1 - tag;
  c.rebuild(p, Machine::AT_RANDOM);
  c.compute(p, true);
  EXPECT_FALSE(same_bits(a.force, c.force));
  EXPECT_FALSE(same_bits(a.torque, c.torque));
}

}    // namespace
