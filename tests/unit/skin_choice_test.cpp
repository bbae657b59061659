// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The skin that is chosen for neighbor lists, on counts that gases and beds have.

#include "neighbors/skin_choice.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

namespace {

constexpr double diameter = 2.0, given = 0.6;
constexpr SkinLimits limits{given, diameter};

/// Neighbors of a gas with this share of volume, each pair once.
CountedLists gas(double share, double skin, std::int64_t steps)
{
  constexpr std::int64_t particles = 27000;
  const double density = 6.0 * share / (M_PI * std::pow(diameter, 3));
  const double around = 4.0 / 3.0 * M_PI * std::pow(diameter + skin, 3) * density;
  return {skin, diameter, particles, std::llround(0.5 * around * particles), steps};
}

TEST(SkinChoice, gas_has_a_wide_one)
{
  const double chosen = choose_skin(gas(0.02, given, 20), limits);
  EXPECT_GT(chosen, 2.0 * given);
  EXPECT_LE(chosen, limits.most);
}

TEST(SkinChoice, denser_is_narrower)
{
  double before = choose_skin(gas(0.02, given, 20), limits);
  for (const double share : {0.1, 0.3, 0.6}) {
    const double now = choose_skin(gas(share, given, 20), limits);
    EXPECT_LE(now, before);
    EXPECT_GE(now, given);
    before = now;
  }
}

TEST(SkinChoice, lists_that_last_are_not_wider)
{
  EXPECT_EQ(choose_skin(gas(0.6, given, 100000), limits), given);
  EXPECT_EQ(choose_skin(gas(0.1, 1.2, 100000), limits), given);
}

TEST(SkinChoice, memory_is_bounded)
{
  const CountedLists bed = gas(0.6, given, 2);
  const double chosen = choose_skin(bed, limits);
  EXPECT_GT(chosen, given);
  const auto candidates = [](double skin) {
    return static_cast<double>(gas(0.6, skin, 2).candidates);
  };
  EXPECT_LE(candidates(chosen), candidates(given) + 3.5 * static_cast<double>(bed.particles));
}

TEST(SkinChoice, limits_hold)
{
  EXPECT_EQ(choose_skin(gas(0.02, given, 20), {given, 0.5 * given}), given);
  EXPECT_LE(choose_skin(gas(0.02, given, 20), {given, 1.5 * given}), 1.5 * given);
  // a wider one from before, where the box has become small
  EXPECT_EQ(choose_skin(gas(0.02, 2.0 * given, 40), {given, given}), given);
}

/* What is counted with the chosen one, for which lists last longer in proportion, does not change it. */

TEST(SkinChoice, stays_where_it_is)
{
  for (const double share : {0.02, 0.1, 0.3})
    for (const int steps : {10, 20, 50, 200}) {
      const double first = choose_skin(gas(share, given, steps), limits);
      const auto later = static_cast<std::int64_t>(std::llround(steps * first / given));
      EXPECT_EQ(choose_skin(gas(share, first, later), limits), first) << share << " " << steps;
      // and a few steps more or less do not either
      EXPECT_NEAR(choose_skin(gas(share, first, later + 2), limits), first, 0.2 * first);
    }
}

}    // namespace
