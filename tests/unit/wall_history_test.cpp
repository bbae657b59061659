// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of contacts with walls of LAMMPS: contacts are known by the parts that they touch, in the
// places that the stock fix gives them.

#include "body/contact/body_history.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace Talus;

namespace {

class WallHistory : public testing::Test {
 protected:
  WallHistory()
  {
    memory.pairs().resize(10);
    history.keep_records(1);
    history.rest_in(memory, name);
  }

  /// What rests there of a particle: part and first value of each contact.
  using Row = std::vector<std::pair<int, double>>;
  Row row(int particle) const
  {
    Row all;
    memory.lists().for_each(particle, [&all](const ContactLists::Contact &one) {
      all.emplace_back(one.feature, BodyHistory::values_of(one)[0]);
    });
    return all;
  }
  void put(int particle, int part, double value)
  {
    history.add(memory.lists_to_fill(), particle, part, {0.0, 0.0, 0.0}, {value});
  }

  /// Of the first candidate: the contacts of a step; the slot of each.
  std::vector<std::uint32_t> touch(const std::vector<int> &parts)
  {
    history.begin_step();
    std::vector<SurfaceContact> found;
    for (const int part : parts) found.push_back({{0.0, 0.0, 1.0}, 0.1, part});
    std::vector<std::uint32_t> slots(parts.size());
    history.continue_parts(0, found.data(), static_cast<int>(found.size()), slots.data());
    return slots;
  }
  /// The same, where values tell the parts.
  void expect_own_values(const std::vector<int> &parts)
  {
    const std::vector<std::uint32_t> slots = touch(parts);
    for (std::size_t n = 0; n < parts.size(); n++)
      EXPECT_EQ(history.record(slots[n]).c[0], 10.0 * parts[n]);
  }
  void fill(const std::vector<int> &parts)
  {
    const std::vector<std::uint32_t> slots = touch(parts);
    for (std::size_t n = 0; n < parts.size(); n++) history.record(slots[n]).c[0] = 10.0 * parts[n];
  }

  static constexpr std::int64_t name = -3;
  ContactMemory memory;
  BodyHistory history;
};

TEST_F(WallHistory, RestsInTheMemory)
{
  history.keep_parts(false);
  put(7, 0, 1.5);
  EXPECT_EQ(history.particles_in_contact(10), std::vector<int>{7});
  history.follow({2, 7}, {1, 1});
  EXPECT_EQ(history.record(1).c[0], 1.5);
  EXPECT_EQ(history.touched(0), 2U);
  history.begin_step();
  history.set_touching(0, 3U, 1U);
  history.record(0).c[0] = 2.5;
  EXPECT_EQ(history.particles_in_contact(10), std::vector<int>{2});
  memory.put_aside();
  EXPECT_EQ(row(2), (Row{{0, 2.5}}));
  EXPECT_TRUE(row(7).empty());
  EXPECT_EQ(history.particles_in_contact(10), std::vector<int>{2});
}

// What comes while all is at rest is taken with the rest.
TEST_F(WallHistory, TakesWhatIsAdded)
{
  history.keep_parts(true);
  history.follow({4}, {3});
  fill({5});
  memory.put_aside();
  put(4, 6, 60.0);
  history.follow({1, 4}, {3, 3});
  EXPECT_EQ(history.count(1), 2);
  EXPECT_EQ(history.record(history.first_slot(1) + 1).c[0], 60.0);
}

TEST_F(WallHistory, ContactsContinueThoseWithTheirParts)
{
  history.keep_parts(true);
  history.follow({4}, {6});
  fill({5, 3});
  expect_own_values({3, 5});
  expect_own_values({3});
  const std::uint32_t added = touch({3, 8})[1];
  EXPECT_EQ(history.record(added).c[0], 0.0);
  history.record(added).c[0] = 80.0;
  expect_own_values({8, 3});
  EXPECT_TRUE(touch({}).empty());
  EXPECT_EQ(history.count(0), 0);
}

TEST_F(WallHistory, PlacesAreThoseOfTheStockFix)
{
  history.keep_parts(true);
  history.follow({4}, {6});
  fill({1, 2, 3});
  touch({2, 3});    // the last one takes the place of the first
  memory.put_aside();
  EXPECT_EQ(row(4), (Row{{3, 30.0}, {2, 20.0}}));
}

TEST_F(WallHistory, PartsOfOneNumberHaveTheirOwn)
{
  history.keep_parts(true);
  history.follow({4}, {6});
  const std::vector<std::uint32_t> slots = touch({5, 5});
  EXPECT_NE(slots[0], slots[1]);
  history.record(slots[0]).c[0] = 1.0;
  history.record(slots[1]).c[0] = 2.0;
  EXPECT_EQ(touch({5, 5}), slots);
  touch({5});
  EXPECT_EQ(history.count(0), 1);
}

}    // namespace
