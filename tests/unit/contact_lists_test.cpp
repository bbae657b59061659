// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Lists of contacts that move with their particles, against a map of vectors.

#include "history/contact_lists.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <map>
#include <vector>

using namespace Talus;

namespace {

struct Known {
  std::int64_t partner;
  std::uint64_t feature;
  std::vector<double> values;
  bool operator==(const Known &o) const
  {
    return partner == o.partner && feature == o.feature && values == o.values;
  }
};
using Model = std::map<int, std::vector<Known>>;

std::vector<Known> list_of(const ContactLists &lists, int particle)
{
  std::vector<Known> found;
  lists.for_each(particle, [&](const ContactLists::Contact &one) {
    found.push_back({one.partner, one.feature, {one.value, one.value + lists.values()}});
  });
  return found;
}

std::vector<double> packed(const ContactLists &lists, int particle)
{
  std::vector<double> buffer(lists.packed_size(particle));
  EXPECT_EQ(lists.pack(particle, buffer.data()), static_cast<int>(buffer.size()));
  return buffer;
}

class Lists : public testing::Test {
 protected:
  static constexpr int particles = 30, width = 6;
  RandomSource random{11};
  ContactLists lists;
  Model model;

  Lists()
  {
    lists.keep(width);
    lists.grow(particles);
  }

  /// Names with all bits, which as numbers would be infinite or no numbers.
  void add(int particle)
  {
    Known one{-1 - random.below(1000), ~static_cast<std::uint64_t>(random.below(1000)), {}};
    if (random.chance(0.5))
      one.partner = std::numeric_limits<std::int64_t>::max() - random.below(9);
    for (int n = 0; n < width; n++) one.values.push_back(random.uniform(-1.0, 1.0));
    std::copy(one.values.begin(), one.values.end(), lists.add(particle, one.partner, one.feature));
    model[particle].push_back(one);
  }

  void expect_model()
  {
    int largest = 0;
    for (int i = 0; i < particles; i++) {
      ASSERT_EQ(list_of(lists, i), model[i]) << i;
      ASSERT_EQ(lists.count(i), static_cast<int>(model[i].size()));
      ASSERT_EQ(lists.empty(i), model[i].empty());
      largest = std::max(largest, lists.packed_size(i));
    }
    EXPECT_EQ(lists.largest_packed(particles), largest);
  }
};

TEST_F(Lists, MoveWithTheirParticles)
{
  for (int round = 0; round < 300; round++) {
    const int i = random.below(particles), j = random.below(particles);
    switch (random.below(4)) {
    case 0:
      add(i);
      break;
    case 1:    // the last particle takes the place of one that leaves
      lists.copy(i, j);
      if (i != j) lists.forget(i);
      model[j] = model[i];
      if (i != j) model[i].clear();
      break;
    case 2:
      lists.forget(i);
      model[i].clear();
      break;
    default: {    // to another rank and back
      const std::vector<double> buffer = packed(lists, i);
      EXPECT_EQ(lists.unpack(j, buffer.data()), static_cast<int>(buffer.size()));
      model[j] = model[i];
    }
    }
    ASSERT_NO_FATAL_FAILURE(expect_model()) << "round " << round;
  }
  lists.clear();
  model.clear();
  EXPECT_TRUE(lists.empty());
  expect_model();
}

// As after a change of laws, or in a restart file of a run with others.
TEST_F(Lists, KeepWhatBothLawsHave)
{
  for (int n = 0; n < 40; n++) add(random.below(particles));
  for (const int wanted : {9, 4}) {
    ContactLists other;
    other.keep(wanted);
    other.grow(1);
    const ContactLists before = lists;
    lists.keep(wanted);
    for (int i = 0; i < particles; i++) {
      std::vector<Known> expected = model[i];
      for (Known &one : expected) one.values.resize(std::min(width, wanted));
      for (Known &one : expected) one.values.resize(wanted, 0.0);
      EXPECT_EQ(list_of(lists, i), expected) << i;
      const std::vector<double> buffer = packed(before, i);
      EXPECT_EQ(other.unpack(0, buffer.data()), static_cast<int>(buffer.size()));
      EXPECT_EQ(list_of(other, 0), expected) << i;
    }
    lists = before;
  }
}

}    // namespace
