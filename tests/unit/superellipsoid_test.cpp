// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The shape alone: mass and inertia against quadrature and closed formulas, points with a normal against a search
// of the surface, curvature against differences, bounds, the surface of pictures, messages.

#include "base/power.h"
#include "convex_bodies.h"
#include "shape/superellipsoid/superellipsoid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace Talus;

namespace {

using Vector = Vector3<double>;
constexpr double pi = 3.14159265358979323846;

const std::vector<Superellipsoid> &all_kinds()
{
  static const std::vector<Superellipsoid> shapes = {
      {{1.0, 1.0, 1.0}, 2.0, 2.0},   {{1.0, 0.8, 0.5}, 2.0, 2.0}, {{1.0, 0.1, 0.1}, 2.0, 2.0},
      {{0.7, 0.9, 0.4}, 4.0, 4.0},   {{0.5, 0.5, 1.0}, 8.0, 2.0}, {{0.5, 0.6, 0.3}, 2.0, 5.0},
      {{0.3, 0.3, 0.3}, 12.0, 12.0}, {{1.0, 0.4, 0.2}, 2.5, 3.3}, {{0.4, 0.7, 1.0}, 20.0, 20.0}};
  return shapes;
}

/* ---- powers ----------------------------------------------------------------------------------- */

TEST(Power, against_long_double)
{
  RandomSource random(1);
  for (int k = 0; k < 100000; k++) {
    const double x = std::pow(10.0, random.uniform(-12.0, 2.0)), e = random.uniform(0.05, 12.0);
    const auto expected =
        static_cast<double>(std::pow(static_cast<long double>(x), static_cast<long double>(e)));
    ASSERT_NEAR(Power(e)(x) / expected, 1.0, 4.0e-16 * (1.0 + std::abs(e * std::log(x))))
        << x << "^" << e;
  }
  for (const double e : {0.25, 0.5, 1.0, 1.5, 2.0, 2.75, 7.0, 12.0})    // by products and roots
    EXPECT_NEAR(Power(e)(1.7) / std::pow(1.7, e), 1.0, 3.0e-15) << e;
  EXPECT_EQ(Power(0.3)(0.0), 0.0);
  EXPECT_EQ(Power(3.7)(1.0), 1.0);
  EXPECT_EQ(Power(5.3)(1.0e-200), 0.0);
}

TEST(Power, of_eight_numbers_has_the_same_bits)
{
  RandomSource random(7);
  for (int k = 0; k < 10000; k++) {
    const Power power(k % 3 ? random.uniform(0.05, 12.0) : 0.25 * (1 + random.below(40)));
    alignas(64) double x[lanes], y[lanes];
    for (double &one : x)
      one = random.chance(0.1) ? 0.0 : std::pow(10.0, random.uniform(-120.0, 2.0));
    store(y, power(load8(x)));
    for (int n = 0; n < lanes; n++) ASSERT_EQ(power(x[n]), y[n]) << x[n];
  }
}

/* ---- mass ------------------------------------------------------------------------------------- */

/// Gauss-Legendre in x and y and the exact height of z, on [0, 1] after x = s (2 - s), which takes away the root
/// at the end.
Eigen::Vector4d integrals(const Superellipsoid &shape)
{
  constexpr int count = 400;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();    // 1, x^2, y^2, z^2
  const Vector h = shape.half_axes();
  const auto node = [](int k,
                       double &weight) {    // smooth at both ends: midpoints of s^2 (3 - 2 s)
    const double s = (k + 0.5) / count;
    weight = 30.0 * s * s * (1.0 - s) * (1.0 - s) / count;
    return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  };
  for (int i = 0; i < count; i++) {
    double wx, wy;
    const double x = node(i, wx), top = std::pow(1.0 - std::pow(x, shape.n2()), 1.0 / shape.n2());
    for (int j = 0; j < count; j++) {
      const double y = top * node(j, wy);
      const double rho =
          std::pow(std::pow(x, shape.n2()) + std::pow(y, shape.n2()), shape.n1() / shape.n2());
      const double z = std::pow(std::max(1.0 - rho, 0.0), 1.0 / shape.n1());
      const double w = 8.0 * wx * wy * top * z;
      sum += w * Eigen::Vector4d(1.0, x * x, y * y, z * z / 3.0);
    }
  }
  return h.x * h.y * h.z * sum.cwiseProduct(Eigen::Vector4d(1.0, h.x * h.x, h.y * h.y, h.z * h.z));
}

TEST(Superellipsoid, mass_and_inertia_against_quadrature)
{
  for (const Superellipsoid &shape : all_kinds()) {
    const Eigen::Vector4d expected = integrals(shape);
    EXPECT_NEAR(shape.volume() / expected[0], 1.0, 1.0e-6);
    const Eigen::Vector3d moments = shape.principal_moments();
    EXPECT_NEAR(moments[0] / (expected[2] + expected[3]), 1.0, 1.0e-6);
    EXPECT_NEAR(moments[1] / (expected[1] + expected[3]), 1.0, 1.0e-6);
    EXPECT_NEAR(moments[2] / (expected[1] + expected[2]), 1.0, 1.0e-6);
  }
}

TEST(Superellipsoid, mass_and_inertia_of_an_ellipsoid)
{
  const Superellipsoid shape({1.2, 0.7, 0.4}, 2.0, 2.0);
  const double volume = 4.0 / 3.0 * pi * 1.2 * 0.7 * 0.4;
  EXPECT_NEAR(shape.volume() / volume, 1.0, 1.0e-14);
  EXPECT_NEAR(shape.principal_moments()[0] / (0.2 * volume * (0.49 + 0.16)), 1.0, 1.0e-14);
  EXPECT_NEAR(shape.principal_moments()[1] / (0.2 * volume * (1.44 + 0.16)), 1.0, 1.0e-14);
  EXPECT_NEAR(shape.principal_moments()[2] / (0.2 * volume * (1.44 + 0.49)), 1.0, 1.0e-14);
}

/* ---- the surface ------------------------------------------------------------------------------ */

TEST(Superellipsoid, points_are_on_the_surface_and_highest_along_their_normal)
{
  RandomBodies random(2);
  for (const Superellipsoid &shape : all_kinds())
    for (int k = 0; k < 200; k++) {
      const Vector n = random.direction();
      const Superellipsoid::Point p = shape.at_normal(n);
      EXPECT_NEAR(shape.gauge(p.place), 1.0, 1.0e-13);
      EXPECT_NEAR(dot(p.place, n), p.height, 1.0e-13);
      for (int q = 0; q < 50; q++)
        EXPECT_LE(dot(n, shape.on_ray(random.direction()).place), p.height * (1.0 + 1.0e-13));
    }
}

TEST(Superellipsoid, both_ways_to_a_point_agree)
{
  RandomBodies random(3);
  for (const Superellipsoid &shape : all_kinds())
    for (int k = 0; k < 300; k++) {
      const Superellipsoid::Point by_normal = shape.at_normal(random.direction()),
                                  by_place = shape.on_ray(by_normal.place);
      EXPECT_LT(length(by_place.normal - by_normal.normal), 1.0e-11);
      EXPECT_NEAR(by_place.height, by_normal.height, 1.0e-12);
      const double most = std::abs(by_normal.xx) + std::abs(by_normal.yy) + std::abs(by_normal.zz);
      EXPECT_NEAR(by_place.xx, by_normal.xx, 1.0e-9 * most);
      EXPECT_NEAR(by_place.yy, by_normal.yy, 1.0e-9 * most);
      EXPECT_NEAR(by_place.zz, by_normal.zz, 1.0e-9 * most);
      EXPECT_NEAR(by_place.xy, by_normal.xy, 1.0e-9 * most);
    }
}

TEST(Superellipsoid, curvature_is_the_turn_of_the_normal)
{
  RandomBodies random(4);
  for (const Superellipsoid &shape : all_kinds())
    for (int k = 0; k < 200; k++) {
      const Superellipsoid::Point p = shape.on_ray(random.direction());
      const Vector any = random.direction();
      Vector t = any - dot(any, p.normal) * p.normal;
      t = (1.0 / length(t)) * t;
      const Vector u = cross(p.normal, t);
      const double step = 1.0e-6 * shape.inscribed_radius();
      const Superellipsoid::Point before = shape.on_ray(p.place - step * t),
                                  after = shape.on_ray(p.place + step * t);
      const Vector moved = after.place - before.place, turned = after.normal - before.normal;
      const double scale = 1.0 / (dot(moved, t));
      const double most = std::max(p.curvature(t, t), p.curvature(u, u));
      EXPECT_NEAR(scale * dot(turned, t), p.curvature(t, t), 2.0e-4 * most);
      EXPECT_NEAR(scale * dot(turned, u), p.curvature(t, u), 2.0e-4 * most);
    }
}

TEST(Superellipsoid, curvature_at_the_poles_of_an_ellipsoid)
{
  const double a = 1.0, b = 0.6, c = 0.3;
  const Superellipsoid mean({a, b, c}, 2.0, 2.0),
      gaussian({a, b, c}, 2.0, 2.0, SurfaceRadius::GAUSSIAN),
      volume({a, b, c}, 2.0, 2.0, SurfaceRadius::VOLUME);
  const auto at = [](const Superellipsoid &shape, const Vector &n) {
    return shape.curvature_for_laws(shape.at_normal(n));
  };
  EXPECT_NEAR(at(mean, {0, 0, 1}), 0.5 * (c / (a * a) + c / (b * b)), 1.0e-14);
  EXPECT_NEAR(at(mean, {1, 0, 0}), 0.5 * (a / (b * b) + a / (c * c)), 1.0e-13);
  EXPECT_NEAR(at(gaussian, {0, 0, -1}), c / (a * b), 1.0e-14);
  EXPECT_NEAR(at(gaussian, {0, 1, 0}), b / (a * c), 1.0e-14);
  EXPECT_NEAR(at(volume, {0, 1, 0}), 1.0 / std::cbrt(a * b * c), 1.0e-14);
  EXPECT_NEAR(mean.contact_radius(), 1.0 / at(mean, {1, 0, 0}), 1.0e-13);
  // flat places of box-like ones
  const Superellipsoid flat({a, b, c}, 6.0, 6.0);
  EXPECT_NEAR(at(flat, {0, 0, 1}), 0.1 / flat.bounding_radius(), 1.0e-14);
}

TEST(Superellipsoid, bounds)
{
  RandomBodies random(5);
  for (const Superellipsoid &shape : all_kinds()) {
    double farthest = 0.0, nearest = 1.0e9;
    for (int k = 0; k < 20000; k++) {
      const double r = length(shape.on_ray(random.direction()).place);
      farthest = std::max(farthest, r);
      nearest = std::min(nearest, r);
    }
    EXPECT_LE(farthest, shape.bounding_radius() * (1.0 + 1.0e-13));
    EXPECT_GT(farthest, 0.98 * shape.bounding_radius());
    EXPECT_GE(nearest, shape.inscribed_radius() * (1.0 - 1.0e-13));
    EXPECT_LT(nearest, 1.02 * shape.inscribed_radius());
  }
}

TEST(Superellipsoid, surface_of_pictures_is_closed_and_faces_outward)
{
  for (const Superellipsoid &shape : all_kinds()) {
    double volume = 0.0;
    Vector area{0.0, 0.0, 0.0};
    for (const Triangle &t : shape.surface(40)) {
      const Vector n = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
      area = area + 0.5 * n;
      volume += dot(n, t.corner[0]) / 6.0;
      EXPECT_GE(dot(n, t.corner[0] + t.corner[1] + t.corner[2]), 0.0);
    }
    EXPECT_LT(length(area), 1.0e-12);
    EXPECT_LE(volume, shape.volume() * (1.0 + 1.0e-12));
    EXPECT_GT(volume, 0.985 * shape.volume());
  }
}

TEST(Superellipsoid, refuses)
{
  const auto text = [](const Vector &half, double n1, double n2) -> std::string {
    try {
      const Superellipsoid shape(half, n1, n2);
    } catch (const std::runtime_error &problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_NE(text({1, 1, 0}, 2, 2).find("half axes"), std::string::npos);
  EXPECT_EQ(text({1, 1, 1}, 1.5, 2),
            "the exponent n1 is 1.5 and must be between 2 (round) and 20 (nearly a box)");
  EXPECT_NE(text({1, 1, 1}, 2, 21).find("exponent n2 is 21"), std::string::npos);
  EXPECT_NE(text({1, 1, 1}, 2, std::nan("")).find("exponent n2"), std::string::npos);
  EXPECT_EQ(text({1, 2, 3}, 2, 20), "");
}

}    // namespace
