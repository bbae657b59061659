// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "particles/canonical_key.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <limits>

using namespace Talus;

namespace {

constexpr int bits_per_axis = 21;
constexpr std::int64_t half = std::int64_t{1} << 20;

/// Bit b of cell d stands at place 3 b + d of the key.
std::uint64_t naive_key(const std::int64_t (&cell)[3])
{
  std::uint64_t key = 0;
  for (int bit = 0; bit < bits_per_axis; bit++)
    for (int d = 0; d < 3; d++)
      if (cell[d] >> bit & 1) key += std::uint64_t{1} << (3 * bit + d);
  return key;
}

std::uint64_t key_of_cell(std::int64_t x, std::int64_t y, std::int64_t z)
{
  const double center[3] = {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5,
                            static_cast<double>(z) + 0.5};
  return canonical_key(center, 1.0);
}

TEST(CanonicalKey, SpreadsBitsAsANaiveLoop)
{
  RandomSource random(1);
  for (int n = 0; n < 10000; n++) {
    const std::uint64_t v = random.bits();    // whatever is above the lowest 21 bits does not count
    std::uint64_t expected = 0;
    for (int bit = 0; bit < bits_per_axis; bit++) expected |= (v >> bit & 1) << (3 * bit);
    ASSERT_EQ(spread_bits(v), expected) << v;
  }
}

TEST(CanonicalKey, InterleavesTheCells)
{
  RandomSource random(2);
  for (int n = 0; n < 10000; n++) {
    const double edge = random.decade(-3.0, 3.0), inverse = 1.0 / edge;
    double x[3];
    std::int64_t cell[3];
    for (int d = 0; d < 3; d++) {
      const double reach = n % 2 ? 1000.0 : 1048575.0;
      x[d] = edge * random.uniform(-reach, reach);
      cell[d] = static_cast<std::int64_t>(std::floor(x[d] * inverse)) + half;
    }
    ASSERT_EQ(canonical_key(x, inverse), naive_key(cell)) << x[0] << " " << x[1] << " " << x[2];
  }
}

TEST(CanonicalKey, IsTheSameWithinACellAndDiffersBetweenCells)
{
  const double inside[3] = {0.01, 0.99, 0.5}, also_inside[3] = {0.99, 0.01, 0.0};
  EXPECT_EQ(canonical_key(inside, 1.0), canonical_key(also_inside, 1.0));
  EXPECT_NE(key_of_cell(0, 0, 0), key_of_cell(-1, 0, 0));
  EXPECT_NE(key_of_cell(0, 0, 0), key_of_cell(0, 1, 0));
  EXPECT_NE(key_of_cell(0, 0, 0), key_of_cell(0, 0, -1));
}

TEST(CanonicalKey, RisesAlongEveryAxis)
{
  for (std::int64_t c = -half; c < half - 1; c += 997) {
    ASSERT_LT(key_of_cell(c, 5, -7), key_of_cell(c + 1, 5, -7));
    ASSERT_LT(key_of_cell(5, c, -7), key_of_cell(5, c + 1, -7));
    ASSERT_LT(key_of_cell(-7, 5, c), key_of_cell(-7, 5, c + 1));
  }
}

TEST(CanonicalKey, CountsWhatLiesOutsideToTheOutermostCell)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const std::int64_t last = half - 1;
  EXPECT_EQ(key_of_cell(half, 0, 0), key_of_cell(last, 0, 0));
  for (double far : {1e7, 1e18, 1e300, infinity}) {
    const double beyond[3] = {far, 0.5, -far};
    EXPECT_EQ(canonical_key(beyond, 1.0), key_of_cell(last, 0, -half)) << far;
  }
  const std::int64_t top[3] = {2 * half - 1, 2 * half - 1, 2 * half - 1};
  EXPECT_EQ(key_of_cell(last, last, last), naive_key(top));
  EXPECT_EQ(key_of_cell(last, last, last), ~std::uint64_t{0} >> 1);
  EXPECT_EQ(key_of_cell(-half, -half, -half), 0U);
  EXPECT_EQ(key_of_cell(-half - 1, -half - 9, -half), 0U);
}

TEST(CanonicalKey, MapsNotANumberToTheLowestCell)
{
  const double lost[3] = {std::nan(""), 0.5, std::nan("")};
  EXPECT_EQ(canonical_key(lost, 1.0), key_of_cell(-half, 0, -half));
}

// Neighbors in order are neighbors in space: consecutive cells of a block of 2^3k cells fill the
// block.
TEST(CanonicalKey, IsLocal)
{
  for (int level = 1; level <= 3; level++) {
    const std::int64_t edge = std::int64_t{1} << level;
    const std::uint64_t base = key_of_cell(-edge, 3 * edge, 0);
    const std::uint64_t count = std::uint64_t{1} << (3 * level);
    for (std::int64_t x = 0; x < edge; x++)
      for (std::int64_t y = 0; y < edge; y++)
        for (std::int64_t z = 0; z < edge; z++) {
          const std::uint64_t key = key_of_cell(x - edge, y + 3 * edge, z);
          EXPECT_GE(key, base);
          EXPECT_LT(key, base + count);
        }
  }
}

}    // namespace
