// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/rounding.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

namespace {

double some_number(RandomSource &random)
{
  const double size = random.decade(-290.0, 290.0);
  return random.chance(0.5) ? size : -size;
}

template <int bits> void expect_rounded()
{
  RandomSource random(bits);
  for (int n = 0; n < 10000; n++) {
    const double number = some_number(random), result = rounded<bits>(number);
    int exponent;
    const double mantissa = std::ldexp(std::frexp(result, &exponent), bits);
    EXPECT_EQ(mantissa, std::round(mantissa)) << "no more bits";
    EXPECT_LE(std::fabs(result - number), std::ldexp(std::fabs(number), -bits));
    EXPECT_EQ(rounded<bits>(result), result);
    EXPECT_EQ(rounded<bits>(splat<Vec8>(number))[3], result);
  }
  EXPECT_EQ(rounded<bits>(0.0), 0.0);
}

}    // namespace

TEST(Rounding, ToBits)
{
  expect_rounded<26>();
  expect_rounded<47>();
}

TEST(Rounding, OfAShareBesideANumber)
{
  RandomSource random(3);
  for (int n = 0; n < 10000; n++) {
    const double number = rounded<26>(some_number(random)), share = random.uniform(-1.0, 1.0);
    const double result = rounded_share<26>(share, number);
    EXPECT_NEAR(result, share, std::ldexp(1.0, -25));
    EXPECT_EQ(rounded_share<26>(result, number), result);
    EXPECT_EQ(rounded_share<26>(splat<Vec8>(share), splat<Vec8>(number))[3], result);
    EXPECT_EQ(rounded_share<26>(share, 0.0), share);
  }
}
