// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The elastic energy of sharp bodies that overlap: what it is where it is known, and that forces are its derivatives.

#include "convex_bodies.h"
#include "shape/convex/collide.h"
#include "shape/convex/mean_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Talus;

namespace {

using Vector = Vector3<double>;
constexpr double pi = 3.14159265358979323846;

Eigen::Quaterniond turned(double angle, const Vector &axis)
{
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, to_eigen((1.0 / length(axis)) * axis)));
}

/// Two bodies, and what is between them if the force of a point is overlap^exponent.
struct Couple {
  const ConvexShape &a, &b;
  Vector place_of_a;
  Eigen::Quaterniond turn_of_a;
  Pose pose_of_b;
  double exponent = 1.0;
  SeparatingDirection direction{};
  ShapeContacts contacts{};

  Pose pose_of_a() const { return Pose(place_of_a, turn_of_a); }
  bool touch()
  {
    return collide(a, pose_of_a(), b, pose_of_b, direction, contacts, NarrowPhase::FEATURES,
                   exponent);
  }
  double energy()
  {
    touch();
    double sum = 0.0;
    for (const ShapeContact &c : contacts.points)
      sum += c.energy * std::pow(c.overlap, exponent + 1.0) / (exponent + 1.0);
    return sum;
  }
  /// Of the displacement along and of the turning about an axis of space.
  double slope(int axis, bool turning)
  {
    constexpr double h = 1e-8;
    const Vector e{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
    double value[2];
    for (int side = 0; side < 2; side++) {
      Couple moved = *this;
      const double by = side ? h : -h;
      if (turning)
        moved.turn_of_a = turned(by, e) * turn_of_a;
      else
        moved.place_of_a = place_of_a + by * e;
      value[side] = moved.energy();
    }
    return (value[1] - value[0]) / (2.0 * h);
  }
  /// Of least depth; its kind and parts tell whether two poses have the same one.
  LeastDepth least(double shift) const
  {
    const Pose a_now(place_of_a + Vector{shift, shift, shift}, turn_of_a);
    const CorePair pair{a.core(), b.core(), relative_pose(a_now, pose_of_b)};
    return find_least_depth(pair, {{1.0, 0.0, 0.0}, -1e9});
  }
};

/* b comes nearer along a line until the bodies overlap by `depth`, or a little less. */

void approach(Couple &couple, const Vector &toward, double depth)
{
  double near = 0.0, far = 2.0 * (couple.a.bounding_radius() + couple.b.bounding_radius());
  for (int step = 0; step < 50; step++) {
    const double middle = 0.5 * (near + far);
    couple.pose_of_b.position = middle * toward;
    (couple.touch() ? near : far) = middle;
  }
  couple.pose_of_b.position = (near - depth) * toward;
}

}    // namespace

TEST(ConvexOverlap, CornerEdgeAndFaceOnAFace)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.0),
                    plate = ConvexShape::box({5.0, 5.0, 1.0}, 0.0);
  const double d = 1e-3;
  const Eigen::Quaterniond corner =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, 1));
  for (const double exponent : {1.0, 1.5}) {
    const auto expect = [&](double height, const Eigen::Quaterniond &turn, double power,
                            std::size_t points) {
      Couple couple{cube, plate, {0.3, 0.2, 0.5 + height - d}, turn, Pose(), exponent};
      ASSERT_TRUE(couple.touch());
      const double stiffer = std::pow(15.0, 0.25 * power * (exponent + 1.0));
      EXPECT_NEAR((exponent + 1.0) * couple.energy(), stiffer * std::pow(d, exponent + 1.0),
                  1e-9 * stiffer * std::pow(d, exponent + 1.0));
      double weight = 0.0;
      couple.touch();
      for (const ShapeContact &c : couple.contacts.points) {
        weight += c.weight;
        EXPECT_NEAR(c.overlap, d, 1e-14);
        EXPECT_NEAR(c.normal.z, 1.0, 1e-12);
      }
      EXPECT_NEAR(weight, stiffer, 1e-8);
      EXPECT_EQ(couple.contacts.points.size(), points);
    };
    expect(std::sqrt(0.75), corner, 0.0, 1);
    expect(std::sqrt(0.5), turned(pi / 4, {1.0, 0.0, 0.0}), std::log(3.0) / std::log(15.0), 2);
    expect(0.5, turned(0.3, {0.0, 0.0, 1.0}), 1.0, 4);
  }
}

/* A cube that leans so that nowhere it lifts off is pushed back as by springs at its corners: the mean of
   (d + t x)^4 is d^4 + 6 d^2 t^2/12 + .. over an edge of 1. */

TEST(ConvexOverlap, AFaceThatLeansIsPushedBack)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.0),
                    plate = ConvexShape::box({5.0, 5.0, 1.0}, 0.0);
  const double d = 1e-3, tilt = 2e-4;
  Couple couple{cube, plate, {0.0, 0.0, 1.0 - d}, turned(tilt, {0.0, 1.0, 0.0}), Pose()};
  couple.touch();
  double torque = 0.0;
  for (const ShapeContact &c : couple.contacts.points)
    torque -= c.position.x * c.weight * c.overlap * c.normal.z;
  EXPECT_NEAR(torque / (-std::sqrt(15.0) / 4.0 * tilt), 1.0, 0.02);
}

TEST(ConvexOverlap, ForcesAreDerivativesOfTheEnergy)
{
  RandomBodies random(31);
  Points small = dodecahedron_corners();
  for (Vector &x : small) x = 0.4 * x;
  const std::vector<ConvexShape> shapes{
      ConvexShape::box({1.0, 1.0, 1.0}, 0.0), ConvexShape::box({1.0, 0.6, 0.3}, 0.0),
      ConvexShape::polyhedron(random.corners(14, {0.6, 0.5, 0.4}), 0.0),
      ConvexShape::polyhedron(small, 0.0)};
  int compared = 0, shared = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 2000; trial++) {
    const bool flat = random.chance(0.5);
    Couple couple{shapes[random.below(4)],
                  shapes[random.below(4)],
                  {0.0, 0.0, 0.0},
                  random.orientation(),
                  Pose(),
                  random.chance(0.5) ? 1.0 : 1.5};
    Vector toward = random.direction();
    Eigen::Quaterniond turn_of_b = random.orientation();
    if (flat) {
      turn_of_b = turned(random.decade(-5.0, -1.0), random.direction()) * couple.turn_of_a *
                  turned(random.uniform(0.0, 1.0), {0.0, 0.0, 1.0});
      toward = from_eigen(couple.turn_of_a * Eigen::Vector3d(random.uniform(-0.3, 0.3),
                                                             random.uniform(-0.3, 0.3), 1.0));
    }
    couple.pose_of_b = Pose({0.0, 0.0, 0.0}, turn_of_b);
    approach(couple, toward, 1e-3);
    const LeastDepth least = couple.least(0.0);
    if (!(least.depth > 1e-5) || !couple.touch()) continue;
    // where the direction jumps so do forces
    const LeastDepth low = couple.least(-1e-6), high = couple.least(1e-6);
    if (low.kind != least.kind || high.kind != least.kind || low.of_a != high.of_a ||
        low.of_b != high.of_b)
      continue;
    Vector force{0.0, 0.0, 0.0}, torque{0.0, 0.0, 0.0};
    for (const ShapeContact &c : couple.contacts.points) {
      const Vector f = (c.weight * std::pow(c.overlap, couple.exponent)) * c.normal;
      force = force + f;
      torque = torque + cross(c.position, f);
    }
    const Vector by_place{couple.slope(0, false), couple.slope(1, false), couple.slope(2, false)},
        by_turn{couple.slope(0, true), couple.slope(1, true), couple.slope(2, true)};
    const double size = length(force),
                 error = std::max(length(force + by_place), length(torque + by_turn)) / size;
    compared++;
    shared += couple.contacts.points.size() > 1;
    worst = std::max(worst, error);
    EXPECT_LT(error, 1e-3) << trial;
  }
  std::printf("%d poses, %d with several points: worst deviation %.1e of the force\n", compared,
              shared, worst);
  EXPECT_GT(compared, 1000);
  EXPECT_GT(shared, 300);
}
