// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Parts of a ball between planes along the axes: caps, wedges and octants known in closed form, and a slow twin that adds up
// discs, whose parts are found by integrating over lines.

#include "fluid/ball_parts.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Talus;

namespace {

constexpr double pi = 3.14159265358979323846, ball = 4.0 / 3.0 * pi, beyond = 2.0;

/// Integral of sqrt(r^2 - x^2) over x = 0 ... a.
double under_circle(double r, double a)
{
  const double x = std::clamp(a, -r, r);
  return 0.5 * (x * std::sqrt(std::max(r * r - x * x, 0.0)) + r * r * std::asin(x / r));
}

/// Area of the disc of radius r where x <= a and y <= b: for each x from -sqrt(r^2 - x^2) to the lower of b and that root.
double disc_below(double r, double a, double b)
{
  const double most = std::clamp(a, -r, r);
  const auto between = [&](double from, double to) {
    return from < to ? under_circle(r, to) - under_circle(r, from) : 0.0;
  };
  const double all = between(-r, most);
  if (b >= r) return 2.0 * all;
  if (b <= -r) return 0.0;
  // |x| < half: b is below the upper root and above the lower one
  const double half = std::sqrt(r * r - b * b), from = -half, to = std::min(half, most);
  const double inner = from < to ? between(from, to) + b * (to - from) : 0.0;
  if (b < 0.0) return inner;
  return inner + 2.0 * (all - between(from, to));
}

/// Gauss-Legendre with two points in many steps, which crowd towards the poles.
double slowly(double a, double b, double c)
{
  constexpr int steps = 20000;
  const double end = std::acos(-std::clamp(c, -1.0, 1.0));    // z = -cos(angle)
  double sum = 0.0;
  for (int k = 0; k < steps; k++)
    for (const double off : {-0.5773502691896258, 0.5773502691896258}) {
      const double angle = end * (k + 0.5 * (1.0 + off)) / steps, r = std::sin(angle);
      sum += 0.5 * end / steps * r * disc_below(r, a, b);
    }
  return sum;
}

}    // namespace

TEST(BallParts, WholeHalfQuarterOctant)
{
  EXPECT_NEAR(ball_below(beyond, beyond, beyond), ball, 1e-15);
  EXPECT_EQ(ball_below(-1.0, beyond, beyond), 0.0);
  EXPECT_NEAR(ball_below(beyond, 0.0, beyond), ball / 2, 1e-15);
  EXPECT_NEAR(ball_below(0.0, 0.0, beyond), ball / 4, 1e-15);
  EXPECT_NEAR(ball_below(0.0, 0.0, 0.0), ball / 8, 1e-15);
  EXPECT_NEAR(ball_below(beyond, beyond, -0.4), pi / 3 * 0.36 * 2.4, 1e-15);    // pi/3 h^2 (3 - h)
}

TEST(BallParts, PartsAddUp)
{
  RandomSource random(3);
  for (int n = 0; n < 2000; n++) {
    const double a = random.uniform(-1.1, 1.1), b = random.uniform(-1.1, 1.1),
                 c = random.uniform(-1.1, 1.1);
    // the eight parts, by mirrors
    double sum = 0.0;
    for (const double x : {a, -a})
      for (const double y : {b, -b})
        for (const double z : {c, -c}) {
          const double part = ball_below(x, y, z);
          EXPECT_GE(part, -1e-15);
          sum += part;
        }
    EXPECT_NEAR(sum, ball, 2e-15 * ball);
    EXPECT_NEAR(ball_below(a, b, c), ball_below(c, a, b), 2e-15);
  }
}

TEST(BallParts, AsASumOfDiscs)
{
  RandomSource random(4);
  for (int n = 0; n < 60; n++) {
    const double a = random.uniform(-1.0, 1.0), b = random.uniform(-1.0, 1.0),
                 c = random.uniform(-1.0, 1.0);
    EXPECT_NEAR(ball_below(a, b, c), slowly(a, b, c), 1e-7);
    EXPECT_NEAR(ball_below(a, b, beyond), slowly(a, b, beyond), 1e-7);
  }
}
