// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/outgoing_forces.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <vector>

using namespace Talus;

namespace {

constexpr int particles = 40, contacts = 300;

Record random_record(RandomSource &random)
{
  Record r;
  for (double &c : r.c) c = random.uniform(-1.0, 1.0);
  return r;
}

bool same(const Record &a, const Record &b)
{
  return std::equal(std::begin(a.c), std::end(a.c), std::begin(b.c));
}

void add(Record &sum, const Record &one)
{
  for (int d = 0; d < 4; d++) sum.c[d] += one.c[d];
}

/// Of each particle, in all scenes: what a loop over the contacts in their order makes of it, bit
/// for bit, if ranges take theirs one after the other.
TEST(OutgoingForces, AreAddedInTheOrderOfTheContacts)
{
  RandomSource random(1);
  OutgoingForces outgoing;    // used again and again
  for (const bool spins : {true, false, true})
    for (const bool couples : {false, true}) {
      const std::size_t stride = spins ? 2 : 1;
      ParticleRecords records;
      records.resize(particles, particles, spins, couples);
      for (Record &one : records.load) one = random_record(random);
      for (Record &one : records.couple) one = random_record(random);
      auto load = records.load, couple = records.couple;

      outgoing.make_room(contacts, records);
      for (int step = 0; step < 2; step++) {
        outgoing.clear();
        EXPECT_EQ(outgoing.size(), 0U);
        for (int c = 0; c < contacts - 50 * step; c++) {
          const int slot = random.below(particles);
          const Record force = random_record(random), moment = random_record(random),
                       its_couple = random_record(random);
          outgoing.note(slot, force, moment);
          add(load[stride * slot], force);
          if (spins) add(load[stride * slot + 1], moment);
          if (!couples) continue;
          outgoing.note_couple(load4(its_couple));
          add(couple[slot], its_couple);
        }
        EXPECT_EQ(outgoing.size(), static_cast<std::size_t>(contacts - 50 * step));
        streams_are_done();
        for (const ParticleOrder::Range range :
             {ParticleOrder::Range{0, 7}, {7, 7}, {7, particles}})
          outgoing.add_to(records, range);
      }
      for (std::size_t n = 0; n < load.size(); n++) ASSERT_TRUE(same(records.load[n], load[n]));
      for (std::size_t n = 0; n < couple.size(); n++)
        ASSERT_TRUE(same(records.couple[n], couple[n]));
      EXPECT_GT(outgoing.memory_usage(), contacts * stride * sizeof(Record));
    }
}

TEST(OutgoingForces, TouchNobodyOutsideOfTheRange)
{
  RandomSource random(2);
  ParticleRecords records;
  records.resize(particles, particles, true, false);
  for (Record &one : records.load) one = Record{};
  OutgoingForces outgoing;
  outgoing.make_room(particles, records);
  outgoing.clear();
  for (int s = 0; s < particles; s++) outgoing.note(s, {{1, 1, 1, 0}}, {{1, 1, 1, 0}});
  streams_are_done();
  outgoing.add_to(records, {10, 20});
  for (int s = 0; s < particles; s++)
    EXPECT_EQ(records.load[2 * s].c[0], s >= 10 && s < 20 ? 1.0 : 0.0);
}

}    // namespace
