// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Packings of spheres: overlaps after relaxation, walls, periods, spheres that stay; what cannot fit; and the quantiles of
// distributions of sizes.

#include "cube_of_spheres.h"
#include "packing/size_distribution.h"
#include "packing/sphere_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

using namespace Talus;

namespace {

struct Spheres {
  std::vector<Vector3<double>> x;
  std::vector<double> radius;
};

Spheres at_random(int count, double least, double most)
{
  RandomNumbers random(7);
  Spheres spheres;
  for (int k = 0; k < count; k++) {
    spheres.x.push_back({random.uniform(), random.uniform(), random.uniform()});
    spheres.radius.push_back(least + (most - least) * random.uniform());
  }
  return spheres;
}

/// The distribution that a text tells of.
SizeDistribution sizes_of(const std::string &text)
{
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<const char *> arg;
  for (const std::string &word : words) arg.push_back(word.c_str());
  Words reader("command", static_cast<int>(arg.size()), arg.data(), 0,
               [](int, const std::string &problem) { throw std::runtime_error(problem); });
  SizeDistribution sizes;
  sizes.parse(reader);
  reader.end();
  return sizes;
}

}    // namespace

TEST(SpherePacking, holds_its_limit)
{
  const Cube cube;
  // few cells, where both neighbors of a cell are the same, and many
  for (const double r : {0.22, 0.04}) {
    const int count = static_cast<int>(0.5 / (4.18879 * r * r * r));
    const Spheres s = at_random(count, 0.8 * r, r);
    SpherePacking packing(cube, s.x, s.radius, count);
    ASSERT_TRUE(packing.relax(1e-3, 10000));
    EXPECT_LE(packing.largest_overlap(), 1e-3);
    EXPECT_NEAR(deepest(packing.places(), s.radius), packing.largest_overlap(), 1e-12);
    EXPECT_GT(packing.largest_overlap(), 0.0);
  }
}

TEST(SpherePacking, leaves_others_in_their_places)
{
  const Cube cube;
  Spheres s = at_random(200, 0.05, 0.06);
  s.x[199] = {0.01, 0.5, 0.5};
  s.radius[199] = 0.3;
  SpherePacking packing(cube, s.x, s.radius, 199);
  ASSERT_TRUE(packing.relax(1e-3, 10000));
  EXPECT_EQ(packing.places()[199].x, 0.01);
  EXPECT_EQ(packing.places()[199].z, 0.5);
  EXPECT_LE(deepest(packing.places(), s.radius), 1e-3 * (1 + 1e-9));
}

TEST(SpherePacking, tells_what_it_reached)
{
  const Cube cube;
  const Spheres s = at_random(700, 0.07, 0.07);    // a solid fraction of 1
  SpherePacking packing(cube, s.x, s.radius, 700);
  EXPECT_FALSE(packing.relax(1e-3, 100000));
  EXPECT_LT(packing.steps(), 20000);
  EXPECT_GT(packing.largest_overlap(), 0.1);
  EXPECT_NEAR(deepest(packing.places(), s.radius), packing.largest_overlap(), 1e-12);
}

TEST(SpherePacking, same_places_make_no_division_by_zero)
{
  const Cube cube;
  SpherePacking packing(cube, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}, {0.1, 0.1}, 2);
  ASSERT_TRUE(packing.relax(1e-3, 1000));
  EXPECT_GE(length(packing.places()[0] - packing.places()[1]), 0.2 - 1e-4);
}

TEST(SizeDistribution, quantiles)
{
  EXPECT_EQ(sizes_of("0.3").quantile(0.2), 0.3);
  EXPECT_DOUBLE_EQ(sizes_of("uniform 1 3").quantile(0.25), 1.5);
  const SizeDistribution two = sizes_of("discrete 2 2.0 1 1.0 3 number");
  EXPECT_EQ(two.quantile(0.24), 2.0);
  EXPECT_EQ(two.quantile(0.26), 1.0);
  EXPECT_EQ(two.largest(), 2.0);
  // by mass: a sphere of diameter 2 has the mass of eight
  EXPECT_EQ(sizes_of("discrete 2 2.0 8 1.0 1 mass").quantile(0.49), 2.0);
  EXPECT_EQ(sizes_of("discrete 2 2.0 8 1.0 1 mass").quantile(0.51), 1.0);
  EXPECT_NEAR(sizes_of("uniform 1 3 mass").quantile(1.0 - 1e-12), 3.0, 1e-9);
  EXPECT_NEAR(sizes_of("lognormal 1 0.2 0.001 1000").quantile(0.5), 1.0, 1e-9);
  EXPECT_NEAR(sizes_of("lognormal 1 0.2 0.001 1000 mass").quantile(0.5), std::exp(-3 * 0.04), 1e-9);
  // the moment of order 3 of a lognormal distribution
  constexpr double pi_6 = 0.5235987755982989;
  EXPECT_NEAR(sizes_of("lognormal 1 0.2 0.001 1000").count_of(1e6 * pi_6 * std::exp(4.5 * 0.04)),
              1e6, 1e3);
}

// By mass: the density by number is that by mass over the cube of the diameter, here summed over many small steps.
TEST(SizeDistribution, wide_ones_by_mass)
{
  for (const double sigma : {0.3, 1.0, 2.5, 2.8, 3.5, 6.0, 10.0}) {
    const double median = 1.0, lo = 0.5, hi = 30.0;
    const SizeDistribution sizes =
        sizes_of("lognormal 1 " + std::to_string(sigma) + " 0.5 30 mass");
    constexpr int steps = 200000;
    const double step = std::log(hi / lo) / steps;
    std::vector<double> share{0.0};    // up to lo exp(n step), cumulated
    for (int n = 0; n < steps; n++) {
      const double d = lo * std::exp((n + 0.5) * step), x = std::log(d / median) / sigma;
      share.push_back(share.back() + std::exp(-0.5 * x * x) / (d * d * d));
    }
    for (const double q : {0.01, 0.3, 0.5, 0.9, 0.999}) {
      const auto place = std::lower_bound(share.begin(), share.end(), q * share.back());
      const double expected = lo * std::exp(step * static_cast<double>(place - share.begin()));
      EXPECT_NEAR(sizes.quantile(q), expected, 1e-4 * expected) << sigma << " " << q;
    }
  }
  EXPECT_THROW(sizes_of("lognormal 1 20 0.5 30 mass"), std::runtime_error);
  EXPECT_THROW(sizes_of("lognormal 1 0.01 5 6"), std::runtime_error);
  EXPECT_EQ(sizes_of("lognormal 1 0.5 2 2 mass").quantile(0.5), 2.0);
}

// Also where the largest spheres have most of the volume, and there are few.
TEST(SizeDistribution, spheres_have_the_volume)
{
  for (const char *text : {"uniform 1 10 mass", "uniform 1 30 mass", "uniform 1 100 mass"})
    for (const double volume : {4e3, 4e4, 4e5, 4e6}) {
      RandomNumbers random(1);
      double sum = 0.0;
      const int count = static_cast<int>(std::round(sizes_of(text).count_of(volume)));
      for (const double d : sizes_of(text).diameters(count, random))
        sum += 0.5235987755982989 * d * d * d;
      EXPECT_NEAR(sum, volume, 5e-3 * volume) << text;
    }
  EXPECT_LT(sizes_of("2").count_of(1.0), 0.5);
}

TEST(SizeDistribution, diameters_follow_it)
{
  RandomNumbers random(1);
  std::vector<double> all = sizes_of("uniform 1 2").diameters(100, random);
  EXPECT_FALSE(std::is_sorted(all.begin(), all.end()));
  std::sort(all.begin(), all.end());
  for (int k = 0; k < 100; k++) EXPECT_DOUBLE_EQ(all[k], 1.0 + (k + 0.5) / 100);
}

TEST(RandomNumbers, are_those_of_splitmix64)
{
  RandomNumbers random(0);
  // the first output for the state 0 is e220a8397b1dcdaf
  EXPECT_DOUBLE_EQ(random.uniform(), static_cast<double>(0xe220a8397b1dcU) * 0x1p-52 + 0x1p-53);
}
