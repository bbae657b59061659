// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories over random rebuilds on several ranks, against a map of what was written last: with
// images across periodic borders, particles that migrate, wrap, are deleted, added and renumbered,
// and restart files in between.

#include "history_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

using namespace Talus;
using slow::Rank, slow::Settings, slow::World;

namespace {

class Rebuilds : public testing::TestWithParam<Settings> {
 protected:
  static constexpr int start = 60, popular = 5;    // the latter has more than eight partners
  RandomSource random{23};
  World world;
  std::vector<Rank> ranks;
  std::int64_t next_tag = 1;

  Rebuilds()
  {
    for (int r = 0; r < GetParam().ranks; r++) ranks.emplace_back(r, GetParam());
    for (int i = 0; i < start; i++) add_particle();
  }

  void add_particle()
  {
    world.particles.push_back({3 * next_tag++, static_cast<std::uint64_t>(random.below(20)),
                               random.below(GetParam().ranks), true});
  }

  /// Contacts go on, also if they were over a border and are not any more; some end, some begin.
  void choose_pairs()
  {
    std::map<std::pair<int, int>, World::Pair> next;
    const int n = static_cast<int>(world.particles.size());
    for (int i = 0; i < n; i++)
      for (int j = i + 1; j < n; j++) {
        if (!world.particles[i].exists || !world.particles[j].exists) continue;
        const bool had_history = world.histories.count({i, j});
        const double chance = i == popular || j == popular ? 0.8 : 0.06;
        if (!random.chance(had_history ? 0.9 : chance)) continue;
        const World::Pair before = world.pairs[{i, j}];
        const bool turned = random.chance(0.3);
        next[{i, j}] = {random.chance(had_history ? 0.9 : 0.5),
                        GetParam().periodic && before.across != turned};
      }
    world.pairs = next;
  }

  /// Every pair has the history that its contact in the last lists had, the others begin at zero.
  void expect_histories()
  {
    int found = 0;
    for (Rank &rank : ranks)
      rank.for_each_pair([&](ContactHistory &live, std::int64_t n, int a, int b) {
        const int i = rank.particle[a], j = rank.particle[b];
        const auto known = world.histories.find(std::minmax(i, j));
        const bool expected = known != world.histories.end();
        ASSERT_EQ(live.touches(n), expected) << i << " " << j;
        if (!expected) return;
        const HistoryValues &as_lower = known->second;
        ASSERT_EQ(live.values(n), i < j ? as_lower : mirrored(as_lower)) << i << " " << j;
        found++;
      });
    EXPECT_GT(found, world.histories.empty() ? -1 : 10);
  }

  /// A step: contacts get new histories. The side that does not decide is off by rounding.
  void step()
  {
    world.histories.clear();
    for (const auto &[ij, pair] : world.pairs) {
      if (!pair.touches) continue;
      HistoryValues &h = world.histories[ij];
      for (int k = 0; k < 4 * GetParam().records; k++) h[k] = random.uniform(-1.0, 1.0);
    }
    for (Rank &rank : ranks)
      rank.for_each_pair([&](ContactHistory &live, std::int64_t n, int a, int b) {
        const int i = rank.particle[a], j = rank.particle[b];
        const World::Pair &pair = world.pairs.at(std::minmax(i, j));
        set_touching(live, n, pair.touches);
        if (!pair.touches) return;
        HistoryValues h = world.histories.at(std::minmax(i, j));
        if (pair.across && !rank.is_owned(a))
          for (double &value : h) value = std::nextafter(value, 2.0);
        live.set_values(n, i < j ? h : mirrored(h));
      });
  }

  static void set_touching(ContactHistory &live, std::int64_t pair, bool touches)
  {
    unsigned bits = 0;
    for (std::int64_t k = 0; k < 8; k++) {
      const std::int64_t of_block = pair / 8 * 8 + k;
      const bool is_on = of_block == pair ? touches : live.touches(of_block);
      bits |= static_cast<unsigned>(is_on) << k;
    }
    live.set_touching(pair / 8, bits);
  }

  void agree()
  {
    for (Rank &from : ranks)
      for (const auto &[to, message] : from.store.outgoing()) {
        ASSERT_NE(to, from.me);
        ASSERT_TRUE(GetParam().periodic);
        ranks[to].store.receive(message);
      }
  }

  /// Particles with what they carry along: as pack() writes it, or as restart files do.
  Rank::Luggage luggage(bool by_restart_file)
  {
    Rank::Luggage all;
    for (Rank &rank : ranks)
      for (int a = 0; a < rank.owned; a++) {
        std::vector<double> &buffer = all[rank.particle[a]];
        constexpr int header = HistoryStore::size_origin;
        buffer.resize(header + rank.store.list_size(a));
        EXPECT_LE(rank.store.list_size(a), rank.store.largest_list(rank.owned));
        const int size = by_restart_file ? header + rank.store.pack_list(a, &buffer[header])
                                         : rank.store.pack(a, buffer.data());
        EXPECT_LE(size, static_cast<int>(buffer.size()));
        buffer.resize(size);
        if (by_restart_file)
          HistoryStore::write({rank.store.origin(a).name, -1, -1}, buffer.data());
      }
    return all;
  }

  void change_particles()
  {
    for (std::size_t i = 0; i < world.particles.size(); i++) {
      World::Particle &p = world.particles[i];
      if (random.chance(0.2)) p.owner = random.below(GetParam().ranks);
      if (random.chance(0.2)) p.key = random.below(20);
      if (random.chance(0.02) && static_cast<int>(i) != popular) remove(static_cast<int>(i));
    }
    while (random.chance(0.6)) add_particle();
  }

  void remove(int i)
  {
    world.particles[i].exists = false;
    for (auto h = world.histories.begin(); h != world.histories.end();)
      h = h->first.first == i || h->first.second == i ? world.histories.erase(h) : std::next(h);
  }

  void renumber()
  {
    std::vector<std::int64_t> tags;
    for (const World::Particle &p : world.particles) tags.push_back(p.tag);
    random.shuffle(tags);
    for (std::size_t i = 0; i < tags.size(); i++) world.particles[i].tag = tags[i];
  }
};

TEST_P(Rebuilds, KeepTheHistoryOfEveryContact)
{
  Rank::Luggage all;
  for (int round = 0; round < 25; round++) {
    choose_pairs();
    // contacts whose pair is gone are dropped
    for (auto h = world.histories.begin(); h != world.histories.end();)
      h = world.pairs.count(h->first) ? std::next(h) : world.histories.erase(h);
    for (Rank &rank : ranks) rank.rebuild(world, all, random);
    ASSERT_NO_FATAL_FAILURE(expect_histories()) << "round " << round;
    step();
    const bool by_restart_file = round % 5 == 4;
    for (Rank &rank : ranks) rank.put_aside(true, by_restart_file);
    ASSERT_NO_FATAL_FAILURE(agree());
    all = luggage(by_restart_file);
    if (by_restart_file)
      for (Rank &rank : ranks) rank = Rank(rank.me, GetParam());    // another process
    change_particles();
    if (round % 7 == 6) renumber();
  }
}

/// Those that pass through another rank on their way bring everything with them, and those that
/// come back find theirs.
TEST_P(Rebuilds, ParticlesPassThroughOtherRanks)
{
  choose_pairs();
  for (Rank &rank : ranks) rank.rebuild(world, {}, random);
  step();
  for (Rank &rank : ranks) rank.put_aside(true, false);
  agree();
  Rank::Luggage all = luggage(false), later;
  HistoryStore between(77);
  between.keep(GetParam().records);
  between.resize(1);
  for (const auto &[i, buffer] : all) {
    ASSERT_EQ(between.unpack(0, buffer.data()), static_cast<int>(buffer.size()));
    ASSERT_EQ(between.list_size(0) + HistoryStore::size_origin, static_cast<int>(buffer.size()));
    later[i].resize(buffer.size());
    ASSERT_EQ(between.pack(0, later[i].data()), static_cast<int>(buffer.size()));
  }
  change_particles();
  choose_pairs();
  for (auto h = world.histories.begin(); h != world.histories.end();)
    h = world.pairs.count(h->first) ? std::next(h) : world.histories.erase(h);
  for (Rank &rank : ranks) rank.rebuild(world, later, random);
  expect_histories();
}

// A rank alone, from which nobody leaves: slots and names of images are enough.
TEST_P(Rebuilds, NothingIsPackedIfNobodyMayLeave)
{
  if (GetParam().ranks > 1) return;
  choose_pairs();
  ranks[0].rebuild(world, {}, random);
  step();
  ranks[0].put_aside(false, false);
  const Rank::Luggage all = luggage(false);
  for (const auto &[i, buffer] : all) ASSERT_EQ(buffer.size(), HistoryStore::size_origin + 1U) << i;
  ranks[0].rebuild(world, all, random);
  expect_histories();
}

TEST_P(Rebuilds, AContactThatItsFirstSideDoesNotSeeIsNotKept)
{
  if (!GetParam().periodic) return;
  choose_pairs();
  for (Rank &rank : ranks) rank.rebuild(world, {}, random);
  step();
  int forgotten = 0;
  for (Rank &rank : ranks)
    rank.for_each_pair([&](ContactHistory &live, std::int64_t n, int a, int b) {
      if (!rank.is_owned(a) || rank.is_owned(b) || !live.touches(n)) return;
      set_touching(live, n, false);
      forgotten += world.histories.erase(std::minmax(rank.particle[a], rank.particle[b]));
    });
  EXPECT_GT(forgotten, 10);
  for (Rank &rank : ranks) rank.put_aside(true, false);
  agree();
  const Rank::Luggage all = luggage(false);
  for (Rank &rank : ranks) rank.rebuild(world, all, random);
  expect_histories();
}

// What a snapshot does: also the sides that do not decide have the bits that they had, and from there particles
// go to other ranks as they would have gone then.
TEST_P(Rebuilds, AreTakenBackAsEachSideHadThem)
{
  choose_pairs();
  for (Rank &rank : ranks) rank.rebuild(world, {}, random);
  step();
  for (Rank &rank : ranks) rank.put_aside(true, true);
  agree();
  std::vector<HistoryStore> saved;
  std::vector<std::vector<HistoryValues>> then;
  const auto all_of = [](Rank &rank) {
    std::vector<HistoryValues> all;
    rank.for_each_pair([&all](ContactHistory &live, std::int64_t n, int, int) {
      all.push_back(live.touches(n) ? live.values(n) : HistoryValues{});
    });
    return all;
  };
  for (Rank &rank : ranks) {
    saved.push_back(rank.store);
    then.push_back(all_of(rank));
  }
  const auto histories = world.histories;
  for (auto &[ij, pair] : world.pairs) pair.touches = random.chance(0.5);
  step();
  for (Rank &rank : ranks) rank.put_aside(true, true);
  for (std::size_t r = 0; r < ranks.size(); r++) {
    ASSERT_NE(all_of(ranks[r]), then[r]);
    ranks[r].take_back(saved[r]);
    ASSERT_EQ(all_of(ranks[r]), then[r]);
  }
  world.histories = histories;
  const Rank::Luggage all = luggage(false);
  for (Rank &rank : ranks) rank.rebuild(world, all, random);
  expect_histories();
}

INSTANTIATE_TEST_SUITE_P(
    Ranks, Rebuilds,
    testing::Values(Settings{1, 1, false, false, 1}, Settings{1, 1, false, true, 1},
                    Settings{1, 3, false, true, 2}, Settings{3, 1, false, false, 5},
                    Settings{3, 1, false, true, 1}, Settings{4, 2, false, true, 2},
                    Settings{2, 1, true, true, 1}, Settings{3, 2, true, false, 2},
                    Settings{3, 2, true, true, 3}),
    [](const auto &info) {
      const Settings &s = info.param;
      return std::to_string(s.ranks) + "_ranks_" + std::to_string(s.threads) + "_threads" +
             (s.two_phases ? "_two_phases" : "") + (s.periodic ? "_periodic" : "") + "_" +
             std::to_string(s.records) + "_records";
    });

TEST(NamedContacts, HoldTheLastHistoryOfEachPair)
{
  RandomSource random(5);
  NamedContacts contacts;
  contacts.keep(2);
  for (int round = 0; round < 3; round++) {
    std::map<std::pair<std::int64_t, std::int64_t>, HistoryValues> model;
    for (int n = 0; n < 3000; n++) {
      // consecutive names, and some that differ in high bits only
      const auto name = [&] {
        return random.below(60) + 1 +
               (random.chance(0.3) ? std::int64_t{random.below(50)} << 40 : 0);
      };
      const std::int64_t a = name(), b = name();
      if (a == b) continue;
      const HistoryValues seen = {{random.uniform(-1.0, 1.0), 2.0, 3.0, 1.0, 1.0 * n}};
      contacts.insert(a, b, seen);
      model[std::minmax(a, b)] = a < b ? seen : mirrored(seen);
    }
    ASSERT_EQ(contacts.size(), model.size());
    for (const auto &[names, expected] : model) {
      const FoundHistory one = contacts.find(names.first, names.second),
                         other = contacts.find(names.second, names.first);
      ASSERT_TRUE(one.known && other.known);
      ASSERT_EQ(one.seen_by_a(), expected);
      ASSERT_EQ(other.seen_by_a(), mirrored(expected));
    }
    for (int n = 0; n < 1000; n++) {
      const std::int64_t a = random.below(200) + 1, b = random.below(200) + 1;
      if (!model.count(std::minmax(a, b))) {
        ASSERT_FALSE(contacts.find(a, b).known);
      }
    }
    contacts.clear();
    EXPECT_TRUE(contacts.empty());
    EXPECT_FALSE(contacts.find(1, 2).known);
  }
}

// Of a restart file, or of a run with other laws: what both have is kept, the rest is zero.
TEST(HistoryStore, ReadsListsOfOtherLaws)
{
  for (const int written : {1, 2, 5})
    for (const int read : {1, 2, 5}) {
      HistoryStore store;
      store.keep(read);
      store.resize(2);
      const std::int64_t partner = 20;
      std::vector<double> values,
          list(ContactLists::size_head + ContactLists::size_name + 4 * written);
      for (int n = 0; n < 4 * written; n++) values.push_back(n + 1.0);
      ContactLists::Writer(list.data()).add({partner, 0, values.data(), 4 * written});
      store.set_name(0, 10);
      store.set_name(1, partner);
      ASSERT_EQ(store.unpack_list(0, list.data()), static_cast<int>(list.size()));
      slow::NeighborLists neighbors(2);
      neighbors.add(0, 1, 1.0);
      ParticleOrder order;
      order.arrange(2, {7, 5}, {10, 20});
      const WorkPartition work(order);
      PairList pairs;
      pairs.collect(order, work, PairRows(order, neighbors.view()), 0);
      store.open(order, 1);
      ContactHistory history;
      history.fetch(pairs, store);
      ASSERT_TRUE(history.touches(0));
      ASSERT_EQ(history.num_records(), read);
      HistoryValues expected{{-1.0, -2.0, -3.0}};    // 20 is the first now
      for (int n = 3; n < 4 * std::min(written, read); n++) expected[n] = n + 1.0;
      EXPECT_EQ(history.values(0), expected) << written << " " << read;
    }
}

}    // namespace
