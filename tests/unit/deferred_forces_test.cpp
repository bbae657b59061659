// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/deferred_forces.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

using namespace Talus;

namespace {

constexpr int particles = 40;

Record random_record(RandomSource &random)
{
  Record r;
  for (double &c : r.c) c = random.uniform(-1.0, 1.0);
  return r;
}

bool same(const AlignedVector<Record> &a, const AlignedVector<Record> &b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Record &x, const Record &y) {
    return std::equal(std::begin(x.c), std::end(x.c), std::begin(y.c));
  });
}

void add(Record &sum, const Record &one)
{
  for (int d = 0; d < 4; d++) sum.c[d] += one.c[d];
}

/// What a contact adds to one of its slots.
struct OneNote {
  PairOfSlots pair;
  int slot;
  Record force, moment, couple;
};

/// Of random pairs in canonical order, one or both ends of each.
std::vector<OneNote> random_notes(RandomSource &random)
{
  std::vector<OneNote> notes;
  for (int second = 1; second < particles; second++)
    for (int first = 0; first < second; first++)
      for (const int slot : {first, second})
        if (random.chance(0.3))
          notes.push_back({{first, second},
                           slot,
                           random_record(random),
                           random_record(random),
                           random_record(random)});
  return notes;
}

struct Sums {
  ParticleRecords records;

  Sums(bool spins, bool couples, RandomSource &random)
  {
    records.resize(particles, spins, couples);
    for (Record &one : records.load) one = random_record(random);
    for (Record &one : records.couple) one = random_record(random);
  }

  /// A slow twin of what is tested.
  void add_slowly(const OneNote &note)
  {
    const std::size_t first = records.stride * note.slot;
    add(records.load[first], note.force);
    if (records.stride == 2) add(records.load[first + 1], note.moment);
    if (!records.couple.empty()) add(records.couple[note.slot], note.couple);
  }
};

void note(DeferredForces &deferred, const OneNote &its)
{
  deferred.note(its.pair, its.slot, {load4(its.force), load4(its.moment), load4(its.couple)});
}

class DeferredForcesOf : public testing::TestWithParam<std::pair<bool, bool>> {
 protected:
  RandomSource random{1};
  Sums sums{GetParam().first, GetParam().second, random};
  Sums twin = sums;
};

/// Of each particle: what a loop over the notes in their order makes of it, bit for bit, in as many
/// pieces as one likes, and if ranges take theirs one after the other.
TEST_P(DeferredForcesOf, AreAddedInTheirOrder)
{
  DeferredForces deferred;    // used again and again
  for (int step = 0; step < 3; step++) {
    const std::vector<OneNote> notes = random_notes(random);
    deferred.make_room(notes.size() + 5, sums.records);
    deferred.clear();
    EXPECT_EQ(deferred.size(), 0U);
    for (const OneNote &one : notes) note(deferred, one);
    EXPECT_EQ(deferred.size(), notes.size());
    streams_are_done();
    for (const OneNote &one : notes) twin.add_slowly(one);
    for (const SlotRange range : {SlotRange{0, 7}, {7, 7}, {7, particles}}) {
      std::size_t added = 0;
      for (const PairOfSlots limit :
           {PairOfSlots{0, 0}, {3, 9}, {3, 9}, {0, 30}, after_all_pairs}) {
        added = deferred.add_before(limit, added, range, sums.records);
        const auto before = [limit](const OneNote &one) { return one.pair < limit; };
        EXPECT_EQ(added, std::count_if(notes.begin(), notes.end(), before));
      }
    }
    ASSERT_TRUE(same(sums.records.load, twin.records.load));
    ASSERT_TRUE(same(sums.records.couple, twin.records.couple));
    EXPECT_GT(deferred.memory_usage(), notes.size() * sums.records.stride * sizeof(Record));
  }
}

/// Notes of two phases are added as if they had been made in one.
TEST_P(DeferredForcesOf, OfTwoPhasesAreMergedInCanonicalOrder)
{
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    const std::vector<OneNote> notes = random_notes(random);
    std::set<std::pair<int, int>> late_pairs;
    for (const OneNote &one : notes)
      if (random.chance(share)) late_pairs.insert({one.pair.first, one.pair.second});
    DeferredForces early, late;
    for (DeferredForces *deferred : {&early, &late})
      deferred->make_room(notes.size(), sums.records);
    for (const OneNote &one : notes)
      note(late_pairs.count({one.pair.first, one.pair.second}) ? late : early, one);
    EXPECT_EQ(early.size() + late.size(), notes.size());
    streams_are_done();
    constexpr SlotRange some{10, 25};
    for (const OneNote &one : notes)
      if (some.holds(one.slot)) twin.add_slowly(one);    // nobody outside of the range is touched
    DeferredForces::add_both(early, late, some, sums.records);
    ASSERT_TRUE(same(sums.records.load, twin.records.load)) << share;
    ASSERT_TRUE(same(sums.records.couple, twin.records.couple)) << share;
  }
}

/// Negative control: the order shows.
TEST_P(DeferredForcesOf, AnotherOrderGivesOtherBits)
{
  std::vector<OneNote> notes = random_notes(random);
  for (const OneNote &one : notes) sums.add_slowly(one);
  std::reverse(notes.begin(), notes.end());
  for (const OneNote &one : notes) twin.add_slowly(one);
  EXPECT_FALSE(same(sums.records.load, twin.records.load));
}

INSTANTIATE_TEST_SUITE_P(SpinsAndCouples, DeferredForcesOf,
                         testing::Values(std::pair(false, false), std::pair(true, false),
                                         std::pair(true, true)));

}    // namespace
