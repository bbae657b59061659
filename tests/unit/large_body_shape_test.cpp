// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Plane and rectangle against closed forms and against a search for the nearest point.

#include "body/shape/plane.h"
#include "body/shape/rectangle.h"
#include "packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

using namespace Talus;
using slow::axpy, slow::norm, slow::plain, slow::talus, slow::Vector;

namespace {

/// A shape together with the axes it was made from: points are given in these (first, second,
/// normal).
struct Placed {
  Vector origin, first, second, normal;
  double half[2];    ///< of the rectangle
  std::unique_ptr<LargeBodyShape> shape;

  Vector point(double a, double b, double h) const
  {
    return axpy(a, first, axpy(b, second, axpy(h, normal, origin)));
  }
};

Placed placed(RandomSource &random, bool rectangle, bool two_sided)
{
  Placed p;
  p.origin = random.in_cube(5.0);
  p.normal = random.unit_vector();
  const Vector other = random.unit_vector();
  p.first = axpy(-slow::inner(other, p.normal), p.normal, other);
  const double length = norm(p.first);
  for (double &c : p.first) c /= length;
  p.second = slow::outer(p.normal, p.first);
  for (double &h : p.half) h = random.uniform(0.5, 3.0);
  if (rectangle)
    p.shape = std::make_unique<Rectangle>(talus(p.origin), talus(p.normal), talus(p.first),
                                          2.0 * p.half[0], 2.0 * p.half[1], two_sided);
  else
    p.shape = std::make_unique<Plane>(talus(p.origin), talus(p.normal), two_sided);
  return p;
}

/// Nearest point of the rectangle: a grid of samples, refined around the best one again and again.
Vector nearest_sample(const Placed &p, const Vector &x)
{
  constexpr int n = 12;
  double center[2] = {0.0, 0.0}, reach[2] = {p.half[0], p.half[1]};
  for (int zoom = 0; zoom < 24; zoom++) {
    double best[2] = {0.0, 0.0}, least = 1e300;
    for (int i = -n; i <= n; i++)
      for (int j = -n; j <= n; j++) {
        const double a = std::clamp(center[0] + reach[0] * i / n, -p.half[0], p.half[0]);
        const double b = std::clamp(center[1] + reach[1] * j / n, -p.half[1], p.half[1]);
        const double distance = norm(axpy(-1.0, p.point(a, b, 0.0), x));
        if (distance >= least) continue;
        least = distance;
        best[0] = a;
        best[1] = b;
      }
    for (int d = 0; d < 2; d++) {
      center[d] = best[d];
      reach[d] *= 0.25;
    }
  }
  return p.point(center[0], center[1], 0.0);
}

TEST(Plane, AgreesWithItsEquation)
{
  RandomSource random(1);
  for (bool two_sided : {false, true})
    for (int n = 0; n < 5000; n++) {
      const Placed p = placed(random, false, two_sided);
      const double height = random.uniform(-2.0, 2.0), radius = random.uniform(0.1, 1.5);
      const Vector x = p.point(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), height);
      ASSERT_NEAR(p.shape->distance_bound(talus(x)), std::fabs(height), 1e-13);
      SurfaceContact c;
      // one-sided it acts on centers up to one radius behind it, too
      ASSERT_EQ(p.shape->touches(talus(x), radius, c), std::fabs(height) < radius);
      if (std::fabs(height) >= radius) continue;
      const double side = two_sided && height < 0.0 ? -1.0 : 1.0;
      ASSERT_NEAR(c.overlap, radius - side * height, 1e-13);
      for (int d = 0; d < 3; d++) ASSERT_EQ(plain(c.normal)[d], side * p.normal[d]);
    }
}

/// Eight spheres around the shape, some of which just reach it or have their center in it.
EightSpheres spheres_around(const Placed &p, RandomSource &random)
{
  EightSpheres spheres{};
  for (int k = 0; k < EightSpheres::width; k++) {
    const double radius = random.uniform(0.1, 1.5);
    const double heights[] = {radius, -radius, 0.0, random.uniform(-2.0, 2.0)};
    const Vector x =
        p.point(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), heights[random.below(4)]);
    for (int d = 0; d < 3; d++) spheres.center[d][k] = x[d];
    spheres.radius[k] = radius;
  }
  return spheres;
}

TEST(LargeBodyShape, EightAtATimeHaveTheBitsOfOne)
{
  RandomSource random(11);
  int touching = 0;
  for (int n = 0; n < 4000; n++) {
    const Placed p = placed(random, n % 4 == 0, n % 3 == 0);
    const EightSpheres spheres = spheres_around(p, random);
    const int count = 1 + random.below(8);
    EightContacts contacts{};
    const unsigned bits = p.shape->touches_eight(spheres, count, contacts);
    ASSERT_EQ(bits >> count, 0U);
    for (int k = 0; k < count; k++) {
      SurfaceContact c;
      const auto &x = spheres.center;
      const bool expected = p.shape->touches({x[0][k], x[1][k], x[2][k]}, spheres.radius[k], c);
      ASSERT_EQ(bits >> k & 1U, expected ? 1U : 0U);
      if (!expected) continue;
      touching++;
      ASSERT_EQ(contacts.overlap[k], c.overlap);
      for (int d = 0; d < 3; d++) ASSERT_EQ(contacts.normal[d][k], plain(c.normal)[d]);
    }
  }
  EXPECT_GT(touching, 3000);
}

TEST(Plane, ReferencePointIsItsPoint)
{
  const Plane plane({1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}, false);
  EXPECT_EQ(plain(plane.reference_point()), (Vector{1.0, 2.0, 3.0}));
  const Rectangle rectangle({1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, 4.0, 2.0, false);
  EXPECT_EQ(plain(rectangle.reference_point()), (Vector{1.0, 2.0, 3.0}));
}

TEST(Rectangle, FaceEdgeAndCornerHaveClosedForms)
{
  // half lengths 2 along x and 1 along y
  const Rectangle r({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, 4.0, 2.0, true);
  SurfaceContact c;
  ASSERT_TRUE(r.touches({1.9, -0.9, 0.75}, 1.0, c));    // face
  EXPECT_EQ(plain(c.normal), (Vector{0.0, 0.0, 1.0}));
  EXPECT_EQ(c.overlap, 0.25);
  ASSERT_TRUE(r.touches({2.3, 0.5, 0.4}, 1.0, c));    // edge
  EXPECT_NEAR(c.overlap, 0.5, 1e-15);
  EXPECT_NEAR(c.normal.x, 0.6, 1e-15);
  EXPECT_EQ(c.normal.y, 0.0);
  EXPECT_NEAR(c.normal.z, 0.8, 1e-15);
  ASSERT_TRUE(r.touches({-2.1, -1.2, -0.2}, 1.0, c));    // corner, from below
  EXPECT_NEAR(c.overlap, 0.7, 1e-15);
  EXPECT_NEAR(c.normal.x, -1.0 / 3.0, 1e-15);
  EXPECT_NEAR(c.normal.y, -2.0 / 3.0, 1e-15);
  EXPECT_NEAR(c.normal.z, -2.0 / 3.0, 1e-15);
  ASSERT_TRUE(r.touches({1.0, 0.5, 0.0}, 1.0, c));    // center in the face
  EXPECT_EQ(plain(c.normal), (Vector{0.0, 0.0, 1.0}));
  EXPECT_EQ(c.overlap, 1.0);
  EXPECT_FALSE(r.touches({3.0, 0.0, 0.0}, 1.0, c));    // just reaches the edge
  EXPECT_FALSE(r.touches({0.0, 0.0, -1.0}, 1.0, c));
}

TEST(Rectangle, AgreesWithTheNearestOfManySamples)
{
  RandomSource random(2);
  int touching = 0, behind = 0;
  for (int n = 0; n < 1000; n++) {
    const bool two_sided = n % 2 == 0;
    const Placed p = placed(random, true, two_sided);
    const double radius = random.uniform(0.1, 1.5), height = random.uniform(-1.5, 1.5);
    const Vector x = p.point(1.6 * p.half[0] * random.uniform(-1.0, 1.0),
                             1.6 * p.half[1] * random.uniform(-1.0, 1.0), height);
    const Vector away = axpy(-1.0, nearest_sample(p, x), x);
    const double distance = norm(away);
    ASSERT_NEAR(p.shape->distance_bound(talus(x)), distance, 1e-12);
    const bool expected = distance < radius && (two_sided || height >= 0.0);
    SurfaceContact c;
    ASSERT_EQ(p.shape->touches(talus(x), radius, c), expected);
    behind += distance < radius && !expected;
    if (!expected) continue;
    touching++;
    ASSERT_NEAR(c.overlap, radius - distance, 1e-12);
    ASSERT_NEAR(norm(plain(c.normal)), 1.0, 1e-14);
    for (int d = 0; d < 3; d++)    // the search finds the place only to the root of its precision
      ASSERT_NEAR(plain(c.normal)[d], away[d] / distance, 1e-6 / distance);
  }
  EXPECT_GT(touching, 200);
  EXPECT_GT(behind, 50);
}

/// Walks along a path in steps of `step` and demands that nothing jumps: at the distance D from a
/// convex body the normal turns by step/D at most, and the overlap changes by step at most.
void expect_smooth(const Placed &p, double step, int steps,
                   const std::function<Vector(double)> &path)
{
  SurfaceContact before, now;
  constexpr double radius = 1.0;
  ASSERT_TRUE(p.shape->touches(talus(path(0.0)), radius, before));
  for (int n = 1; n <= steps; n++) {
    const Vector x = path(n * step);
    ASSERT_TRUE(p.shape->touches(talus(x), radius, now));
    const double turn = norm(axpy(-1.0, plain(before.normal), plain(now.normal)));
    const double distance = radius - std::max(before.overlap, now.overlap);
    ASSERT_LE(turn, 1.001 * step / distance + 1e-12) << n;
    ASSERT_LE(std::fabs(now.overlap - before.overlap), 1.001 * step + 1e-12) << n;
    before = now;
  }
}

TEST(Rectangle, NormalAndOverlapAreContinuousAcrossEdgesAndCorners)
{
  RandomSource random(3);
  for (bool two_sided : {false, true})
    for (int n = 0; n < 20; n++) {
      const Placed p = placed(random, true, two_sided);
      const double a = p.half[0], b = p.half[1], height = random.uniform(0.2, 0.7);
      const double along = random.uniform(-0.9, 0.9);
      const auto across_first = [&](double s) { return p.point(a - 0.3 + s, along * b, height); };
      const auto across_second = [&](double s) { return p.point(along * a, 0.3 - b - s, height); };
      const auto past_corner = [&](double s) {
        return p.point(a + 0.2 - 0.6 * s, b - 0.25 + 0.8 * s, height);
      };
      for (const double step : {1e-3, 1e-5}) {
        const int steps = step > 1e-4 ? 500 : 50000;
        expect_smooth(p, step, steps, across_first);
        expect_smooth(p, step, steps, across_second);
        expect_smooth(p, step, steps, past_corner);
      }
    }
}

TEST(Rectangle, TwoSidedIsTheSameFromBothSides)
{
  RandomSource random(4);
  for (int n = 0; n < 2000; n++) {
    const Placed p = placed(random, true, true);
    const double a = random.uniform(-4.0, 4.0), b = random.uniform(-4.0, 4.0);
    const double height = random.uniform(0.01, 1.0), radius = random.uniform(0.5, 2.0);
    SurfaceContact above, below;
    const bool touching = p.shape->touches(talus(p.point(a, b, height)), radius, above);
    ASSERT_EQ(p.shape->touches(talus(p.point(a, b, -height)), radius, below), touching);
    if (!touching) continue;
    ASSERT_NEAR(above.overlap, below.overlap, 1e-13);
    const Vector up = plain(above.normal), down = plain(below.normal);
    ASSERT_NEAR(slow::inner(up, p.normal), -slow::inner(down, p.normal), 1e-12);
    ASSERT_NEAR(slow::inner(up, p.first), slow::inner(down, p.first), 1e-12);
  }
}

// The broad phase leaves out a sphere whose bound is not below its radius: it must never touch.
TEST(LargeBodyShape, DistanceBoundNeverExceedsTheTouchingDistance)
{
  RandomSource random(5);
  int touching = 0;
  for (int n = 0; n < 40000; n++) {
    const Placed p = placed(random, n % 4 < 2, n % 2 == 0);
    const Vector x = p.point(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0),
                             random.chance(0.1) ? 0.0 : random.uniform(-2.0, 2.0));
    const double bound = p.shape->distance_bound(talus(x));
    for (double radius : {random.uniform(0.1, 2.0), bound, std::nextafter(bound, 0.0)}) {
      SurfaceContact c;
      if (radius <= 0.0 || !p.shape->touches(talus(x), radius, c)) continue;
      touching++;
      ASSERT_LT(bound, radius);
    }
  }
  EXPECT_GT(touching, 5000);
}

}    // namespace
