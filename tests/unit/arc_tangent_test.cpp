// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Angles of points against the C library in long double, one at a time and of eight at once.

#include "base/arc_tangent.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

TEST(ArcTangent, OfOneDoesNotDependOnOthers)
{
  RandomSource random(5);
  for (int n = 0; n < 1000; n++) {
    alignas(64) double y[8], x[8], found[8];
    for (int k = 0; k < 8; k++) {
      y[k] = random.uniform(-1.0, 1.0) * random.decade(-6.0, 2.0);
      x[k] = random.uniform(-0.2, 1.0);
    }
    store(found, arc_tangent(load8(y), load8(x)));
    for (int k = 0; k < 8; k++) EXPECT_EQ(found[k], arc_tangent(y[k], x[k]));
  }
}

TEST(ArcTangent, IsThatOfTheLibrary)
{
  RandomSource random(3);
  for (int n = 0; n < 20000; n++) {
    const double size = random.decade(-12.0, 12.0), y = random.uniform(-1.0, 1.0) * size,
                 x = random.uniform(-1.0, 1.0);
    const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    const double found = arc_tangent(y, x);
    EXPECT_LE(std::fabs(found - exact), 7e-16L * std::fabs(exact)) << y << ' ' << x;
    const Vec8 lanes_found = arc_tangent(splat<Vec8>(y), splat<Vec8>(x));
    EXPECT_EQ(lanes_found[5], found);
  }
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
  EXPECT_EQ(arc_tangent(0.0, -1.0), std::acos(-1.0));
}
