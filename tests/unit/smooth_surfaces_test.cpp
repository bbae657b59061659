// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids on flat surfaces and meshes of all kinds: at any overlap the contact is that with a plane, or with the
// convex body, and none is lost.

#include "touched_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

/// Deepest of all overlaps: of the size, from rounding to the half of it, where the center is in the surface.
double any_overlap(double height, RandomBodies &random)
{
  return random.chance(0.5) ? height * random.uniform(0.001, 0.99)
                            : height * random.decade(-12.0, -1.0);
}

/* ---- flat surfaces ---------------------------------------------------------------------------- */

/// What is flat at z = 0, near the origin.
std::vector<Touched> floors()
{
  std::vector<Triangle> tiles;
  for (int i = -8; i < 8; i++)
    for (int j = -8; j < 8; j++) {
      const Vector a{0.4 * i, 0.4 * j, 0}, b{0.4 * i + 0.4, 0.4 * j, 0},
          c{0.4 * i + 0.4, 0.4 * j + 0.4, 0}, d{0.4 * i, 0.4 * j + 0.4, 0};
      tiles.push_back({{a, b, d}});
      tiles.push_back({{b, c, d}});
    }
  return {mesh("two triangles", two_triangles(3.0)),
          mesh("both sides", two_triangles(3.0), MeshSide::BOTH),
          mesh("tiles", tiles),
          mesh("slivers", slivers()),
          box({0.1, -0.2, -4.0}, {20.0, 18.0, 8.0}),
          mesh("box of triangles", ConvexShape::box({20.0, 18.0, 8.0}, 0.0).surface(1)),
          frustum(9.0, 9.0, -4.0, 8.0),
          frustum(12.0, 9.0, -4.0, 8.0),
          vessel("cylinder from inside",
                 std::make_shared<Frustum>(Vector{0, 0, 4}, Vector{0, 0, 1}, 9.0, 9.0, 8.0, true)),
          vessel("cone from inside",
                 std::make_shared<Frustum>(Vector{0, 0, 4}, Vector{0, 0, 1}, 9.0, 7.0, 8.0, true))};
}

TEST(SmoothSurfaces, flat_ones_are_planes_at_any_overlap)
{
  for (const Touched &floor : floors()) {
    RandomBodies random(31);
    const double top = floor.name == "box of triangles" ? 4.0 : 0.0;    // its origin is the center
    ShapeContacts contacts;
    for (int k = 0; k < 1800; k++) {
      const Superellipsoid &a = particles()[k % particles().size()];
      Pose pose({random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), 0.0}, random.orientation());
      if (k % 7 == 0)
        pose = Pose({0.0, 0.25, 0.0}, Eigen::Quaterniond::Identity());    // over a vertex
      const Superellipsoid::Point lowest = a.at_normal(-pose.direction_in_body({0, 0, 1}));
      pose.position.z = top + lowest.height - any_overlap(lowest.height, random);
      const double overlap = lowest.height - (pose.position.z - top);
      ASSERT_TRUE(floor.touch(a, pose, contacts)) << floor.name << ", " << k << ": " << overlap;
      ASSERT_EQ(contacts.points.size(), 1U) << floor.name << ", " << k << ": " << overlap;
      const ShapeContact &one = contacts.points.front();
      ASSERT_NEAR(one.overlap, overlap, 1.0e-14) << floor.name << ", " << k;
      ASSERT_NEAR(one.normal.z, 1.0, 1.0e-14) << floor.name << ", " << k;
      const Vector place = pose.point_in_space(lowest.place);
      ASSERT_LT(length(one.position - (place + Vector{0, 0, 0.5 * overlap})), 1.0e-12)
          << floor.name << ", " << k;
      pose.position.z = top + lowest.height * (1.0 + 1.0e-12);
      ASSERT_FALSE(floor.touch(a, pose, contacts)) << floor.name << ", " << k;
    }
  }
}

/* Turned and far away coordinates have rounding errors of their own: an overlap is as it was but for them. */

TEST(SmoothSurfaces, flat_ones_are_planes_wherever_they_are)
{
  RandomBodies random(38);
  ShapeContacts contacts;
  for (int k = 0; k < 60; k++) {
    const Pose there(random.uniform(0.0, 100.0) * random.direction(), random.orientation());
    std::vector<Triangle> moved = k % 2 ? slivers() : two_triangles(3.0);
    for (Triangle &one : moved)
      for (Vector &corner : one.corner) corner = there.point_in_space(corner);
    const Touched floor = mesh("floor", moved);
    const double rounding = 4.0e-15 * (length(there.position) + 4.0);
    const Vector up = there.direction_in_space({0, 0, 1});
    for (int n = 0; n < 50; n++) {
      const Superellipsoid &a = particles()[n % particles().size()];
      Pose pose({0, 0, 0}, random.orientation());
      const double height = a.at_normal(-pose.direction_in_body(up)).height,
                   overlap = std::max(any_overlap(height, random), 2.0 * rounding);
      pose.position = there.point_in_space(
          {random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), height - overlap});
      ASSERT_TRUE(floor.touch(a, pose, contacts)) << k << ": " << overlap;
      ASSERT_EQ(contacts.points.size(), 1U) << k << ": " << overlap;
      ASSERT_NEAR(contacts.points.front().overlap, overlap, rounding) << k;
    }
  }
}

TEST(SmoothSurfaces, what_is_beside_or_behind_a_plate_does_not_touch_it)
{
  const Touched plate = mesh("plate", two_triangles(1.0));
  const Superellipsoid needle({0.5, 0.025, 0.025}, 2.0, 2.0);
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(-pi / 4.0, Eigen::Vector3d::UnitY()));
  ShapeContacts contacts;
  // its lower end is below the plate, its center beside it
  EXPECT_FALSE(plate.touch(needle, Pose({1.25, 0.1, 0.1}, tilted), contacts));
  EXPECT_FALSE(plate.touch(needle, Pose({1.15, 0.1, 0.05}, tilted), contacts));
  // through the edge, and through the plate
  EXPECT_TRUE(plate.touch(needle, Pose({1.11, 0.1, 0.1}, tilted), contacts));
  ASSERT_TRUE(plate.touch(needle, Pose({0.95, 0.1, 0.1}, tilted), contacts));
  EXPECT_NEAR(contacts.points.front().normal.z, 1.0, 1.0e-14);
}

/* ---- convex meshes ---------------------------------------------------------------------------- */

/* The one takes the least overlap of all faces, edges and corners of a convex body, the other what triangles tell. */

TEST(SmoothSurfaces, a_convex_mesh_is_the_convex_body_at_any_overlap)
{
  RandomBodies random(39);
  ShapeContacts of_solid, of_mesh;
  for (int body = 0; body < 12; body++) {
    const ConvexShape hull =
        body < 2    ? ConvexShape::box({1.2, 0.9, body ? 0.1 : 0.7}, 0.0)
        : body == 2 ? ConvexShape::polyhedron(dodecahedron_corners(), 0.0)
                    : ConvexShape::polyhedron(random.corners(12, {1.0, 0.9, 0.8}), 0.0);
    const Touched triangles = mesh("mesh", hull.surface(1)),
                  solid{"solid", std::make_shared<ConvexShape>(hull)};
    for (int k = 0; k < 90; k++) {
      const Superellipsoid &a = particles()[k % particles().size()];
      const Vector way = random.direction();
      Pose pose({0, 0, 0}, random.orientation());
      const auto at = [&](double distance) {
        pose.position = distance * way + Vector{0.1, 0.05, 0.02};
        return pose;
      };
      double in = 0.0, out = 3.0;
      for (int step = 0; step < 50; step++) {
        const double middle = 0.5 * (in + out);
        (solid.touch(a, at(middle), of_solid) ? in : out) = middle;
      }
      at(in - a.inscribed_radius() * random.decade(-11.0, -0.3));
      ASSERT_TRUE(solid.touch(a, pose, of_solid)) << body << ", " << k;
      ASSERT_TRUE(triangles.touch(a, pose, of_mesh)) << body << ", " << k;
      ASSERT_EQ(of_mesh.points.size(), 1U) << body << ", " << k;
      const double expected = of_solid.points.front().overlap;
      ASSERT_NEAR(of_mesh.points.front().overlap, expected, 1.0e-13 + 1.0e-7 * expected)
          << body << ", " << k;
    }
  }
}

/* ---- drums of facets -------------------------------------------------------------------------- */

TEST(SmoothSurfaces, in_a_drum_of_facets_the_deepest_counts)
{
  constexpr int facets = 48;
  const Touched wall = mesh("drum", drum(facets, 3.0, 4.0));
  RandomBodies random(32);
  ShapeContacts contacts;
  for (int k = 0; k < 1000; k++) {
    const Superellipsoid &a =
        particles()[k % 6];    // of the others flat sides reach several facets
    if (a.half_axes().z < 0.1) continue;
    const double angle = random.uniform(0.0, 2.0 * pi);
    Pose pose({std::cos(angle), std::sin(angle), random.uniform(-0.5, 0.5)}, random.orientation());
    const Vector out{pose.position.x, pose.position.y, 0.0};
    const auto deepest = [&](double distance) {
      double most = -1.0e9;
      for (int f = 0; f < facets; f++) {
        const double middle = 2.0 * pi * (f + 0.5) / facets;
        const Vector n{std::cos(middle), std::sin(middle), 0.0};
        const Vector at = distance * out;
        most = std::max(most, a.at_normal(pose.direction_in_body(n)).height + dot(n, at) -
                                  3.0 * std::cos(pi / facets));
      }
      return most;
    };
    double low = 1.0, high = 3.0;    // where it touches
    for (int step = 0; step < 60; step++)
      (deepest(0.5 * (low + high)) > 0.0 ? high : low) = 0.5 * (low + high);
    const double distance = low + random.decade(-12.0, -2.0);
    const double expected = deepest(distance);
    pose.position.x = distance * out.x;
    pose.position.y = distance * out.y;
    if (expected < 1.0e-13) continue;
    ASSERT_TRUE(wall.touch(a, pose, contacts)) << k << ": " << expected;
    ASSERT_EQ(contacts.points.size(), 1U) << k << ": " << expected;
    ASSERT_NEAR(contacts.points.front().overlap, expected, 4.0e-15) << k;
  }
}

/* ---- terrain ---------------------------------------------------------------------------------- */

/// The least gauge of a point of these triangles, of an ellipsoid: in units of its half axes the distance from the center.
double least_gauge(const Superellipsoid &a, const Pose &pose,
                   const std::vector<Triangle> &triangles)
{
  const Vector half = a.half_axes();
  double least = 1.0e9;
  for (const Triangle &one : triangles) {
    Vector corner[3];
    for (int k = 0; k < 3; k++) {
      const Vector own = pose.point_in_body(one.corner[k]);
      corner[k] = {own.x / half.x, own.y / half.y, own.z / half.z};
    }
    const Vector n = cross(corner[1] - corner[0], corner[2] - corner[0]),
                 foot = dot(n, corner[0]) / dot(n, n) * n;
    bool is_over = true;
    for (int k = 0; k < 3; k++) {
      const Vector from = corner[k], edge = corner[(k + 1) % 3] - from;
      is_over &= dot(cross(edge, foot - from), n) >= 0.0;
      const double part = std::clamp(-dot(from, edge) / dot(edge, edge), 0.0, 1.0);
      least = std::min(least, length(from + part * edge));
    }
    if (is_over) least = std::min(least, length(foot));
  }
  return least;
}

/* Ridges, valleys, and corners where both meet. */

TEST(SmoothSurfaces, no_contact_with_a_terrain_is_lost)
{
  RandomBodies random(40);
  ShapeContacts contacts;
  int touching = 0;
  for (int terrain = 0; terrain < 9; terrain++) {
    constexpr int cells = 8;
    const double rough = terrain % 3 == 0 ? 0.3 : terrain % 3 == 1 ? 0.05 : 0.6;
    double height[cells + 1][cells + 1];
    for (auto &row : height)
      for (double &z : row) z = rough * random.uniform(-1.0, 1.0);
    const auto at = [&](int i, int j) {
      return Vector{0.5 * i - 2.0, 0.5 * j - 2.0, height[i][j]};
    };
    std::vector<Triangle> triangles;
    for (int i = 0; i < cells; i++)
      for (int j = 0; j < cells; j++) {
        triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
        triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
    const Touched surface = mesh("terrain", triangles);
    for (int k = 0; k < 120; k++) {
      const Superellipsoid &a = particles()[k % 4];
      Pose pose({random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 0.0}, random.orientation());
      double in = -2.0, out = 3.0;
      for (int step = 0; step < 60; step++) {
        pose.position.z = 0.5 * (in + out);
        (least_gauge(a, pose, triangles) < 1.0 ? in : out) = pose.position.z;
      }
      pose.position.z = in - a.inscribed_radius() * random.decade(-11.0, -0.3);
      if (least_gauge(a, pose, triangles) >= 1.0) continue;    // it is below
      touching++;
      ASSERT_TRUE(surface.touch(a, pose, contacts)) << terrain << ", " << k;
    }
  }
  EXPECT_GT(touching, 300);
}

TEST(SmoothSurfaces, nearly_a_box_at_the_edge_of_a_mesh_counts_once)
{
  const Superellipsoid block({0.35, 0.3, 0.25}, 20.0, 20.0);
  const Touched triangles = mesh("mesh", ConvexShape::box({1.2, 0.9, 0.7}, 0.0).surface(1)),
                solid = box({0, 0, 0}, {1.2, 0.9, 0.7});
  RandomBodies random(36);
  ShapeContacts of_mesh, of_box;
  for (int k = 0; k < 1000; k++) {
    const double angle = random.decade(-16.0, -0.5);
    Pose pose({random.uniform(0.3, 0.9), random.uniform(-0.4, 0.4), 0.0},
              Eigen::Quaterniond(Eigen::AngleAxisd(angle, to_eigen(random.direction()))));
    pose.position.z = 0.35 + block.at_normal(-pose.direction_in_body({0, 0, 1})).height -
                      0.25 * random.decade(-9.0, -1.0);
    const bool touches = solid.touch(block, pose, of_box);
    ASSERT_EQ(triangles.touch(block, pose, of_mesh), touches) << k;
    if (!touches) continue;
    ASSERT_EQ(of_mesh.points.size(), 1U) << k;
    ASSERT_NEAR(of_mesh.points[0].overlap, of_box.points[0].overlap, 4.0e-14) << k;
  }
}

}    // namespace
