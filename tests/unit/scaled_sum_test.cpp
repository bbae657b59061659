// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums below a bound: the same bits in any order, and the exact sum to rounding.

#include "base/exact_sum.h"
#include "base/scaled_sum.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace Talus;

namespace {

std::vector<double> numbers(std::size_t count, double bound, unsigned seed)
{
  RandomSource random(seed);
  std::vector<double> all(count);
  for (double &x : all)
    x = bound * random.uniform(-1.0, 1.0) * std::exp2(random.uniform(-40.0, 0.0));
  return all;
}

double sum_of(const std::vector<double> &all, double bound, int parts = 1)
{
  const SumScale scale(bound);
  std::vector<ScaledSum> sums(parts);
  for (std::size_t k = 0; k < all.size(); k++) scale.add(all[k], sums[k % parts]);
  ScaledSum total;
  for (const ScaledSum &one : sums) total.add(one);
  return scale.value(total);
}

}    // namespace

TEST(ScaledSum, OrderAndPartsDoNotMatter)
{
  std::vector<double> all = numbers(5000, 7.3, 1);
  const double once = sum_of(all, 7.3);
  RandomSource random(2);
  for (const int parts : {1, 2, 3, 17}) {
    random.shuffle(all);
    EXPECT_EQ(sum_of(all, 7.3, parts), once);
  }
}

TEST(ScaledSum, IsTheExactSumToRoundingOfSmallParts)
{
  for (const double bound : {1.0, 3e-7, 8.1e120, 5e-290}) {
    const std::vector<double> all = numbers(20000, bound, 3);
    ExactSum exact;
    for (const double x : all) exact.add(x);
    EXPECT_NEAR(sum_of(all, bound), exact.value(),
                1e-15 * std::fabs(exact.value()) + 1e-17 * bound);
  }
}

TEST(ScaledSum, TakesTheBoundItselfAndNothing)
{
  for (const double bound : {1.0, 4.0, 0.75}) {
    EXPECT_EQ(sum_of({bound, bound, -bound}, bound), bound);
    EXPECT_EQ(sum_of(std::vector<double>(100000, -bound), bound), -1e5 * bound);
  }
  EXPECT_EQ(sum_of({0.0, 0.0}, 0.0), 0.0);
  EXPECT_EQ(sum_of({}, 0.0), 0.0);
}
