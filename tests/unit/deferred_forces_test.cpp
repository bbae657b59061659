// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What chunks add at once and what they defer must together have the bits of a slow loop over all pairs in canonical
// order.

#include "contact/deferred_forces.h"
#include "random_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>

using namespace Talus;
using namespace slow;

namespace {

Record random_record(RandomSource &random)
{
  Record r{};    // the fourth number of a force has a meaning of its own
  for (int d = 0; d < 3; d++) r.c[d] = random.uniform(-1.0, 1.0);
  return r;
}

bool same(const Record &a, const Record &b)
{
  return std::equal(std::begin(a.c), std::end(a.c), std::begin(b.c));
}

struct OneContact {
  Record force, torque_per_radius, twisting_torque;
  double heat_flow;
};

/// Of each pair that touches, by slots.
using Contacts = BySlots<OneContact>;

Contacts random_contacts(const Pairs &pairs, double chance, RandomSource &random)
{
  Contacts contacts;
  for (const auto &one : pairs.by_slots)
    if (random.chance(chance))
      contacts[one.first] = {random_record(random), random_record(random), random_record(random),
                             random.uniform(-1.0, 1.0)};
  return contacts;
}

void add(Record &sum, const Record &one, double sign)
{
  for (int d = 0; d < 4; d++) sum.c[d] += sign * one.c[d];
}

void add_contact(ParticleRecords &sums, const OneContact &contact, int slot, bool is_first)
{
  const double sign = is_first ? 1.0 : -1.0;
  Record *load = &sums.load[sums.stride * slot];
  add(load[0], contact.force, sign);
  if (sums.stride == 2) add(load[1], contact.torque_per_radius, 1.0);
  if (!sums.twisting_torque.empty()) add(sums.twisting_torque[slot], contact.twisting_torque, sign);
  if (!sums.heat_flow.empty()) sums.heat_flow[slot] += sign * contact.heat_flow;
}

struct Kind {
  int threads;
  bool two_phases, rotation, twisting_torques, heat;
};

ParticleRecords cleared(int particles, const Kind &kind)
{
  ParticleRecords sums;
  sums.resize(particles, kind.rotation, kind.twisting_torques, 0, false, kind.heat);
  sums.clear(0, particles);
  return sums;
}

ParticleRecords slow_sums(const Contacts &contacts, ParticleRecords sums)
{
  for (const auto &[slots, contact] : contacts) {
    add_contact(sums, contact, slots.first, true);
    add_contact(sums, contact, slots.second, false);
  }
  return sums;
}

class DeferredForcesOf : public testing::TestWithParam<Kind> {
 protected:
  /// What a chunk does, in the simplest way.
  void compute_chunk(int c, const Contacts &contacts, ParticleRecords &sums)
  {
    const PairList &list = divided.lists[c];
    std::size_t place = deferred.first_place(c);
    for (std::uint32_t n = 0; n < list.num_pairs(); n++) {
      const int first = list.first[n], second = list.second[n];
      const auto found = contacts.find({first, second});
      const bool touches = found != contacts.end();
      const OneContact one = touches ? found->second : OneContact{};
      const bool at_frontier = list.defers(first) || list.defers(second);
      if (touches && at_frontier)
        deferred.put(place, list.is_foreign(first),
                     {load4(one.force), load4(one.torque_per_radius), load4(one.twisting_torque),
                      one.heat_flow});
      place += at_frontier;
      if (!touches) continue;
      if (!list.is_late() && !list.is_foreign(first)) add_contact(sums, one, first, true);
      if (!list.is_late()) add_contact(sums, one, second, false);
    }
    EXPECT_EQ(place, deferred.first_place(c) + list.frontier().size());
  }

  RandomSource random{1};
  Divided divided{200, GetParam().threads, GetParam().two_phases, random};
  DeferredForces deferred;
};

TEST_P(DeferredForcesOf, MakeTheSumsOfALoopInCanonicalOrder)
{
  const Kind kind = GetParam();
  for (int rebuild = 0; rebuild < 2; rebuild++) {
    deferred.collect(divided.order, divided.work, kind.threads,
                     [this](int c) { return &divided.lists[c]; });
    deferred.make_room(cleared(1, kind));
    for (const double touching : {0.6, 0.1, 1.0, 0.5, 0.0}) {    // contacts begin and end
      const Contacts contacts = random_contacts(divided.pairs, touching, random);
      ParticleRecords sums = cleared(divided.order.size(), kind);
      const ParticleRecords expected = slow_sums(contacts, sums);
      deferred.begin_step();
      for (int c = divided.work.num_chunks() - 1; c >= 0; c--) compute_chunk(c, contacts, sums);
      streams_are_done();
      for (int t = 0; t < kind.threads; t++) deferred.add(t, sums);
      for (int s = 0; s < divided.order.size(); s++) {
        if (!divided.order.owns_slot(s)) continue;
        for (std::size_t k = sums.stride * s; k < sums.stride * (s + 1); k++)
          ASSERT_TRUE(same(sums.load[k], expected.load[k])) << s;
        if (kind.twisting_torques) {
          ASSERT_TRUE(same(sums.twisting_torque[s], expected.twisting_torque[s])) << s;
        }
        if (kind.heat) {
          ASSERT_EQ(sums.heat_flow[s], expected.heat_flow[s]) << s;
        }
      }
    }
    EXPECT_EQ(deferred.memory_usage() > 0.0, kind.threads > 1 || kind.two_phases);
    deferred.release();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, DeferredForcesOf,
    testing::Values(Kind{1, false, true, false, false}, Kind{3, false, true, false, true},
                    Kind{1, true, true, true, true}, Kind{3, true, true, true, false},
                    Kind{3, true, false, false, true}, Kind{8, true, true, false, false}));

/// Negative control: another order gives other bits.
TEST(DeferredForces, OrderOfSumsShows)
{
  RandomSource random(2);
  const Divided divided(200, 1, false, random);
  const Contacts contacts = random_contacts(divided.pairs, 1.0, random);
  const ParticleRecords zero = cleared(divided.order.size(), {1, false, true, false, false});
  const ParticleRecords sums = slow_sums(contacts, zero);
  ParticleRecords others = zero;
  for (auto it = contacts.rbegin(); it != contacts.rend(); ++it) {
    add_contact(others, it->second, it->first.first, true);
    add_contact(others, it->second, it->first.second, false);
  }
  EXPECT_FALSE(std::equal(sums.load.begin(), sums.load.end(), others.load.begin(), same));
}

}    // namespace
