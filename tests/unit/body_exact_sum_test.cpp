// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The exact sum: no order, no grouping and no cancellation changes a bit of it.

#include "base/exact_sum.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

using namespace Talus;

namespace {

ExactSum sum_of(const std::vector<double> &values)
{
  ExactSum sum;
  for (const double v : values) sum.add(v);
  return sum;
}

TEST(ExactSum, SingleNumbersComeBack)
{
  using limits = std::numeric_limits<double>;
  for (const double v : {0.0, 1.0, -1.0, 0.1, -3.7e200, 5.0e-324, -2.0e-310, limits::max(),
                         -limits::max(), limits::min(), 1.0 / 3.0})
    EXPECT_EQ(sum_of({v}).value(), v);
}

TEST(ExactSum, CancellationLosesNothing)
{
  EXPECT_EQ(sum_of({1.0e300, 1.0, -1.0e300}).value(), 1.0);
  EXPECT_EQ(sum_of({1.0e16, 1.0, 1.0, -1.0e16, 5.0e-324}).value(), 2.0);
  EXPECT_EQ(sum_of({1.0e-200, -1.0, 1.0}).value(), 1.0e-200);
  EXPECT_EQ(sum_of({0.1, 0.2, -0.1, -0.2}).value(), 0.0);
}

TEST(ExactSum, OrderAndGroupsDoNotMatter)
{
  RandomSource random(5);
  std::vector<double> values;
  for (int k = 0; k < 3000; k++)
    values.push_back(random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-30.0, 30.0)));
  const double expected = sum_of(values).value();
  double plain = 0.0;
  for (const double v : values) plain += v;
  for (int repeat = 0; repeat < 20; repeat++) {
    random.shuffle(values);
    EXPECT_EQ(sum_of(values).value(), expected);
    // as over ranks: parts whose digits are added one by one
    std::vector<ExactSum> ranks(1 + random.below(5));
    for (std::size_t k = 0; k < values.size(); k++) ranks[k % ranks.size()].add(values[k]);
    ExactSum all, digits;
    for (ExactSum &r : ranks) {
      all.add(r);
      r.normalize();
      for (int k = 0; k < ExactSum::size; k++) digits.data()[k] += r.data()[k];
    }
    EXPECT_EQ(all.value(), expected);
    EXPECT_EQ(digits.value(), expected);
  }
  EXPECT_NEAR(plain, expected, 1e-10 * std::fabs(expected));
}

TEST(ExactSum, ManyAdditionsCarry)
{
  ExactSum sum;
  for (int k = 0; k < 3000000; k++) sum.add(0.1);
  // 0.1 as a double times 3e6, exactly
  EXPECT_EQ(sum.value(), static_cast<double>(3.0e6L * 0.1));
}

// Digits grow with every addition until they are carried, and the sum stays what it is.
TEST(ExactSum, CarriesAfterTheLargestNumberOfAdditions)
{
  const double value = 1.0 - std::pow(2.0, -53);
  const auto largest_digit = [](const ExactSum &sum) {
    return *std::max_element(sum.data(), sum.data() + ExactSum::num_digits);
  };
  for (const double sign : {1.0, -1.0}) {
    ExactSum sum;
    for (int k = 0; k < ExactSum::max_pending; k++) sum.add(sign * value);
    EXPECT_EQ(sum.value(), sign * value * ExactSum::max_pending);
    const std::int64_t before =
        *std::max_element(sum.data(), sum.data() + ExactSum::num_digits,
                          [](std::int64_t a, std::int64_t b) { return std::abs(a) < std::abs(b); });
    EXPECT_GT(std::abs(before), std::int64_t{1} << 51);
    EXPECT_LT(std::abs(before), std::int64_t{1} << 53);
    sum.add(sign * value);    // one more: carried before
    EXPECT_LT(largest_digit(sum), std::int64_t{1} << 34);
    sum.add(-sign * value);
    EXPECT_EQ(sum.value(), sign * value * ExactSum::max_pending);
  }
}

TEST(ExactSum, NotFinite)
{
  EXPECT_TRUE(std::isnan(sum_of({1.0, INFINITY}).value()));
  EXPECT_TRUE(std::isnan(sum_of({NAN}).value()));
  ExactSum sum = sum_of({NAN});
  sum.clear();
  sum.add(2.0);
  EXPECT_EQ(sum.value(), 2.0);
}

}    // namespace
