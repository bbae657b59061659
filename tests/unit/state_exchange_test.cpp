// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/state_exchange.h"

#include "base/aligned_vector.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace Talus;

namespace {

struct WithMemory {
  int value = 0;
  double memory_usage() const { return 1000.0; }
};

struct Thing {
  double number = 1.5;
  std::array<int, 3> three{{1, 2, 3}};
  std::vector<double> list{0.25, -0.0};
  AlignedVector<int> aligned{7, 8, 9};
  std::map<int, std::string> names{{4, "four"}};
  WithMemory whole;
  float rows[2][3] = {{1, 2, 3}, {4, 5, 6}};

  void exchange_state(StateExchange &x)
  {
    x(number, three, list, aligned);
    x(names, whole);
    x.array(rows[0], 6);
    x.array(rows[0], 0);
  }
};

TEST(StateExchange, RestoresAsOftenAsOneLikes)
{
  SavedState state;
  Thing thing;
  thing.whole.value = 5;
  StateExchange saving(state);
  EXPECT_FALSE(saving.restores());
  thing.exchange_state(saving);
  for (int k = 0; k < 2; k++) {
    thing = {2.0, {{0, 0, 0}}, {1.0}, {}, {}, {6}, {}};
    StateExchange restoring(static_cast<const SavedState &>(state));
    EXPECT_TRUE(restoring.restores());
    thing.exchange_state(restoring);
    EXPECT_EQ(thing.number, 1.5);
    EXPECT_EQ(thing.three[2], 3);
    EXPECT_EQ(thing.list.size(), 2U);
    EXPECT_TRUE(std::signbit(thing.list[1]));
    EXPECT_EQ(thing.aligned[2], 9);
    EXPECT_EQ(thing.names.at(4), "four");
    EXPECT_EQ(thing.whole.value, 5);
    EXPECT_EQ(thing.rows[1][2], 6);
  }
}

TEST(StateExchange, SavesBehindWhatIsThere)
{
  SavedState state;
  int one = 1, two = 2;
  StateExchange saving(state);
  saving(one);
  StateExchange more(state);
  more(two);
  one = two = 0;
  StateExchange restoring(static_cast<const SavedState &>(state));
  restoring(one, two);
  EXPECT_EQ(one, 1);
  EXPECT_EQ(two, 2);
}

TEST(StateExchange, TellsItsMemory)
{
  SavedState state;
  StateExchange saving(state);
  std::vector<double> list(100);
  WithMemory whole;
  int number = 1;
  saving(list, whole, number);
  saving.array(list.data(), 10);
  EXPECT_EQ(state.memory_usage(),
            100 * sizeof(double) + 1000.0 + sizeof(int) + 10 * sizeof(double));
}

}    // namespace
