// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of convex bodies where they are known: cubes on planes, cubes and edges, spheres, drums; extreme shapes;
// forces that are continuous along random paths.

#include "body/shape/frustum.h"
#include "convex_bodies.h"
#include "shape/convex/collide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

using namespace Talus;

namespace {

using Vector = Vector3<double>;
constexpr double pi = 3.14159265358979323846;

struct Pair {
  const ConvexShape &a, &b;
  ShapeContacts contacts;
  SeparatingDirection direction;

  bool touch(const Pose &pose_a, const Pose &pose_b)
  {
    return collide(a, pose_a, b, pose_b, direction, contacts);
  }
  double weight() const
  {
    double sum = 0.0;
    for (const ShapeContact &c : contacts.points) sum += c.weight;
    return sum;
  }
};

}    // namespace

/* ---- planes ---------------------------------------------------------------------------------- */

TEST(ConvexPlane, FlatCubeHasFourPointsOfEqualDepth)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.0);
  ShapeContacts contacts;
  ASSERT_TRUE(
      collide_plane(cube, Pose({0.3, 0.2, 0.49}, turned(0.4, 0, 0, 1)), {0, 0, 1}, 0.0, contacts));
  ASSERT_EQ(contacts.points.size(), 4U);
  for (const ShapeContact &c : contacts.points) {
    EXPECT_NEAR(c.overlap, 0.01, 1e-15);
    EXPECT_NEAR(c.position.z, -0.005, 1e-15);
    EXPECT_EQ(c.normal.z, 1.0);
    EXPECT_EQ(c.weight, 1.0);
  }
  EXPECT_FALSE(collide_plane(cube, Pose({0, 0, 0.501}, straight), {0, 0, 1}, 0.0, contacts));
}

TEST(ConvexPlane, RoundedCubeOnFaceEdgeCorner)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.1);
  ShapeContacts contacts;
  collide_plane(cube, Pose({0, 0, 0.59}, straight), {0, 0, 1}, 0.0, contacts);
  EXPECT_EQ(contacts.points.size(), 4U);
  collide_plane(cube, Pose({0, 0, 0.09 + std::sqrt(0.5)}, turned(pi / 4, 1, 0, 0)), {0, 0, 1}, 0.0,
                contacts);
  EXPECT_EQ(contacts.points.size(), 2U);
  const Eigen::Quaterniond corner = Eigen::Quaterniond::FromTwoVectors(
      Eigen::Vector3d(1, 1, 1).normalized(), Eigen::Vector3d(0, 0, -1));
  collide_plane(cube, Pose({0, 0, 0.09 + std::sqrt(0.75)}, corner), {0, 0, 1}, 0.0, contacts);
  ASSERT_EQ(contacts.points.size(), 1U);
  EXPECT_NEAR(contacts.points[0].overlap, 0.01, 1e-14);
  EXPECT_LT(length(contacts.points[0].position - Vector{0, 0, -0.005}), 1e-14);
}

TEST(ConvexCylinder, InsideOfADrum)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.1);
  ShapeContacts contacts;
  // flat at the bottom of a drum along x: the four lower corners at the same distance from the axis
  const double low = 1.5;
  const double from_axis = std::sqrt(0.25 + low * low);
  const Pose pose({7.0, 2.0, 3.0 - low + 0.5}, straight);
  const auto drum = [](double radius) {
    const double endless = std::numeric_limits<double>::infinity();
    return Frustum({0, 2, 3}, {1, 0, 0}, radius, radius, endless, true);
  };
  ASSERT_TRUE(collide_vessel(cube, pose, drum(from_axis + 0.09), contacts));
  ASSERT_EQ(contacts.points.size(), 4U);
  for (const ShapeContact &c : contacts.points) {
    EXPECT_NEAR(c.overlap, 0.01, 1e-14);
    EXPECT_NEAR(c.normal.z, low / from_axis, 1e-14);
    EXPECT_EQ(c.normal.x, 0.0);
  }
  EXPECT_FALSE(collide_vessel(cube, pose, drum(from_axis + 0.11), contacts));
}

/* ---- spheres --------------------------------------------------------------------------------- */

TEST(ConvexSphere, FaceEdgeCornerAndInside)
{
  const ConvexShape box = ConvexShape::box({2.0, 2.0, 2.0}, 0.1);
  const Pose pose({5.0, 6.0, 7.0}, straight);
  ShapeContacts contacts;
  const auto touch = [&](double x, double y, double z) {
    return collide_sphere(box, pose, pose.position + Vector{x, y, z}, 0.5, contacts);
  };
  ASSERT_TRUE(touch(0.2, 0.3, 1.55));
  EXPECT_NEAR(contacts.points[0].overlap, 0.05, 1e-14);
  EXPECT_NEAR(contacts.points[0].normal.z, -1.0, 1e-14);
  EXPECT_NEAR(contacts.points[0].position.z, 7.0 + 1.1 - 0.025, 1e-14);
  ASSERT_TRUE(touch(0.2, 1.3, 1.4));
  EXPECT_NEAR(contacts.points[0].overlap, 0.1, 1e-14);
  EXPECT_NEAR(contacts.points[0].normal.y, -0.6, 1e-14);
  ASSERT_TRUE(touch(1.2, 1.3, 1.4));
  EXPECT_NEAR(contacts.points[0].overlap, 0.6 - std::sqrt(0.29), 1e-14);
  EXPECT_FALSE(touch(1.4, 1.4, 1.4));
  ASSERT_TRUE(touch(0.1, 0.2, 0.9));    // inside the core: out through the nearest face
  EXPECT_NEAR(contacts.points[0].overlap, 0.7, 1e-14);
  EXPECT_NEAR(contacts.points[0].normal.z, -1.0, 1e-14);
}

/* Against all parts of bodies with many vertices, and the sphere far larger or smaller than the body. */

TEST(ConvexSphere, RandomPlacesAgainstSamplesOfTheSurface)
{
  RandomBodies random(9);
  ShapeContacts contacts;
  for (const int count : {4, 8, 40, 500}) {
    const ConvexShape shape = ConvexShape::polyhedron(random.corners(count, {1.0, 0.6, 0.3}), 0.0);
    const auto surface = shape.core_surface();
    for (int trial = 0; trial < 300; trial++) {
      const Vector x = random.uniform(0.3, 3.0) * random.direction();
      // least distance from triangles by a projection on a grid of each, refined: exact for the plane, edges, corners
      double least = 1e9;
      bool inside = true;
      for (const Triangle &t : surface) {
        const Vector n0 = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
        const Vector n = (1.0 / length(n0)) * n0;
        const double height = dot(n, x - t.corner[0]);
        inside = inside && height <= 0.0;
        bool over = true;
        for (int k = 0; k < 3; k++) {
          const Vector from = t.corner[k], along = t.corner[(k + 1) % 3] - from;
          over = over && dot(cross(n, along), x - from) >= 0.0;
          const double s = std::clamp(dot(x - from, along) / dot(along, along), 0.0, 1.0);
          least = std::min(least, length(x - from - s * along));
        }
        if (over) least = std::min(least, std::fabs(height));
      }
      if (inside) continue;
      const double radius = random.chance(0.5) ? least + 0.01 : 10.0 * least;
      ASSERT_TRUE(collide_sphere(shape, Pose(), x, radius, contacts));
      EXPECT_NEAR(contacts.points[0].overlap, radius - least,
                  1e-5);    // some faces are flat to that only
    }
  }
}

/* ---- two bodies ------------------------------------------------------------------------------ */

TEST(ConvexPair, SharpCubeOnCube)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.0);
  Pair pair{cube, cube, {}, {}};
  const Pose below({0, 0, 0}, straight);
  // exactly above each other, with rounding of the place, shifted, turned
  ASSERT_TRUE(pair.touch(Pose({0, 0, 0.99}, straight), below));
  EXPECT_EQ(pair.contacts.points.size(), 4U);
  EXPECT_NEAR(pair.weight(), std::sqrt(15.0), 1e-12);
  for (const ShapeContact &c : pair.contacts.points) {
    EXPECT_NEAR(c.overlap, 0.01, 1e-14);
    EXPECT_NEAR(c.weight, std::sqrt(15.0) / 4.0, 1e-12);
    EXPECT_NEAR(c.normal.z, 1.0, 1e-14);
    EXPECT_NEAR(c.position.z, 0.495, 1e-14);
  }
  ASSERT_TRUE(pair.touch(Pose({0.2, 0.1, 0.99}, straight), below));
  EXPECT_EQ(pair.contacts.points.size(), 4U);
  ASSERT_TRUE(pair.touch(Pose({0, 0, 0.99}, turned(pi / 4, 0, 0, 1)), below));
  EXPECT_EQ(pair.contacts.points.size(), 8U);
  EXPECT_NEAR(pair.weight(), std::sqrt(15.0), 1e-12);
  EXPECT_FALSE(pair.touch(Pose({0, 0, 1.001}, straight), below));
}

TEST(ConvexPair, StackedCubesKeepTheNamesOfTheirContacts)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.0);
  Pair pair{cube, cube, {}, {}};
  RandomBodies random(13);
  std::vector<std::uint32_t> names;
  for (int trial = 0; trial < 200; trial++) {
    const double tiny = 1e-7;
    const Vector at{tiny * random.uniform(-1, 1), tiny * random.uniform(-1, 1), 0.999};
    const double angle = tiny * random.uniform(-1, 1);
    const Pose above(at, turned(angle, random.uniform(-1, 1), 0.3, 1));
    ASSERT_TRUE(pair.touch(above, Pose()));
    std::vector<std::uint32_t> now;
    for (const ShapeContact &c : pair.contacts.points) now.push_back(c.name);
    if (trial == 0) names = now;
    EXPECT_EQ(now, names) << trial;
    EXPECT_EQ(now.size(), 4U);
    EXPECT_NEAR(pair.weight(), std::sqrt(15.0), 5e-4);    // they lean by 1e-4 of the overlap
  }
}

TEST(ConvexPair, RoundedCubeOnCube)
{
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.05),
                    plate = ConvexShape::box({3.0, 3.0, 1.0}, 0.05);
  Pair on_plate{cube, plate, {}, {}};
  ASSERT_TRUE(on_plate.touch(Pose({0.1, 0.2, 1.09}, turned(0.3, 0, 0, 1)), Pose()));
  EXPECT_EQ(on_plate.contacts.points.size(), 4U);
  for (const ShapeContact &c : on_plate.contacts.points) {
    EXPECT_NEAR(c.overlap, 0.01, 1e-14);
    EXPECT_NEAR(c.normal.z, 1.0, 1e-14);
    EXPECT_NEAR(c.weight, 1.0, 1e-14);
    EXPECT_NEAR(c.position.z, 0.545, 1e-14);
  }
  Pair on_cube{cube, cube, {}, {}};
  ASSERT_TRUE(on_cube.touch(Pose({0, 0, 1.09}, turned(pi / 4, 0, 0, 1)), Pose()));
  EXPECT_EQ(on_cube.contacts.points.size(), 8U);    // edges that cross
  for (const ShapeContact &c : on_cube.contacts.points)
    EXPECT_EQ(parts_of(c.name), ContactParts::EDGES);
  EXPECT_FALSE(on_cube.touch(Pose({0, 0, 1.101}, straight), Pose()));
  EXPECT_FALSE(on_cube.contacts.cores_overlap);
  ASSERT_TRUE(on_cube.touch(Pose({0, 0, 0.99}, straight), Pose()));
  EXPECT_TRUE(on_cube.contacts.cores_overlap);
  EXPECT_NEAR(on_cube.contacts.points[0].overlap, 0.11, 1e-13);
}

TEST(ConvexPair, CrossedEdges)
{
  for (const double r : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, r);
    Pair pair{cube, cube, {}, {}};
    const double edge = std::sqrt(0.5);
    ASSERT_TRUE(pair.touch(Pose({0.1, 0.2, 2.0 * (edge + r) - 0.001}, turned(pi / 4, 1, 0, 0)),
                           Pose({0, 0, 0}, turned(pi / 4, 0, 1, 0))));
    ASSERT_EQ(pair.contacts.points.size(), 1U);
    const ShapeContact &c = pair.contacts.points[0];
    EXPECT_EQ(parts_of(c.name), ContactParts::EDGES);
    EXPECT_NEAR(c.overlap, 0.001, 1e-14);
    EXPECT_NEAR(c.weight, 1.0, 1e-14);
    EXPECT_LT(length(c.position - Vector{0.0, 0.2, edge + r - 0.0005}), 1e-13);
    EXPECT_NEAR(c.normal.z, 1.0, 1e-14);
  }
}

/* ---- extreme shapes -------------------------------------------------------------------------- */

TEST(ConvexPair, ExtremeShapes)
{
  RandomBodies random(17);
  for (const double r : {0.0, 0.02}) {
    std::vector<ConvexShape> shapes;
    shapes.push_back(ConvexShape::box({50.0, 1.0, 1.0}, r));
    shapes.push_back(ConvexShape::box({50.0, 50.0, 1.0}, r));
    shapes.push_back(ConvexShape::polyhedron(
        {{0, 0, 25}, {0.2, 0, -25}, {-0.1, 0.2, -25}, {-0.1, -0.2, -25}}, r));
    shapes.push_back(ConvexShape::polyhedron(random.corners(500, {1.0, 1.0, 1.0}), r));
    shapes.push_back(ConvexShape::box({30.0, 30.0, 30.0}, r));
    ShapeContacts contacts;
    int touching = 0;
    for (int trial = 0; trial < 1000; trial++) {
      const ConvexShape &a = shapes[random.below(5)], &b = shapes[random.below(5)];
      const Pose pose_a({0, 0, 0}, random.orientation());
      // one after the other: the order of arguments is the compiler's choice
      const Eigen::Quaterniond rotation = random.orientation();
      const double distance = 1.001 * (a.bounding_radius() + b.bounding_radius());
      Pose pose_b(distance * random.direction(), rotation);
      // b comes nearer until they touch: from there less than the rounding, or a thousandth of the size
      SeparatingDirection direction;
      double far = 1.0, near = 0.0;
      const Vector from = pose_b.position;
      for (int step = 0; step < 30; step++) {
        const double middle = 0.5 * (near + far);
        pose_b.position = middle * from;
        (collide(a, pose_a, b, pose_b, direction, contacts) ? near : far) = middle;
      }
      pose_b.position = (near - 1e-5) * from;
      const bool touch = collide(a, pose_a, b, pose_b, direction, contacts);
      touching += touch;
      EXPECT_TRUE(touch) << trial;
      for (const ShapeContact &c : contacts.points) {
        EXPECT_LT(c.overlap, 2e-3) << trial;
        EXPECT_GT(c.overlap, 0.0);
        EXPECT_NEAR(length(c.normal), 1.0, 1e-9);
        // where both bodies are; corners of common faces that do not touch bear next to nothing
        const double outside = std::max(length(c.position - pose_a.position) - a.bounding_radius(),
                                        length(c.position - pose_b.position) - b.bounding_radius());
        EXPECT_LT(outside, c.weight < 2e-3 ? 1e-2 : 1e-3);
      }
      EXPECT_FALSE(contacts.cores_overlap && r > 0.0);
    }
    EXPECT_EQ(touching, 1000);
  }
}

/* ---- continuity ------------------------------------------------------------------------------ */

/* The largest change of the load along a path: the interval in which it changes most is halved, again and again. A jump
   stays, what is continuous vanishes. */

TEST(ConvexPair, ForcesOfRoundedBodiesAreContinuousAlongRandomPaths)
{
  RandomBodies random(23);
  const double r = 0.1;
  std::vector<ConvexShape> shapes;
  shapes.push_back(ConvexShape::box({1.0, 1.0, 1.0}, r));
  shapes.push_back(ConvexShape::box({1.0, 0.6, 0.3}, r));
  shapes.push_back(ConvexShape::polyhedron(dodecahedron_corners(), r));
  shapes.push_back(ConvexShape::polyhedron(random.corners(12, {0.6, 0.5, 0.4}), r));
  double worst = 0.0;
  int paths = 0;
  while (paths < 400) {
    const ConvexShape &a = shapes[random.below(4)], &b = shapes[random.below(4)];
    ShapeContacts contacts;
    SeparatingDirection direction;
    // a place where they touch, and a way past it; every third time with parallel faces, turning
    const Eigen::Quaterniond qa = random.orientation();
    const Vector axis{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Eigen::Quaterniond turn = turned(0.3, axis.x, axis.y, axis.z);
    const bool parallel = random.chance(0.3);
    const Eigen::Quaterniond qb = parallel ? qa : random.orientation();
    const Vector toward = parallel ? from_eigen(qa * Eigen::Vector3d(0, 0, 1)) : random.direction();
    double far = a.bounding_radius() + b.bounding_radius(), near = 0.0;
    const Pose pose_a({0, 0, 0}, qa);
    for (int step = 0; step < 40; step++) {
      const double middle = 0.5 * (near + far);
      (collide(a, pose_a, b, Pose(middle * toward, qb), direction, contacts) ? near : far) = middle;
    }
    const Vector start = (near - 0.03) * toward, slide = 0.4 * random.direction();
    const auto along_path = [&](double t) {
      const Vector shift = t * (slide - dot(slide, toward) * toward);
      collide(a, pose_a, b, Pose(start + shift, qb * Eigen::Quaterniond::Identity().slerp(t, turn)),
              direction, contacts);
      return contacts.cores_overlap;
    };
    const auto change = [](const Load &p, const Load &q) {
      return length(p.force - q.force) + length(p.torque - q.torque);
    };
    constexpr int count = 200;
    Load last;
    double most = -1.0, from = 0.0;
    bool overlap = false;
    for (int k = 0; k <= count; k++) {
      overlap = overlap || along_path(static_cast<double>(k) / count);
      const Load now = load_of(contacts);
      if (k > 0 && change(now, last) > most) {
        most = change(now, last);
        from = (k - 1.0) / count;
      }
      last = now;
    }
    if (overlap) continue;
    paths++;
    double width = 1.0 / count;
    for (int halving = 0; halving < 30; halving++) {
      width *= 0.5;
      along_path(from);
      const Load at_from = load_of(contacts);
      along_path(from + width);
      const Load at_middle = load_of(contacts);
      along_path(from + 2.0 * width);
      const Load at_end = load_of(contacts);
      if (change(at_end, at_middle) > change(at_middle, at_from)) from += width;
    }
    along_path(from);
    const Load before = load_of(contacts);
    along_path(from + width);
    worst = std::max(worst, change(before, load_of(contacts)));
  }
  EXPECT_LT(worst, 1e-6);
}

/* Contacts that are there before and after a small step have the same names: few come and go. */

TEST(ConvexPair, NamesLastWhileBodiesMoveALittle)
{
  RandomBodies random(29);
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, 0.1);
  Pair pair{cube, cube, {}, {}};
  int kept = 0, all = 0;
  Pose above({0.2, 0.1, 1.19}, turned(0.2, 0, 0, 1));
  std::map<std::uint32_t, Vector> last;
  for (int step = 0; step < 500; step++) {
    above.position.x += 1e-4;
    ASSERT_TRUE(pair.touch(above, Pose()));
    std::map<std::uint32_t, Vector> now;
    for (const ShapeContact &c : pair.contacts.points) now[c.name] = c.position;
    for (const auto &[name, x] : now) {
      all++;
      const auto found = last.find(name);
      if (found == last.end()) continue;
      kept++;
      EXPECT_LT(length(found->second - x), 1e-3);
    }
    last = now;
  }
  EXPECT_GT(kept, 0.99 * all - 20);
}
