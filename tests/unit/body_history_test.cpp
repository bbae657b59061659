// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of the candidates of a body, on their way with the particles; and which contact of the
// step before one of several continues.

#include "body/contact/body_history.h"
#include "histories_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif
#include <vector>

using namespace Talus;

namespace {

using V = Vector3<double>;
using Packed = std::vector<double>;

/// Names are bit patterns, which as numbers may be none.
bool same_bits(const Packed &a, const Packed &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

const std::vector<std::uint8_t> no_room;

/// How many records are kept of each contact, and whether there may be several contacts.
class BodyHistoryTest : public testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  int records() const { return std::get<0>(GetParam()); }
  bool several() const { return std::get<1>(GetParam()); }

  BodyHistoryTest()
  {
    history.keep(several());
    history.keep_records(records());
    memory.pairs().resize(20);
    history.rest_in(memory, name);
    follow({3, 17, 5, 11});
    for (int c = 0; c < 4; c++) set(c, 10.0 * (c + 1));
  }

  void follow(const std::vector<int> &candidates)
  {
    history.follow(candidates, std::vector<std::uint8_t>(several() ? candidates.size() : 0, 2));
  }

  /// A candidate touches: at one point, or at two whose histories differ by 100.
  void set(int candidate, double value)
  {
    if (several()) {
      SurfaceContact found[2] = {{V{0.0, 0.0, 1.0}, 0.1}, {V{1.0, 0.0, 0.0}, 0.1}};
      history.continue_contacts(candidate, found, 2);
    } else {
      history.set_touching(0, 1U << candidate, 1U << candidate);
    }
    for (int k = 0; k < (several() ? 2 : 1); k++) {
      const double first_value = value + 100.0 * k;
      const std::uint32_t slot = history.first_slot(candidate) + k;
      history.begin_step();
      history.set_values(slot, values(first_value));
    }
  }

  HistoryValues values(double first) const
  {
    HistoryValues all{};
    for (int n = 0; n < 4 * records(); n++) all[n] = first + n;
    return all;
  }

  Packed packed(int particle)
  {
    memory.put_aside();
    Packed values(memory.pairs().list_size(particle), 7.0);
    EXPECT_EQ(memory.pairs().pack_list(particle, values.data()), values.size());
    return values;
  }

  int unpack(int particle, const Packed &values)
  {
    return memory.pairs().unpack_list(particle, values.data());
  }

  Packed expected(double value) const
  {
    if (value == 0.0) return {0.0};
    const int count = several() ? 2 : 1;
    Packed all(ContactLists::size_head + count * (ContactLists::size_name + 3 + 4 * records()));
    ContactLists::Writer to(all.data());
    for (int k = 0; k < count; k++) {
      Packed each =
          several() ? (k ? Packed{1.0, 0.0, 0.0} : Packed{0.0, 0.0, 1.0}) : Packed(3, 0.0);
      const HistoryValues history = values(value + 100.0 * k);
      each.insert(each.end(), history.begin(), history.begin() + 4L * records());
      to.add({name, static_cast<std::uint64_t>(k), each.data(), static_cast<int>(each.size())});
    }
    return all;
  }

  static constexpr std::int64_t name = -7;
  ContactMemory memory;
  BodyHistory history;
};

TEST_P(BodyHistoryTest, ParticlesKnowTheirContacts)
{
  const double value[20] = {0, 0, 0, 10, 0, 30, 0, 0, 0, 0, 0, 40, 0, 0, 0, 0, 0, 20};
  for (int i = 0; i < 20; i++) {
    EXPECT_EQ(history_of(history, i)[0], value[i]);
    EXPECT_TRUE(same_bits(packed(i), expected(value[i]))) << i;
  }
}

TEST_P(BodyHistoryTest, FollowKeepsThoseThatStayAndForgetsTheOthers)
{
  follow({11, 4, 3});
  EXPECT_TRUE(same_bits(packed(11), expected(40.0)));
  EXPECT_TRUE(same_bits(packed(4), expected(0.0)));
  EXPECT_TRUE(same_bits(packed(3), expected(10.0)));
  EXPECT_TRUE(same_bits(packed(17), expected(0.0)));
  follow({});
  follow({3, 11});
  EXPECT_TRUE(same_bits(packed(3), expected(0.0)));
  if (!several()) {
    EXPECT_EQ(history.record(0).c[0], 0.0);
  }
}

// The last particle takes the place of one that leaves, and new ones come in behind.
TEST_P(BodyHistoryTest, MovesWithItsParticles)
{
  const Packed of_5 = packed(5), of_0 = packed(0);
  memory.pairs().copy(17, 5);
  memory.pairs().forget(17);
  memory.pairs().resize(40);
  EXPECT_EQ(unpack(30, of_5), of_5.size());
  EXPECT_EQ(unpack(31, of_0), of_0.size());
  EXPECT_EQ(unpack(11, of_0), of_0.size());    // replaces what was there
  const auto check = [this] {
    EXPECT_TRUE(same_bits(packed(5), expected(20.0)));
    EXPECT_TRUE(same_bits(packed(17), expected(0.0)));
    EXPECT_TRUE(same_bits(packed(30), expected(30.0)));
    EXPECT_TRUE(same_bits(packed(31), expected(0.0)));
    EXPECT_TRUE(same_bits(packed(11), expected(0.0)));
    EXPECT_TRUE(same_bits(packed(3), expected(10.0)));
  };
  check();
  follow({30, 31, 3, 5, 11});
  check();
}

// The sign of a zero is kept as well, or bits would depend on who owns a particle.
TEST_P(BodyHistoryTest, NegativeZerosTravel)
{
  Packed values = packed(3);
  const std::size_t each = ContactLists::size_name + 3 + 4 * records();
  for (std::size_t end = ContactLists::size_head + each; end <= values.size(); end += each)
    std::fill_n(values.begin() + (end - 4 * records()), 4 * records(), -0.0);
  EXPECT_EQ(unpack(9, values), values.size());
  follow({9});
  EXPECT_TRUE(std::signbit(history_of(history, 9)[1]));
}

// The GNU C library fills memory that it hands out if it is asked to.
TEST_P(BodyHistoryTest, NumbersThatAreKeptLaterAreZero)
{
#if defined(M_PERTURB)
  mallopt(M_PERTURB, 0x55);
#endif
  history.keep_records(5);
#if defined(M_PERTURB)
  mallopt(M_PERTURB, 0);
#endif
  for (const auto &[particle, first] : {std::pair(3, 10.0), {17, 20.0}, {5, 30.0}, {11, 40.0}})
    EXPECT_EQ(history_of(history, particle), values(first)) << particle;
  history.keep_records(records());
  EXPECT_TRUE(same_bits(packed(17), expected(20.0)));
}

TEST_P(BodyHistoryTest, MemoryIsThatOfTheCandidates)
{
  const double few = history.memory_usage();
  memory.put_aside();
  memory.pairs().resize(100000);
  follow({3, 17, 5, 11});
  EXPECT_LE(history.memory_usage(), few);
}

INSTANTIATE_TEST_SUITE_P(RecordsAndSeveral, BodyHistoryTest,
                         testing::Combine(testing::Values(1, 2, 5), testing::Bool()));

TEST(OneContact, SeparatedOnesAreForgotten)
{
  BodyHistory history;
  history.keep(false);
  history.keep_records(2);
  history.follow({3, 17, 5, 11}, no_room);
  history.set_touching(0, 0xfU, 0xfU);
  for (int c = 0; c < 4; c++) {
    history.record(c).c[0] = c + 1.0;
    history.record(c, 1).c[0] = c + 1.0;
  }
  history.set_touching(0, 0xfU, 0xdU);    // the second has gone
  EXPECT_EQ(history.record(1).c[0] + history.record(1, 1).c[0], 0.0);
  EXPECT_EQ(history.count(1), 0);
  EXPECT_EQ(history.record(0).c[0], 1.0);
  history.set_touching(0, 0x3U, 0x1U);    // the others are not asked for
  EXPECT_EQ(history.record(2).c[0], 3.0);
  EXPECT_EQ(history.record(3).c[0], 4.0);
  EXPECT_EQ(history.touched(0), 0xdU);
  history.set_touching(0, 0xfU, 0x2U);
  for (const int c : {0, 2, 3}) EXPECT_EQ(history.record(c).c[0], 0.0);
  EXPECT_EQ(history.touched(1), 0U);    // there are no such candidates
}

// With their normals, which go where the histories go.
TEST(OneContact, KnowsTheNormalOfTheStepBefore)
{
  ContactMemory memory;
  memory.pairs().resize(20);
  BodyHistory history;
  history.rest_in(memory, -1);
  history.keep(false, true);
  history.follow({3, 17}, no_room);
  history.set_touching(0, 3U, 3U);
  EXPECT_EQ(history.replace_normal(1, {0.0, 0.6, 0.8}).z, 0.0) << "a new contact has none";
  EXPECT_EQ(history.replace_normal(1, {0.0, 0.8, 0.6}).z, 0.8);
  memory.put_aside();
  memory.pairs().copy(17, 5);
  history.follow({5, 17}, no_room);
  EXPECT_EQ(history.replace_normal(0, {1.0, 0.0, 0.0}).z, 0.6);
  history.set_touching(0, 3U, 2U);    // the first has separated
  EXPECT_EQ(history.replace_normal(0, {1.0, 0.0, 0.0}).x, 0.0);
  history.forget_normals();
  EXPECT_EQ(history.replace_normal(1, {1.0, 0.0, 0.0}).z, 0.0);
}

V tilted(double angle)
{
  return {std::sin(angle), 0.0, std::cos(angle)};
}

// Each contact continues the nearest of those that nobody has continued yet, if it is near enough.
TEST(SeveralContacts, AreKnownByTheirNormals)
{
  BodyHistory history;
  history.keep(true);
  history.follow({0}, {4});
  SurfaceContact first[3] = {{tilted(0.0), 0.3}, {tilted(0.5), 0.2}, {tilted(1.5), 0.1}};
  history.continue_contacts(0, first, 3);
  for (int k = 0; k < 3; k++) history.record(k).c[0] = k + 1.0;

  SurfaceContact next[4] = {
      {tilted(0.45), 0.3}, {tilted(0.4), 0.2}, {tilted(-1.0), 0.1}, {tilted(1.4), 0.1}};
  V before[LargeBodyShape::max_contacts];
  history.continue_contacts(0, next, 4, before);
  ASSERT_EQ(history.count(0), 4);
  const double continued[4] = {2.0, 1.0, 0.0, 3.0};
  for (int k = 0; k < 4; k++) EXPECT_EQ(history.record(k).c[0], continued[k]) << k;
  EXPECT_EQ(before[0].x, tilted(0.5).x);
  EXPECT_EQ(before[1].z, 1.0);
  EXPECT_EQ(length(before[2]), 0.0) << "a new contact had none";

  history.continue_contacts(0, next, 0);
  EXPECT_EQ(history.count(0), 0);
  history.continue_contacts(0, next, 1);
  EXPECT_EQ(history.record(0).c[0], 0.0) << "what has separated is forgotten";
}

// A contact may last where there is no overlap any more, and does not begin there.
TEST(SeveralContacts, BeginWithAnOverlap)
{
  BodyHistory history;
  history.keep(true);
  history.follow({0}, {3});
  SurfaceContact first[2] = {{tilted(0.0), -0.01}, {tilted(1.0), 0.2}};
  EXPECT_EQ(history.continue_contacts(0, first, 2), 1);
  EXPECT_EQ(first[0].overlap, 0.2);
  history.record(0).c[0] = 7.0;
  SurfaceContact next[3] = {{tilted(2.0), 0.1}, {tilted(0.0), -0.01}, {tilted(1.0), -0.02}};
  EXPECT_EQ(history.continue_contacts(0, next, 3), 2);
  EXPECT_EQ(next[1].overlap, -0.02);
  EXPECT_EQ(history.record(0).c[0], 0.0);
  EXPECT_EQ(history.record(1).c[0], 7.0);
}

// Of second order: for the step in which they end.
TEST(SeveralContacts, LastForTheStepInWhichTheyEnd)
{
  BodyHistory history;
  history.keep(true);
  history.follow({0}, {2});
  SurfaceContact found[LargeBodyShape::max_contacts] = {{tilted(0.0), 0.2}, {tilted(2.0), 0.1}};
  history.continue_contacts(0, found, 2);
  history.record(0).c[3] = history.record(1).c[3] = -1.0;
  history.record(0).c[0] = 7.0;

  int asked = 0;    // what is found there is near the first contact, and one that touches as well
  const auto beyond = [&asked](double tilt) {
    return BodyHistory::Ends{true, [&asked, tilt](SurfaceContact *far) {
                               asked++;
                               far[0] = {tilted(2.0), 0.1};
                               far[1] = {tilted(tilt), -0.03};
                               return 2;
                             }};
  };
  const BodyHistory::Ends near = beyond(0.1), elsewhere = beyond(1.0);
  found[0] = {tilted(0.0), 0.2};
  found[1] = {tilted(2.0), 0.1};
  EXPECT_EQ(history.continue_contacts(0, found, 2, nullptr, &near), 2);
  EXPECT_EQ(asked, 0) << "none has ended";

  found[0] = {tilted(2.0), 0.1};
  ASSERT_EQ(history.continue_contacts(0, found, 1, nullptr, &near), 2);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(found[1].overlap, -0.03);
  EXPECT_EQ(history.record(1).c[0], 7.0);
  history.record(1).c[3] = 1.0;    // that has been its last step
  found[0] = {tilted(2.0), 0.1};
  EXPECT_EQ(history.continue_contacts(0, found, 1, nullptr, &near), 1);
  EXPECT_EQ(asked, 1);

  EXPECT_EQ(history.continue_contacts(0, found, 0, nullptr, &elsewhere), 0);
  EXPECT_EQ(asked, 2) << "but what is found there is another contact";
}

// A particle keeps its contacts even if the new list has less room for it.
TEST(SeveralContacts, RoomIsThatOfTheCandidatesAndOfWhatTheyHave)
{
  BodyHistory history;
  history.keep(true);
  history.follow({2, 0}, {1, 3});
  EXPECT_EQ(history.first_slot(1), 1U);
  SurfaceContact found[3] = {{tilted(0.0), 0.3}, {tilted(1.0), 0.2}, {tilted(2.0), 0.1}};
  history.continue_contacts(1, found, 3);
  for (int k = 0; k < 3; k++) history.record(1 + k).c[0] = k + 1.0;
  history.follow({0, 1}, {1, 1});
  EXPECT_EQ(history.count(0), 3);
  EXPECT_EQ(history.first_slot(1), 3U);
  EXPECT_EQ(history.record(2).c[0], 3.0);
}

}    // namespace
