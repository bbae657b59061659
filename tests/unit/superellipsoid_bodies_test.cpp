// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of superellipsoids with convex bodies, cylinders, cones, planes, the inside of bodies, and meshes: against
// a slow search of all directions, each other, and answers by hand.

#include "all_directions.h"
#include "body/shape/ball.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "convex_bodies.h"
#include "shape/contact/shape_list.h"
#include "shape/mesh_features.h"
#include "shape/superellipsoid/superellipsoid.h"
#include "shape/surface.h"
#include "touched_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

bool touch(const Superellipsoid &a, const Pose &pose, const Geometry &b, const Pose &pose_b,
           ShapeContacts &contacts)
{
  const Collisions::Collision collision = collisions_of_shapes().find(a, b);
  EXPECT_TRUE(static_cast<bool>(collision));
  return collision(a, pose, b, pose_b, {}, contacts);
}

const std::vector<Superellipsoid> &particles()
{
  static const std::vector<Superellipsoid> shapes = {
      {{0.5, 0.4, 0.25}, 2.0, 2.0}, {{0.6, 0.2, 0.2}, 2.0, 2.0}, {{0.5, 0.5, 0.2}, 2.0, 2.0},
      {{0.4, 0.3, 0.35}, 4.0, 4.0}, {{0.3, 0.3, 0.4}, 6.0, 2.0}, {{0.4, 0.3, 0.3}, 3.0, 5.0}};
  return shapes;
}

/// A pose for which the shape touches a body with this height along directions, a random one of which becomes that of
/// the contact, and reaches so far into it.
template <class Height>
Pose placed(const Superellipsoid &shape, Height height, double overlap, RandomBodies &random)
{
  Pose pose({0.0, 0.0, 0.0}, random.orientation());
  const Vector m = random.direction();    // from the body to the shape
  const Vector lowest = pose.direction_in_space(shape.at_normal(-pose.direction_in_body(m)).place);
  pose.position = height(m).place - lowest - overlap * m +
                  0.01 * shape.inscribed_radius() * cross(m, random.direction());
  return pose;
}

struct Highest {
  double height;
  Vector place;
};

/// Compares with the least overlap over all directions; shallow contacts must agree.
template <class Height>
void compare(const Geometry &body, const Pose &pose_b, Height height, RandomBodies &random,
             int count, double depth = 0.03)
{
  ShapeContacts contacts;
  int touching = 0, apart = 0;
  for (int k = 0; k < count; k++) {
    const Superellipsoid &a = particles()[k % particles().size()];
    const Pose pose =
        placed(a, height, a.inscribed_radius() * random.uniform(-depth, depth), random);
    const double expected = least_of_all_directions([&](const Vector &m) {
      return a.at_normal(pose.direction_in_body(m)).height + height(m).height -
             dot(m, pose.position);
    });
    const bool touches = touch(a, pose, body, pose_b, contacts);
    // at edges the search of all directions is slow to converge
    if (std::abs(expected) < 1.0e-3 * a.inscribed_radius()) continue;
    ASSERT_EQ(touches, expected > 0.0) << k << ": " << expected;
    if (expected < 0.0) {
      apart++;
      continue;
    }
    touching++;
    ASSERT_EQ(contacts.points.size(), 1U);
    const ShapeContact &c = contacts.points.front();
    ASSERT_LT(c.overlap, expected + 1.0e-7 * a.inscribed_radius()) << k;
    ASSERT_NEAR(length(c.normal), 1.0, 1.0e-13);
    // it is that along its own normal, so none is less
    ASSERT_NEAR(a.at_normal(pose.direction_in_body(c.normal)).height + height(c.normal).height -
                    dot(c.normal, pose.position),
                c.overlap, 1.0e-9)
        << k;
    ASSERT_LT(a.gauge(pose.point_in_body(c.position)), 1.0) << k;
    ASSERT_GT(c.curvature[0], 0.0);
  }
  EXPECT_GT(touching, count / 5);
  EXPECT_GT(apart, count / 5);
}

/* ---- convex bodies ---------------------------------------------------------------------------- */

TEST(SuperellipsoidBodies, convex_bodies)
{
  RandomBodies random(21);
  const std::vector<ConvexShape> bodies = {
      ConvexShape::box({1.0, 0.7, 0.4}, 0.0), ConvexShape::box({0.5, 0.5, 0.5}, 0.1),
      ConvexShape::polyhedron(dodecahedron_corners(), 0.0),
      ConvexShape::polyhedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.05)};
  for (const ConvexShape &body : bodies) {
    const Pose pose({0.3, -0.2, 0.5}, random.orientation());
    compare(
        body, pose,
        [&](const Vector &m) {
          Highest best{-1.0e9, {}};
          for (int v = 0; v < body.core().num_vertices(); v++) {
            const Vector x = pose.point_in_space(body.core().vertex(v)) + body.radius() * m;
            if (dot(m, x) > best.height) best = {dot(m, x), x};
          }
          return best;
        },
        random, 240);
  }
}

/* ---- cylinders and cones from outside --------------------------------------------------------- */

TEST(SuperellipsoidBodies, cylinders_and_cones_from_outside)
{
  RandomBodies random(22);
  struct Radii {
    double low, high, size;
  };
  for (const Radii &r :
       {Radii{0.4, 0.4, 1.0}, Radii{0.8, 0.3, 0.6}, Radii{0.6, 0.0, 1.0}, Radii{0.1, 0.1, 2.0}}) {
    const Vector center{0.1, 0.2, -0.3}, axis = random.direction();
    const Frustum body(center, axis, r.low, r.high, r.size, false);
    RoundSurface surface;
    surface.body = &body;
    compare(
        surface, Pose(),
        [&](const Vector &m) {
          Highest best{-1.0e9, {}};
          for (const double side : {-1.0, 1.0}) {
            const double radius = side < 0.0 ? r.low : r.high;
            Vector away = m - dot(m, axis) * axis;
            away = (1.0 / std::max(length(away), 1.0e-300)) * away;
            const Vector x = center + (0.5 * side * r.size) * axis + radius * away;
            if (dot(m, x) > best.height) best = {dot(m, x), x};
          }
          return best;
        },
        random, 240);
  }
}

TEST(SuperellipsoidBodies, endless_cylinder)
{
  const Frustum body({0, 0, 0}, {0, 0, 1}, 0.7, 0.7, std::numeric_limits<double>::infinity(),
                     false);
  RoundSurface surface;
  surface.body = &body;
  const Superellipsoid egg({0.3, 0.2, 0.4}, 2.0, 2.0);
  ShapeContacts contacts;
  ASSERT_TRUE(touch(egg, Pose({0.0, 0.89, 5.0}, Eigen::Quaterniond::Identity()), surface, Pose(),
                    contacts));
  ASSERT_EQ(contacts.points.size(), 1U);
  EXPECT_NEAR(contacts.points[0].overlap, 0.01, 1e-14);
  EXPECT_NEAR(contacts.points[0].normal.y, 1.0, 1e-14);
  EXPECT_NEAR(contacts.points[0].position.y, 0.695, 1e-14);
  EXPECT_NEAR(contacts.points[0].position.z, 5.0, 1e-9);
  EXPECT_FALSE(touch(egg, Pose({0.0, 0.91, 5.0}, Eigen::Quaterniond::Identity()), surface, Pose(),
                     contacts));
}

/* ---- planes and spheres ----------------------------------------------------------------------- */

TEST(SuperellipsoidBodies, planes)
{
  RandomBodies random(23);
  FlatSurface plane;
  plane.two_sided = false;
  plane.part = 3;
  ShapeContacts contacts;
  for (int k = 0; k < 300; k++) {
    const Superellipsoid &a = particles()[k % particles().size()];
    plane.normal = random.direction();
    plane.offset = random.uniform(-1.0, 1.0);
    Pose pose({0.0, 0.0, 0.0}, random.orientation());
    const double reach = a.at_normal(-pose.direction_in_body(plane.normal)).height;
    pose.position = (plane.offset + reach - 0.004) * plane.normal;
    ASSERT_TRUE(touch(a, pose, plane, Pose(), contacts));
    const ShapeContact &c = contacts.points.front();
    EXPECT_NEAR(c.overlap, 0.004, 1e-14);
    EXPECT_EQ(c.part, 3);
    EXPECT_NEAR(dot(c.position, plane.normal), plane.offset - 0.002, 1e-14);
    EXPECT_LT(length(c.normal - plane.normal), 1e-15);
    pose.position = (plane.offset + reach + 1e-9) * plane.normal;
    EXPECT_FALSE(touch(a, pose, plane, Pose(), contacts));
  }
}

TEST(SuperellipsoidBodies, spheres_are_balls_of_any_size)
{
  RandomBodies random(24);
  for (const double radius : {0.05, 0.3, 2.0}) {
    Sphere sphere;
    sphere.radius = radius;
    Pose pose_b;
    pose_b.position = {0.1, 0.2, 0.3};
    compare(
        sphere, pose_b,
        [&](const Vector &m) {
          const Vector x = pose_b.position + radius * m;
          return Highest{dot(m, x), x};
        },
        random, 120);
  }
}

/* ---- from inside ------------------------------------------------------------------------------ */

/// The least distance of the surface of the shape from walls.
template <class Depth> double outermost(const Superellipsoid &a, const Pose &pose, Depth distance)
{
  return least_of_all_directions(
      [&](const Vector &n) { return distance(pose.point_in_space(a.at_normal(n).place)); });
}

TEST(SuperellipsoidBodies, inside_of_drums_cones_and_balls)
{
  RandomBodies random(25);
  const Frustum drum({0, 0, 0}, {0, 0, 1}, 2.0, 2.0, 3.0, true),
      cone({0, 0, 0}, {0, 0, 1}, 1.0, 2.5, 3.0, true);
  const double tilt = std::atan2(1.5, 3.0);
  const Ball ball({0, 0, 0}, 2.0, true);
  const auto radial = [](const Vector &x) { return std::hypot(x.x, x.y); };
  struct Wall {
    const LargeBodyShape *body;
    std::function<double(const Vector &)> distance;
    std::function<Vector(double, double)> place;
  };
  const Wall walls[] = {
      {&drum, [&](const Vector &x) { return 2.0 - radial(x); },
       [](double angle, double r) {
         return Vector{(2.0 - r) * std::cos(angle), (2.0 - r) * std::sin(angle), 0.2};
       }},
      {&cone, [&](const Vector &x) { return (1.75 + 0.5 * x.z - radial(x)) * std::cos(tilt); },
       [tilt](double angle, double r) {
         const double rho = 1.75 - r / std::cos(tilt);
         return Vector{rho * std::cos(angle), rho * std::sin(angle), 0.0};
       }},
      {&ball, [&](const Vector &x) { return 2.0 - length(x); },
       [](double angle, double r) {
         return Vector{(2.0 - r) * std::cos(angle), 0.0, (2.0 - r) * std::sin(angle)};
       }}};
  ShapeContacts contacts;
  for (const Wall &wall : walls) {
    const VesselSurface vessel = inside_of(*wall.body);
    int touching = 0;
    for (int k = 0; k < 240; k++) {
      const Superellipsoid &a = particles()[k % particles().size()];
      Pose pose({0.0, 0.0, 0.0}, random.orientation());
      const double angle = random.uniform(0.0, 6.28);
      // touching, then moved by some of its size
      pose.position = wall.place(angle, a.bounding_radius());
      const double gap = outermost(a, pose, wall.distance);
      pose.position =
          wall.place(angle, a.bounding_radius() - gap - 0.02 * random.uniform(-1.0, 2.0));
      const double expected = -outermost(a, pose, wall.distance);
      ASSERT_EQ(touch(a, pose, vessel, Pose(), contacts), expected > 0.0) << k << " " << expected;
      if (!(expected > 0.0)) continue;
      touching++;
      double deepest = 0.0;
      for (const ShapeContact &c : contacts.points) deepest = std::max(deepest, c.overlap);
      ASSERT_NEAR(deepest, expected, 1.0e-7) << k;
      if (a.n1() == 2.0 && a.n2() == 2.0) {
        ASSERT_EQ(contacts.points.size(), 1U) << "walls are flatter than ellipsoids";
      }
    }
    EXPECT_GT(touching, 80);
  }
}

TEST(SuperellipsoidBodies, a_needle_across_a_pipe_touches_with_both_ends)
{
  const Frustum pipe({0, 0, 0}, {0, 0, 1}, 1.0, 1.0, 9.0, true);
  const VesselSurface vessel = inside_of(pipe);
  const Superellipsoid needle({0.95, 0.1, 0.1}, 2.0, 2.0);
  ShapeContacts contacts;
  // off the axis by d: the ends are at the wall where d^2 + .95^2 = 1
  ASSERT_TRUE(touch(needle, Pose({0.0, 0.35, 0.0}, Eigen::Quaterniond::Identity()), vessel, Pose(),
                    contacts));
  ASSERT_EQ(contacts.points.size(), 2U);
  EXPECT_NE(contacts.points[0].name, contacts.points[1].name);
  EXPECT_NEAR(contacts.points[0].overlap, contacts.points[1].overlap, 1e-12);
  EXPECT_GT(contacts.points[0].overlap, std::hypot(0.95, 0.35) - 1.0);
  EXPECT_NEAR(contacts.points[0].position.x, -contacts.points[1].position.x, 1e-9);
  // against a cap it has one
  ASSERT_TRUE(touch(needle, Pose({0.0, 0.0, 4.45}, Eigen::Quaterniond::Identity()), vessel, Pose(),
                    contacts));
  ASSERT_EQ(contacts.points.size(), 1U);
  EXPECT_NEAR(contacts.points[0].overlap, 0.05, 1e-12);
}

/* ---- meshes ----------------------------------------------------------------------------------- */

MeshSurface mesh_of(const std::vector<Triangle> &triangles, MeshSide side)
{
  MeshSurface mesh;
  auto shape = std::make_shared<MeshShape>(TriangleMesh(triangles, false), side);
  mesh.features = std::make_shared<const MeshFeatures>(shape->surface());
  mesh.shape = std::move(shape);
  return mesh;
}

TEST(SuperellipsoidBodies, a_mesh_of_a_box_is_the_box)
{
  RandomBodies random(26);
  const ConvexShape box = ConvexShape::box({1.2, 0.9, 0.7}, 0.0);
  const MeshSurface mesh = mesh_of(box.surface(1), MeshSide::NORMALS);
  const Pose pose_b = box.given_frame();
  ShapeContacts of_box, of_mesh;
  int touching = 0;
  for (int k = 0; k < 2000; k++) {
    const Superellipsoid &a = particles()[k % particles().size()];
    const auto height = [&](const Vector &m) {
      Highest best{-1.0e9, {}};
      for (int v = 0; v < 8; v++) {
        const Vector x = pose_b.point_in_space(box.core().vertex(v));
        if (dot(m, x) > best.height) best = {dot(m, x), x};
      }
      return best;
    };
    const Pose pose = placed(a, height, a.inscribed_radius() * random.uniform(-0.01, 0.04), random);
    const bool touches = touch(a, pose, box, pose_b, of_box);
    ASSERT_EQ(touch(a, pose, mesh, Pose(), of_mesh), touches) << k;
    if (!touches) continue;
    touching++;
    ASSERT_EQ(of_mesh.points.size(), 1U) << k;
    EXPECT_NEAR(of_mesh.points[0].overlap, of_box.points[0].overlap, 1.0e-12) << k;
    EXPECT_LT(length(of_mesh.points[0].normal - of_box.points[0].normal), 1.0e-6) << k;
    EXPECT_LT(length(of_mesh.points[0].position - of_box.points[0].position), 1.0e-6) << k;
  }
  EXPECT_GT(touching, 800);
}

TEST(SuperellipsoidBodies, a_floor_of_triangles_is_a_plane)
{
  RandomBodies random(27);
  std::vector<Triangle> triangles;
  constexpr int cells = 8;
  const auto at = [](int i, int j) { return Vector{0.5 * i - 2.0, 0.5 * j - 2.0, 0.0}; };
  for (int i = 0; i < cells; i++)
    for (int j = 0; j < cells; j++) {
      triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  const MeshSurface mesh = mesh_of(triangles, MeshSide::NORMALS);
  ShapeContacts contacts;
  for (int k = 0; k < 1000; k++) {
    const Superellipsoid &a = particles()[k % particles().size()];
    Pose pose({random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), 0.0}, random.orientation());
    if (k % 5 == 0)
      pose = Pose({0.0, 0.5, 0.0}, Eigen::Quaterniond::Identity());    // over a vertex
    pose.position.z = a.at_normal(-pose.direction_in_body({0, 0, 1})).height - 0.005;
    ASSERT_TRUE(touch(a, pose, mesh, Pose(), contacts)) << k;
    ASSERT_EQ(contacts.points.size(), 1U) << k;
    EXPECT_NEAR(contacts.points[0].overlap, 0.005, 1.0e-14);
    EXPECT_NEAR(contacts.points[0].normal.z, 1.0, 1.0e-15);
    EXPECT_NEAR(contacts.points[0].position.z, -0.0025, 1.0e-14);
  }
}

TEST(SuperellipsoidBodies, the_edge_and_corner_of_a_plate)
{
  const MeshSurface plate =
      mesh_of({{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}}, {{{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}},
              MeshSide::BOTH);
  const Superellipsoid egg({0.3, 0.4, 0.5}, 2.0, 2.0);
  const Eigen::Quaterniond straight = Eigen::Quaterniond::Identity();
  ShapeContacts contacts;
  ASSERT_TRUE(touch(egg, Pose({1.29, 0.3, 1.0e-9}, straight), plate, Pose(), contacts));
  ASSERT_EQ(contacts.points.size(), 1U);
  EXPECT_NEAR(contacts.points[0].overlap, 0.01, 1e-8);
  EXPECT_NEAR(contacts.points[0].normal.x, 1.0, 1e-8);
  ASSERT_TRUE(touch(egg, Pose({1.19, 1.29, 1.0e-9}, straight), plate, Pose(), contacts));
  ASSERT_EQ(contacts.points.size(), 1U);
  EXPECT_EQ(parts_of(contacts.points[0].name), ContactParts::VERTEX_OF_B);
  EXPECT_GT(contacts.points[0].normal.x, 0.3);
  EXPECT_GT(contacts.points[0].normal.y, 0.3);
  ASSERT_TRUE(touch(egg, Pose({0.2, 0.3, -0.49}, straight), plate, Pose(), contacts));
  ASSERT_EQ(contacts.points.size(), 1U);
  EXPECT_NEAR(contacts.points[0].normal.z, -1.0, 1e-14);
}

}    // namespace
