// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of convex particles with cylinders and cones from outside: by hand, against meshes
// with the same corners, and forces that are continuous.

#include "body/shape/frustum.h"
#include "convex_bodies.h"
#include "shape/convex/collide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

}    // namespace

TEST(ConvexRound, FaceEdgeAndCornerOnALyingCylinder)
{
  const Frustum log({0, 0, 0}, {0, 1, 0}, 2.0, 2.0, std::numeric_limits<double>::infinity(), false);
  const Frustum stump({0, 0, 0}, {0, 1, 0}, 2.0, 2.0, 0.5, false);
  ShapeContacts contacts;
  for (const double radius : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    // a face on it: two edges cross the line that touches
    const double flat = 2.0 + 0.5 + radius - 0.01;
    ASSERT_TRUE(collide_round(cube, Pose({0, 0.2, flat}, straight), log, contacts));
    ASSERT_EQ(contacts.points.size(), 2U);
    for (const ShapeContact &c : contacts.points) {
      EXPECT_NEAR(c.overlap, 0.01, 1e-12);
      EXPECT_NEAR(c.normal.z, 1.0, 1e-12);
      EXPECT_NEAR(c.position.z, 2.0 - 0.005, 1e-12);
      EXPECT_NEAR(std::fabs(c.position.y - 0.2), 0.5, 1e-12);
    }
    // the cylinder is shorter than the face: two points of its rims
    ASSERT_TRUE(collide_round(cube, Pose({0, 0.1, flat}, straight), stump, contacts));
    EXPECT_NEAR(load_of(contacts).force.z, 0.02, 1e-9);
    // an edge along the axis: two corners; an edge across: one point
    const double edge = 2.0 + std::sqrt(0.5) + radius - 0.01;
    ASSERT_TRUE(
        collide_round(cube, Pose({0, 0, edge}, turned(0.785398163397448, 0, 1, 0)), log, contacts));
    EXPECT_EQ(contacts.points.size(), 2U);
    ASSERT_TRUE(
        collide_round(cube, Pose({0, 0, edge}, turned(0.785398163397448, 1, 0, 0)), log, contacts));
    ASSERT_EQ(contacts.points.size(), 1U);
    EXPECT_NEAR(contacts.points[0].overlap, 0.01, 1e-9);
    EXPECT_FALSE(collide_round(cube, Pose({0, 0.2, flat + 0.02}, straight), log, contacts));
  }
}

TEST(ConvexRound, CapAndTip)
{
  const Frustum column({0, 0, -1}, {0, 0, 1}, 0.3, 0.3, 2.0, false);
  const Frustum spike({0, 0, -1}, {0, 0, 1}, 0.5, 0.0, 2.0, false);
  ShapeContacts contacts;
  for (const double radius : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    const Pose pose({0.1, 0.05, 0.5 + radius - 0.01}, straight);
    ASSERT_TRUE(collide_round(cube, pose, column, contacts));
    EXPECT_EQ(contacts.points.size(), 12U);
    EXPECT_NEAR(load_of(contacts).force.z, 0.12, 1e-12);
    ASSERT_TRUE(collide_round(cube, pose, spike, contacts));
    ASSERT_EQ(contacts.points.size(), 1U);
    EXPECT_NEAR(contacts.points[0].overlap, 0.01, 1e-12);
    // a small cube on a wide column stands on its corners
    const Frustum wide({0, 0, -1}, {0, 0, 1}, 3.0, 3.0, 2.0, false);
    ASSERT_TRUE(collide_round(cube, pose, wide, contacts));
    EXPECT_EQ(contacts.points.size(), 4U);
  }
}

TEST(ConvexRound, ForcesOfRoundedBodiesAreContinuousAlongRandomPaths)
{
  RandomBodies random(75);
  const Frustum bodies[] = {{{0, 0, 0}, {0, 0, 1}, 1.0, 1.0, 2.0, false},
                            {{0, 0, 0}, {0, 0, 1}, 1.0, 0.4, 2.0, false}};
  double largest = 0.0;
  int touching = 0;
  for (int n = 0; n < 40; n++) {
    const Frustum &body = bodies[n % 2];
    const ConvexShape shape = ConvexShape::polyhedron(random.corners(9, {.6, .5, .5}), 0.2);
    const Vector from = 1.7 * random.direction(), way = 0.25 * random.direction();
    const Eigen::Quaterniond q = random.orientation();
    const Eigen::Vector3d axis = to_eigen(random.direction());
    constexpr int steps = 2000;
    Vector before{};
    bool known = false;
    for (int k = 0; k <= steps; k++) {
      const double t = static_cast<double>(k) / steps;
      ShapeContacts contacts;
      collide_round(shape,
                    Pose(from + t * way, Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * t, axis)) * q),
                    body, contacts);
      const bool deep = std::any_of(contacts.points.begin(), contacts.points.end(),
                                    [](const ShapeContact &c) { return c.overlap >= 0.2; });
      const Vector now = load_of(contacts).force;
      if (known && !deep) largest = std::max(largest, length(now - before));
      touching += !contacts.points.empty();
      before = now;
      known = !deep;
    }
  }
  EXPECT_GT(touching, 2000);
  EXPECT_LT(largest, 0.02);
}
