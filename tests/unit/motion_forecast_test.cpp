// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The forecast behind the rebuild check of verlet/proxy.

#include "exchange/motion_forecast.h"

#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace Talus;

namespace {

int integer(RandomSource &random, int low, int high)
{
  return low + random.below(high - low + 1);
}

}    // namespace

TEST(MotionForecast, MaximaOfSingleParticles)
{
  // one particle has moved far and rests, one has not moved and is fast
  const std::vector<double> then{0, 0, 0, 5, 5, 5}, x{3, 4, 0, 5, 5, 5}, v{0, 0, 0, 0, 0, -20};
  const MotionForecast f = forecast_motion(2, x.data(), then.data(), v.data(), 0.1);
  EXPECT_DOUBLE_EQ(f.moved, 5.0);
  EXPECT_DOUBLE_EQ(f.step, 2.0);
  EXPECT_TRUE(f.may_leave(8.9, 1));
  EXPECT_FALSE(f.may_leave(9.1, 1));
  EXPECT_TRUE(f.may_leave(24.9, 5));
  EXPECT_FALSE(f.may_leave(25.1, 5));
}

// What is at rest tells nothing of how a force will move it.
TEST(MotionForecast, WhatRestsMayLeaveAtOnce)
{
  const double x[3] = {1.0, 2.0, 3.0}, v[3] = {0.0, 0.0, 0.0};
  for (const int n : {0, 1}) {
    const MotionForecast f = forecast_motion(n, x, x, v, 1.0);
    EXPECT_EQ(f.moved, 0.0);
    EXPECT_TRUE(f.may_leave(0.0, 1));
    EXPECT_TRUE(f.may_leave(9.0, 5));
  }
}

// Particles that collide with each other in any way that keeps to the assumption are never outside
// without a warning one step before.
TEST(MotionForecast, WarnsOneStepAhead)
{
  RandomSource random(11);
  for (int trial = 0; trial < 200; trial++) {
    const int n = 17;
    const double dt = 0.01, limit = 0.05;
    std::vector<double> then(3 * n), v(3 * n);
    for (double &c : then) c = random.uniform(-1.0, 1.0);
    for (double &c : v) c = random.uniform(-1.0, 1.0);
    std::vector<double> x = then;
    for (int step = 0; step < 100; step++) {
      const MotionForecast before = forecast_motion(n, x.data(), then.data(), v.data(), dt);
      // any change of velocity up to the largest speed
      for (int i = 0; i < n; i++) {
        double kick[3];
        for (double &c : kick) c = random.uniform(-1.0, 1.0);
        const double size = std::hypot(kick[0], kick[1], kick[2]);
        const double allowed = 0.999 * before.step / dt;
        for (int d = 0; d < 3; d++)
          v[3 * i + d] += random.uniform(0.0, 1.0) * allowed * kick[d] / size;
      }
      for (int k = 0; k < 3 * n; k++) x[k] += dt * v[k];
      const double moved = forecast_motion(n, x.data(), then.data(), v.data(), dt).moved;
      if (moved > limit) {
        EXPECT_TRUE(before.may_leave(limit, 1));
        break;
      }
      for (double &c : v) c *= 0.7;
    }
  }
}

// A list that is kept serves until the next check: particles at constant velocity are never outside
// in between, and with steps in mind the list is not rebuilt at every check either.
TEST(MotionForecast, SeesAsFarAsTheNextCheck)
{
  for (const int every : {1, 2, 7, 20}) {
    const double dt = 0.01, limit = 1.0;
    double then[3] = {0, 0, 0}, x[3] = {0, 0, 0};
    const double v[3] = {0, 0.6, 0.8};
    int kept = 0;
    for (int step = 1; step < 300; step++) {
      // asked one step before a check
      if (step % every == 0) {
        if (forecast_motion(1, x, then, v, dt).may_leave(limit, every))
          std::copy(x, x + 3, then);
        else
          kept++;
      }
      for (int d = 0; d < 3; d++) x[d] += dt * v[d];
      EXPECT_LE(forecast_motion(1, x, then, v, dt).moved, limit) << "every " << every;
    }
    EXPECT_GT(kept, 0);
  }
}

TEST(MotionForecast, AnyDivisionGivesTheSameMaxima)
{
  RandomSource random(3);
  const int n = 1001;
  std::vector<double> then(3 * n), x(3 * n), v(3 * n);
  for (auto *array : {&then, &x, &v})
    for (double &c : *array) c = random.uniform(-1.0, 1.0);
  const MotionForecast whole = forecast_motion(n, x.data(), then.data(), v.data(), 0.1);
  MotionForecast parts;
  for (int first = 0; first < n;) {
    const int size = std::min(integer(random, 1, 60), n - first);
    const MotionForecast part =
        forecast_motion(size, &x[3 * first], &then[3 * first], &v[3 * first], 0.1);
    parts.moved = std::max(parts.moved, part.moved);
    parts.step = std::max(parts.step, part.step);
    first += size;
  }
  EXPECT_EQ(whole.moved, parts.moved);
  EXPECT_EQ(whole.step, parts.step);
}
