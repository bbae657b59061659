// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories that stay where they are over a rebuild: found by the slots of two particles, packed for those that leave.

#include "history/contact_history.h"
#include "neighbor_lists.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

using namespace Talus;

namespace {

constexpr int owned = 60, ghosts = 30, total = owned + ghosts;
constexpr int popular = 7;    // has more partners than are compared at once
using Values = std::array<double, 8>;

/// A rank whose pairs have histories: those of `touching`, by host's index as its first particle (key) sees it.
struct Rank {
  ParticleOrder order;
  WorkPartition work;
  std::vector<std::int64_t> tag;
  std::map<std::pair<int, int>, Values> touching;
  std::vector<std::pair<int, int>> apart;
  std::vector<PairList> pairs;
  std::vector<ContactHistory> histories;
  PartnerLists lists;

  Rank(int threads, bool two_phases, bool with_impacts, RandomSource &random)
  {
    std::vector<std::uint64_t> key;
    for (int a = 0; a < total; a++) {
      key.push_back(random.below(20));
      tag.push_back(1000 - 3 * a);
    }
    slow::NeighborLists neighbors(owned);
    for (int a = 0; a < owned; a++)
      for (int b = a + 1; b < total; b++) {
        if (!random.chance(a == popular || b == popular ? 0.8 : 0.1)) continue;
        neighbors.add(a, b, 1.0);
        if (random.chance(0.5))
          apart.emplace_back(a, b);
        else
          for (double &value : touching[{a, b}]) value = random.uniform(-1.0, 1.0);
      }
    order.arrange(owned, key, tag);
    work = WorkPartition(order, PairRows(order, neighbors.view(), threads), threads, two_phases);

    lists.set_values(with_impacts ? 8 : 4);
    lists.resize(owned);
    lists.begin();
    for (const auto &contact : touching)
      for_each_end(contact.first, [&](int atom, int) { lists.count(atom); });
    lists.layout();
    for (const auto &[pair, values] : touching)
      for_each_end(pair, [&, its = values](int atom, int partner) {
        const Values seen = seen_by(atom == std::min(atom, partner), its);
        std::copy_n(seen.begin(), lists.num_values(), lists.append(atom, tag[partner]));
      });
    pairs.resize(work.num_chunks());
    histories.resize(work.num_chunks());
    for (int p = 0; p < work.num_chunks(); p++) {
      pairs[p].collect(order, work, PairRows(order, neighbors.view()), p);
      histories[p].fetch(pairs[p], {lists, tag, KeptContacts(), {}}, {});
    }
  }

  template <class Visit> void for_each_end(std::pair<int, int> pair, Visit visit) const
  {
    if (pair.first < owned) visit(pair.first, pair.second);
    if (pair.second < owned) visit(pair.second, pair.first);
  }

  static Values seen_by(bool first, Values values)
  {
    if (!first)
      for (int d = 0; d < 3; d++) values[d] = -values[d];
    return values;
  }

  void keep(KeptContacts &kept, bool particles_may_leave)
  {
    kept.begin(order, work, particles_may_leave);
    for (int p = 0; p < work.num_chunks(); p++) histories[p].keep(pairs[p], kept.part(p));
    kept.finish(1);
  }

  int slot(int atom) const { return order.slot_of_atom[atom]; }
};

struct Division {
  int threads;
  bool two_phases, with_impacts;
};

class KeptContactsOf : public testing::TestWithParam<Division> {
 protected:
  KeptContactsOf() :
      rank(GetParam().threads, GetParam().two_phases, GetParam().with_impacts, random)
  {
  }
  RandomSource random{17};
  Rank rank;
  KeptContacts kept;
};

TEST_P(KeptContactsOf, AreFoundByTheSlotsOfTwoParticles)
{
  EXPECT_TRUE(kept.empty());
  for (int round = 0; round < 2; round++) {    // of memory that is used again
    rank.keep(kept, round == 0);
    EXPECT_FALSE(kept.empty());
    ASSERT_GT(rank.touching.size(), 150U);
    for (const auto &[pair, values] : rank.touching) {
      const int a = rank.slot(pair.first), b = rank.slot(pair.second);
      const int named_b = pair.second < owned ? b : KeptContacts::was_ghost(b);
      const Values expected = Rank::seen_by(a < b, values);
      for (const bool swapped : {false, true}) {
        const KeptContacts::Found found = swapped ? kept.find(named_b, a) : kept.find(a, named_b);
        ASSERT_TRUE(found.known) << pair.first << " " << pair.second;
        ASSERT_EQ(found.by_a, (a < b) != swapped);
        ASSERT_TRUE(std::equal(found.record->c, found.record->c + 4, expected.begin()));
        if (GetParam().with_impacts) {
          ASSERT_TRUE(std::equal(found.impact->c, found.impact->c + 4, expected.begin() + 4));
        }
      }
      ASSERT_FALSE(kept.find(a, KeptContacts::unknown).known);
      ASSERT_FALSE(kept.find(KeptContacts::unknown, named_b).known);
    }
    ASSERT_GT(rank.apart.size(), 150U);
    for (const auto &[i, j] : rank.apart) ASSERT_FALSE(kept.find(rank.slot(i), rank.slot(j)).known);
    const int g = KeptContacts::was_ghost(rank.slot(owned));
    EXPECT_FALSE(kept.find(g, KeptContacts::was_ghost(rank.slot(owned + 1))).known);
    for (int p = 0; p < kept.num_chunks(); p++) {    // rows that are not there
      const KeptContacts::Part &part = kept.part(p);
      const int rows = static_cast<int>(part.rows.size()) - 1;
      for (const int second : {part.first_row - 1, part.first_row + rows})
        EXPECT_EQ(part.row_begin(second), part.row_end(second));
    }
    kept.clear();
    EXPECT_TRUE(kept.empty());
    for (int p = 0; p < rank.work.num_chunks(); p++)
      rank.histories[p].fetch(rank.pairs[p], {rank.lists, rank.tag, KeptContacts(), {}}, {});
  }
}

TEST_P(KeptContactsOf, LeaveWithTheirParticles)
{
  rank.keep(kept, true);
  int most = 0;
  for (int a = 0; a < owned; a++) most = std::max(most, rank.lists.size(a));
  EXPECT_EQ(most, rank.lists.size(popular));
  EXPECT_GT(most, 24);
  EXPECT_EQ(kept.most_contacts(), most);
  PartnerLists arrived;
  arrived.set_values(rank.lists.num_values());
  arrived.resize(owned);
  std::vector<double> buffer(arrived.packed_size_of(most));
  for (int a = 0; a < owned; a++) {
    EXPECT_EQ(kept.slot_named(rank.tag[a]), KeptContacts::unknown);
    const int size = kept.pack(rank.slot(a), arrived.num_values(), buffer.data());
    EXPECT_EQ(size, rank.lists.packed_size(a));
    EXPECT_EQ(arrived.unpack(a, buffer.data()), size);
    EXPECT_EQ(kept.slot_named(rank.tag[a]), rank.slot(a));
  }
  for (const auto &contact : rank.touching)
    rank.for_each_end(contact.first, [&](int atom, int partner) {
      const double *values = arrived.find(atom, rank.tag[partner]);
      ASSERT_NE(values, nullptr);
      ASSERT_TRUE(std::equal(values, values + arrived.num_values(),
                             rank.lists.find(atom, rank.tag[partner])));
    });
  for (int g = owned; g < total; g++)
    EXPECT_EQ(kept.slot_named(rank.tag[g]), KeptContacts::was_ghost(rank.slot(g)));
  EXPECT_EQ(kept.slot_named(12345), KeptContacts::unknown);
}

// On a rank of its own a particle leaves only if it gets lost.
TEST_P(KeptContactsOf, NothingToPackIfNobodyMayLeave)
{
  rank.keep(kept, false);
  double buffer[1] = {7.0};
  EXPECT_EQ(kept.pack(rank.slot(popular), rank.lists.num_values(), buffer), 1);
  EXPECT_EQ(buffer[0], 0.0);
}

INSTANTIATE_TEST_SUITE_P(Divisions, KeptContactsOf,
                         testing::Values(Division{1, false, false}, Division{1, false, true},
                                         Division{3, false, true}, Division{1, true, false},
                                         Division{2, true, true}),
                         [](const auto &info) {
                           const Division &d = info.param;
                           return std::to_string(d.threads) +
                                  (d.two_phases ? "_two_phases" : "_one_phase") +
                                  (d.with_impacts ? "_onsets" : "");
                         });

}    // namespace
