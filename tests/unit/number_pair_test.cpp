// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/number_pair.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

namespace {

/// Numbers of either sign, from those that stand for zero on.
double some_number(RandomSource &random)
{
  const double size = random.chance(0.1) ? 1.0e-200 : random.decade(-290.0, 290.0);
  return random.chance(0.5) ? size : -size;
}

template <int kept> void expect_pairs(double most_error)
{
  RandomSource random(kept);
  using Pair = NumberPair<kept>;
  for (int n = 0; n < 10000; n++) {
    const double number = some_number(random), second = random.uniform(-1.0, 1.0);
    const double first = Pair::first(number), both = Pair::pair(first, second);
    EXPECT_LE(std::fabs(first - number), std::ldexp(std::fabs(number), -kept));
    EXPECT_EQ(Pair::first(first), first);
    EXPECT_EQ(Pair::first(both), first);
    EXPECT_NEAR(Pair::second(both), second, most_error);
    EXPECT_EQ(Pair::first(splat<Vec8>(both))[3], first);
    EXPECT_EQ(Pair::second(splat<Vec8>(both))[3], Pair::second(both));
  }
}

}    // namespace

TEST(NumberPair, KeepsBoth)
{
  expect_pairs<26>(std::ldexp(1.0, -25));
  expect_pairs<47>(std::ldexp(1.0, -4));
}

TEST(NumberPair, KeepsFlags)
{
  RandomSource random(1);
  for (int n = 0; n < 10000; n++)
    for (const double flags : {0.0, 1.0, 2.0, 3.0}) {
      const double number = without_flags(some_number(random)), both = with_flags(number, flags);
      EXPECT_EQ(without_flags(both), number);
      EXPECT_NEAR(flags_of(both), flags, 0.25);
      EXPECT_EQ(without_flags(-both), -number);
      EXPECT_NEAR(flags_of(-both), flags, 0.25);
    }
}

TEST(NumberPair, ZeroIsAlone)
{
  EXPECT_EQ(with_flags(0.0, 3.0), 0.0);
  EXPECT_EQ(flags_of(0.0), 0.0);
  EXPECT_EQ(EvenPair::second(EvenPair::pair(0.0, 1.0)), 0.0);
}
