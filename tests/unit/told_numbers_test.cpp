// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/told_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

TEST(ToldNumbers, AreEnough)
{
  EXPECT_DOUBLE_EQ(rounded_up(1.008, 2), 1.1);
  EXPECT_DOUBLE_EQ(rounded_down(0.996, 2), 0.99);
  EXPECT_DOUBLE_EQ(rounded_up(315.3, 2), 320.0);
  EXPECT_DOUBLE_EQ(rounded_up(9.96, 2), 10.0);
  EXPECT_DOUBLE_EQ(rounded_down(0.0333, 2), 0.033);
  for (double number = 1.37e-7; number < 1e7; number *= 1.9)
    for (const int digits : {1, 2, 3, 6}) {
      EXPECT_GE(rounded_up(number, digits), number * (1.0 - 1.0e-11));
      EXPECT_LE(rounded_up(number, digits), number * (1.0 + std::pow(10.0, 1 - digits)));
      EXPECT_LE(rounded_down(number, digits), number * (1.0 + 1.0e-11));
      EXPECT_GE(rounded_down(number, digits), number * (1.0 - std::pow(10.0, 1 - digits)));
    }
}

/// Numbers that have so few digits stay, whatever rounding has done to them.
TEST(ToldNumbers, StayIfTheyAreShort)
{
  for (const double number :
       {9.0, 0.33, 1.1, 10.0, 0.1, 2.0, 16.2, 9.0 * (1.0 + 1e-15), 0.1 + 0.2}) {
    EXPECT_DOUBLE_EQ(rounded_up(number, 3), std::round(number * 1000) / 1000);
    EXPECT_DOUBLE_EQ(rounded_down(number, 3), std::round(number * 1000) / 1000);
  }
}
