// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids on all kinds of surfaces: at any overlap the contact with a flat one is that with a plane, each place
// that is touched counts once, forces are minus the gradient of the energy, and histories stay with their places.

#include "body/shape/ball.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "convex_bodies.h"
#include "shape/mesh_features.h"
#include "shape/superellipsoid/superellipsoid.h"
#include "shape/surface.h"
#include "shaped/point_contact.h"
#include "shaped/shape_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

using namespace Talus;

namespace {

using Vector = Vector3<double>;
constexpr double pi = 3.14159265358979323846;

const std::vector<Superellipsoid> &particles()
{
  static const std::vector<Superellipsoid> shapes = {
      {{0.5, 0.35, 0.2}, 2.0, 2.0},    {{0.5, 0.5, 0.5}, 2.0, 2.0},
      {{0.5, 0.025, 0.025}, 2.0, 2.0}, {{0.5, 0.5, 0.05}, 2.0, 2.0},
      {{0.4, 0.3, 0.35}, 4.0, 4.0},    {{0.3, 0.3, 0.4}, 6.0, 2.0},
      {{0.35, 0.3, 0.25}, 20.0, 20.0}, {{0.4, 0.4, 0.04}, 20.0, 2.0},
      {{0.4, 0.3, 0.3}, 2.5, 8.0}};
  return shapes;
}

/// A surface that shapes touch, and what keeps it alive.
struct Touched {
  std::string name;
  std::shared_ptr<const Geometry> geometry;
  Pose pose{};
  std::shared_ptr<const LargeBodyShape> body{};

  bool touch(const Superellipsoid &a, const Pose &at, ShapeContacts &contacts) const
  {
    return collisions_of_shapes().find(a, *geometry)(a, at, *geometry, pose, {}, contacts);
  }
};

Touched box(const Vector &center, const Vector &edges)
{
  const auto shape = std::make_shared<ConvexShape>(ConvexShape::box(edges, 0.0));
  Pose pose = shape->given_frame();
  pose.position = pose.position + center;
  return {"box", shape, pose};
}
Touched frustum(double low, double high, double middle, double size)
{
  const auto body =
      std::make_shared<Frustum>(Vector{0, 0, middle}, Vector{0, 0, 1}, low, high, size, false);
  RoundSurface round;
  round.body = body.get();
  return {low == high ? "cylinder" : "cone", std::make_shared<RoundSurface>(round), {}, body};
}
Touched vessel(const std::string &name, std::shared_ptr<const LargeBodyShape> body)
{
  VesselSurface inside;
  inside.body = body.get();
  return {name, std::make_shared<VesselSurface>(inside), {}, body};
}
Touched mesh(const std::string &name, const std::vector<Triangle> &triangles,
             MeshSide side = MeshSide::NORMALS)
{
  MeshSurface surface;
  const auto shape = std::make_shared<MeshShape>(TriangleMesh(triangles, false), side);
  surface.features = std::make_shared<const MeshFeatures>(shape->surface());
  surface.shape = shape;
  return {name, std::make_shared<MeshSurface>(surface), {}, shape};
}

std::vector<Triangle> two_triangles(double half)
{
  const Vector a{-half, -half, 0}, b{half, -half, 0}, c{half, half, 0}, d{-half, half, 0};
  return {{{a, b, c}}, {{a, c, d}}};
}
/// Strips of very different widths, cut by diagonals.
std::vector<Triangle> slivers()
{
  std::vector<Triangle> triangles;
  const std::vector<double> x = {-4.0, -1.0, -0.999, -0.1, 0.0, 1.0e-4,
                                 0.01, 0.5,  0.5001, 1.7,  4.0},
                            y = {-4.0, -0.3, -0.2999, 0.25, 0.2501, 1.1, 4.0};
  for (std::size_t i = 1; i < x.size(); i++)
    for (std::size_t j = 1; j < y.size(); j++) {
      const Vector a{x[i - 1], y[j - 1], 0}, b{x[i], y[j - 1], 0}, c{x[i], y[j], 0},
          d{x[i - 1], y[j], 0};
      triangles.push_back({{a, b, c}});
      triangles.push_back({{a, c, d}});
    }
  return triangles;
}
/// The inside of a drum along z, of facets.
std::vector<Triangle> drum(int facets, double radius, double half)
{
  std::vector<Triangle> triangles;
  const auto at = [&](int k, double z) {
    return Vector{radius * std::cos(2.0 * pi * k / facets),
                  radius * std::sin(2.0 * pi * k / facets), z};
  };
  for (int k = 0; k < facets; k++) {
    triangles.push_back({{at(k, -half), at(k, half), at(k + 1, half)}});
    triangles.push_back({{at(k, -half), at(k + 1, half), at(k + 1, -half)}});
  }
  return triangles;
}

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

/* ---- walls that are curved inward ------------------------------------------------------------- */

TEST(SmoothSurfaces, a_place_counts_once_where_curvatures_are_close)
{
  const Superellipsoid lens({0.5, 0.5, 0.2}, 2.0, 2.0);    // of radius 1.25 where it is flat
  const Eigen::Quaterniond flat(Eigen::AngleAxisd(0.5 * pi, Eigen::Vector3d::UnitY()));
  RandomBodies random(33);
  ShapeContacts contacts;
  const double overlap = 1.0e-3;
  for (int k = 0; k <= 300; k++) {
    const double radius = 1.2 + 0.0005 * k, z = random.uniform(-1.0, 1.0);
    // as seen from the axis, the lowest point of the shape is behind the wall
    const bool is_flatter = radius + overlap > 1.25;
    if (std::abs(radius + overlap - 1.25) < 1.0e-4) continue;
    const Touched drum = vessel("drum", std::make_shared<Frustum>(Vector{0, 0, 0}, Vector{0, 0, 1},
                                                                  radius, radius, 4.0, true)),
                  ball = vessel("ball", std::make_shared<Ball>(Vector{0, 0, 0}, radius, true));
    for (const double turn : {0.0, random.uniform(0.0, 0.003)}) {
      const Eigen::Quaterniond turned = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * flat;
      ASSERT_TRUE(drum.touch(lens, Pose({radius - 0.2 + overlap, 0.0, z}, turned), contacts));
      // turned, one of two places is deeper
      if (is_flatter || turn == 0.0) {
        ASSERT_EQ(contacts.points.size(), is_flatter ? 1U : 2U) << radius << " " << turn;
      }
      if (turn == 0.0 && is_flatter) {
        ASSERT_NEAR(contacts.points.front().overlap, overlap, 1.0e-15);
      }
      if (turn == 0.0 && !is_flatter) {
        ASSERT_NEAR(contacts.points[0].overlap, contacts.points[1].overlap, 1.0e-14) << radius;
        ASSERT_GT(contacts.points[0].overlap, overlap);
        ASSERT_NE(contacts.points[0].name, contacts.points[1].name);
      }
    }
    if (is_flatter) {
      ASSERT_TRUE(ball.touch(lens, Pose({radius - 0.2 + overlap, 0.0, 0.0}, flat), contacts));
      ASSERT_EQ(contacts.points.size(), 1U) << radius;
      ASSERT_NEAR(contacts.points.front().overlap, overlap, 1.0e-14);
    }
  }
}

/// Around the axis: overlaps of the places where the shape is nearest to a cylinder or cone, by brute force, ascending.
std::vector<double> places_around(const Superellipsoid &a, const Pose &pose, double radius,
                                  double slope, int samples)
{
  const double tilt = std::atan(slope);
  const auto behind = [&](double angle) {
    const Vector m{std::cos(tilt) * std::cos(angle), std::cos(tilt) * std::sin(angle),
                   -std::sin(tilt)};
    return a.at_normal(pose.direction_in_body(m)).height + dot(m, pose.position) -
           radius * std::cos(tilt);
  };
  std::vector<double> all(samples), found;
  for (int k = 0; k < samples; k++) all[k] = behind(2.0 * pi * k / samples);
  for (int k = 0; k < samples; k++) {
    if (all[k] < all[(k + 1) % samples] || all[k] <= all[(k + samples - 1) % samples]) continue;
    double low = 2.0 * pi * (k - 1) / samples, high = 2.0 * pi * (k + 1) / samples;
    for (int step = 0; step < 80; step++) {
      const double one = low + 0.382 * (high - low), other = high - 0.382 * (high - low);
      (behind(one) < behind(other) ? low : high) = behind(one) < behind(other) ? one : other;
    }
    found.push_back(behind(0.5 * (low + high)));
  }
  found.erase(std::remove_if(found.begin(), found.end(), [](double one) { return one <= 0.0; }),
              found.end());
  std::sort(found.begin(), found.end());
  return found;
}

TEST(SmoothSurfaces, curved_inward_each_place_is_found)
{
  RandomBodies random(34);
  ShapeContacts contacts;
  int several = 0;
  for (int k = 0; k < 360; k++) {
    const Superellipsoid &a = particles()[k % particles().size()];
    const double radius = random.uniform(0.7, 4.0), slope = k % 2 ? 0.0 : random.uniform(-0.4, 0.4);
    const Touched wall =
        vessel(slope == 0.0 ? "drum" : "cone",
               std::make_shared<Frustum>(Vector{0, 0, 0}, Vector{0, 0, 1}, radius - slope * radius,
                                         radius + slope * radius, 2.0 * radius, true));
    Pose pose({0.0, 0.0, random.uniform(-0.1, 0.1)}, random.orientation());
    if (k % 3 == 0)    // a flat side at the wall
      pose = Pose(pose.position,
                  Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * pi + random.uniform(-0.02, 0.02),
                                                       Eigen::Vector3d::UnitY())));
    // moved until it touches
    const double angle = k % 3 ? random.uniform(0.0, 2.0 * pi) : 0.0;
    double low = 0.0, high = 2.0 * radius;
    const auto at = [&](double distance) {
      Pose moved = pose;
      moved.position.x = distance * std::cos(angle);
      moved.position.y = distance * std::sin(angle);
      return moved;
    };
    const auto behind = [&](double distance) {
      return places_around(a, at(distance), radius, slope, 60);
    };
    if (!behind(0.0).empty()) continue;    // does not fit
    for (int step = 0; step < 45; step++)
      (behind(0.5 * (low + high)).empty() ? low : high) = 0.5 * (low + high);
    pose = at(low + a.inscribed_radius() * random.decade(-9.0, -1.0));
    const std::vector<double> expected = places_around(a, pose, radius, slope, 5000);
    if (expected.empty() || expected.back() < 1.0e-13) continue;
    ASSERT_TRUE(wall.touch(a, pose, contacts)) << k << ": " << expected.back();
    std::vector<double> found;
    for (const ShapeContact &one : contacts.points)
      if (one.part == 0) found.push_back(one.overlap);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), expected.size()) << wall.name << ", " << k << ": " << expected.back();
    for (std::size_t n = 0; n < found.size(); n++)
      ASSERT_NEAR(found[n], expected[n], 2.0e-14 * radius) << wall.name << ", " << k;
    several += found.size() > 1;
  }
  EXPECT_GT(several, 10);
}

/* ---- energy ----------------------------------------------------------------------------------- */

struct Acting {
  double energy = 0.0;
  Vector force{0, 0, 0}, torque{0, 0, 0};
  std::size_t count = 0;
};

/// Of a linear law of stiffness 1.
Acting acting(const Touched &surface, const Superellipsoid &a, const Pose &pose)
{
  ShapeContacts contacts;
  Acting all;
  surface.touch(a, pose, contacts);
  for (const ShapeContact &one : contacts.points) {
    all.energy += 0.5 * one.overlap * one.overlap;
    const Vector force = one.overlap * one.normal;
    all.force = all.force + force;
    all.torque = all.torque + cross(one.position - pose.position, force);
    all.count++;
  }
  return all;
}

TEST(SmoothSurfaces, forces_are_minus_the_gradient_of_the_energy)
{
  const std::vector<Touched> surfaces = {
      box({0, 0, 0}, {1.2, 0.9, 0.7}),
      mesh("box of triangles", ConvexShape::box({1.2, 0.9, 0.7}, 0.0).surface(1)),
      mesh("plate", two_triangles(0.6), MeshSide::BOTH),
      frustum(0.5, 0.5, 0.0, 0.8),
      frustum(0.7, 0.3, 0.0, 0.8),
      vessel("cylinder from inside",
             std::make_shared<Frustum>(Vector{0, 0, 0}, Vector{0, 0, 1}, 1.0, 1.0, 2.0, true)),
      vessel("ball from inside", std::make_shared<Ball>(Vector{0, 0, 0}, 1.0, true))};
  for (const Touched &surface : surfaces) {
    RandomBodies random(35);
    int compared = 0, differ = 0;
    for (int k = 0; k < 500; k++) {
      const Superellipsoid &a = particles()[k % 6];
      const Vector way = random.direction();
      Pose pose({0, 0, 0}, random.orientation());
      const double deep = a.inscribed_radius() * random.decade(-3.0, -0.7);
      // outward, or inward, until it is so deep
      const bool is_inside = surface.name.find("inside") != std::string::npos;
      double in = is_inside ? 2.0 : 0.05, out = is_inside ? 0.0 : 3.0;
      const auto at = [&](double distance) {
        Pose moved = pose;
        moved.position = distance * way;
        return moved;
      };
      for (int step = 0; step < 40; step++) {
        const double middle = 0.5 * (in + out);
        (acting(surface, a, at(middle)).energy > 0.5 * deep * deep ? in : out) = middle;
      }
      pose = at(out);
      const Acting here = acting(surface, a, pose);
      if (here.count == 0 || std::abs(std::sqrt(2.0 * here.energy) / deep - 1.0) > 0.01) continue;
      const double step = 1.0e-3 * deep;
      const auto gradient = [&](const Vector &d, bool turns) {
        double energy[2];
        for (const int sign : {0, 1}) {
          Pose moved = pose;
          const double by = sign ? step : -step;
          if (turns)
            moved.rotation = Eigen::AngleAxisd(by, to_eigen(d)).toRotationMatrix() * pose.rotation;
          else
            moved.position = pose.position + by * d;
          const Acting there = acting(surface, a, moved);
          if (there.count != here.count || length(there.force - here.force) > 0.01 * deep)
            return std::nan("");
          energy[sign] = there.energy;
        }
        return (energy[1] - energy[0]) / (2.0 * step);
      };
      for (const bool turns : {false, true})
        for (const Vector &d : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}) {
          const double slope = gradient(d, turns),
                       expected = -dot(d, turns ? here.torque : here.force);
          if (std::isnan(slope)) continue;    // at a kink
          compared++;
          differ += std::abs(slope - expected) > 2.0e-4 * deep;
        }
    }
    EXPECT_GT(compared, 1200) << surface.name;
    EXPECT_EQ(differ, 0) << surface.name << " of " << compared;
  }
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

/* ---- names ------------------------------------------------------------------------------------ */

TEST(SmoothSurfaces, names_of_places_are_directions)
{
  RandomBodies random(37);
  for (int k = 0; k < 1000; k++) {
    const Vector d = random.direction();
    Vector again = direction_of_place(place_name(d));
    again = (1.0 / length(again)) * again;
    ASSERT_LT(length(again - d), 3.0e-4) << d.x << " " << d.y << " " << d.z;
    ASSERT_EQ(parts_of(place_name(d)), ContactParts::WHOLE);
  }
}

TEST(SmoothSurfaces, histories_stay_with_their_places)
{
  // a needle across a drum of facets, that of the deeper end first
  const Touched wall = mesh("drum", drum(24, 1.0, 3.0));
  const Superellipsoid needle({0.95, 0.1, 0.1}, 2.0, 2.0);
  const auto points_at = [&](double x, double angle) {
    ShapeContacts contacts;
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    wall.touch(needle, Pose({x, 0.35, 0.1}, turned), contacts);
    std::vector<PointContact> points;
    for (const ShapeContact &one : contacts.points) {
      PointContact point{};
      point.name = static_cast<std::uint64_t>(one.surface) << 32 | one.name;
      point.is_named_by_place = one.is_named_by_place;
      point.place = one.position;
      points.push_back(point);
    }
    return points;
  };
  std::vector<PointContact> before = points_at(0.0, 0.0);
  ASSERT_EQ(before.size(), 2U);
  for (PointContact &point : before) point.history[0] = point.place.x > 0.0 ? 1.0 : -1.0;
  // to and fro, so that either end is the deeper one, alone or not, and on other facets
  for (int step = 1; step <= 200; step++) {
    const double phase = 2.0 * pi * step / 100;
    std::vector<PointContact> points =
        points_at(0.01 * std::sin(phase), 0.02 * std::sin(2.0 * phase));
    ASSERT_EQ(points.size(), 2U) << step;
    continue_at_places(points.data(), points.size(), before.data(), before.size());
    for (const PointContact &point : points)
      ASSERT_EQ(point.history[0], point.place.x > 0.0 ? 1.0 : -1.0) << step;
    before = points;
  }
  // one goes: the other keeps its own; and one that comes has none
  std::vector<PointContact> one = {points_at(0.0, 0.0)};
  one.erase(one.begin());
  continue_at_places(one.data(), 1, before.data(), 2);
  ASSERT_EQ(one[0].history[0], one[0].place.x > 0.0 ? 1.0 : -1.0);
  std::vector<PointContact> both = points_at(0.001, 0.0);
  continue_at_places(both.data(), 2, one.data(), 1);
  for (const PointContact &point : both)
    ASSERT_EQ(point.history[0], point.place.x * one[0].place.x > 0.0 ? one[0].history[0] : 0.0);
}

}    // namespace
