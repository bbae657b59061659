// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Lists of contacts that move with their particles, against a map of vectors.

#include "history/contact_lists.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
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

const auto skip_none = [](const ContactLists::Contact & /*one*/) { return false; };

std::vector<Known> list_of(const ContactLists &lists, int particle)
{
  std::vector<Known> found;
  lists.for_each(particle, [&](const ContactLists::Contact &one) {
    found.push_back({one.partner, one.feature, {one.value, one.value + one.values}});
  });
  return found;
}

std::vector<double> packed(const ContactLists &lists, int particle)
{
  std::vector<double> buffer(lists.packed_size(particle));
  ContactLists::Writer to(buffer.data());
  lists.for_each(particle, [&to](const ContactLists::Contact &one) { to.add(one); });
  EXPECT_EQ(to.size(), static_cast<int>(buffer.size()));
  return buffer;
}

class Lists : public testing::Test {
 protected:
  static constexpr int particles = 30;
  RandomSource random{11};
  ContactLists lists;
  Model model;

  Lists() { lists.grow(particles); }

  /// Names with all bits, which as numbers would be infinite or no numbers.
  void add(int particle)
  {
    Known one{-1 - random.below(1000), ~static_cast<std::uint64_t>(random.below(1000)), {}};
    if (random.chance(0.5))
      one.partner = std::numeric_limits<std::int64_t>::max() - random.below(9);
    for (int n = random.below(9); n > 0; n--) one.values.push_back(random.uniform(-1.0, 1.0));
    std::copy(one.values.begin(), one.values.end(),
              lists.add(particle, one.partner, one.feature, static_cast<int>(one.values.size())));
    model[particle].push_back(one);
  }

  void expect_model()
  {
    int largest = 0;
    for (int i = 0; i < particles; i++) {
      ASSERT_EQ(list_of(lists, i), model[i]) << i;
      ASSERT_EQ(lists.empty(i), model[i].empty());
      largest = std::max(largest, lists.packed_size(i));
    }
    EXPECT_EQ(lists.largest_packed(particles), largest);
  }

  static void remove_odd_of(std::vector<Known> &all)
  {
    all.erase(std::remove_if(all.begin(), all.end(), [](const Known &k) { return k.feature % 2; }),
              all.end());
  }
};

TEST_F(Lists, MoveWithTheirParticles)
{
  const auto is_odd = [](const ContactLists::Contact &one) { return one.feature % 2 == 1; };
  for (int round = 0; round < 600; round++) {
    const int i = random.below(particles), j = random.below(particles);
    switch (random.below(7)) {
    case 0:
    case 1:
    case 2:
      add(i);
      break;
    case 3:    // the last particle takes the place of one that leaves
      lists.copy(i, j);
      if (i != j) lists.forget(i);
      model[j] = model[i];
      if (i != j) model[i].clear();
      break;
    case 4:
      lists.forget(i);
      model[i].clear();
      break;
    case 5:
      if (!random.chance(0.2)) break;
      lists.remove_if(is_odd);
      for (auto &[particle, all] : model) remove_odd_of(all);
      break;
    default: {    // to another rank and back, perhaps not all of it
      const bool some = random.chance(0.3);
      const std::vector<double> buffer = packed(lists, i);
      const int size =
          some ? lists.unpack(j, buffer.data(), is_odd) : lists.unpack(j, buffer.data(), skip_none);
      EXPECT_EQ(size, static_cast<int>(buffer.size()));
      model[j] = model[i];
      if (some) remove_odd_of(model[j]);
    }
    }
    ASSERT_NO_FATAL_FAILURE(expect_model()) << "round " << round;
  }
  lists.clear();
  model.clear();
  EXPECT_TRUE(lists.empty());
  expect_model();
}

}    // namespace
