// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact points of convex particles with meshes: floors of many triangles against the plane, boxes
// against their meshes, ridges, valleys and corners by hand, sides, forces that are continuous.

#include "convex_bodies.h"
#include "shape/convex/collide.h"
#include "shape/convex/collide_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

struct Mesh {
  MeshShape shape;
  MeshFeatures features;
  ShapeContacts contacts;

  explicit Mesh(const std::vector<Triangle> &triangles, MeshSide side = MeshSide::NORMALS,
                bool orient = false) :
      shape(TriangleMesh(triangles, orient), side),
      features(shape.surface())
  {
  }
  bool touch(const ConvexShape &body, const Pose &pose)
  {
    return collide_mesh(body, pose, {shape, features}, contacts);
  }
};

void add_quad(std::vector<Triangle> &to, Vector a, Vector b, Vector c, Vector d)
{
  to.push_back({{a, b, c}});
  to.push_back({{a, c, d}});
}

/// A floor z = 0 of irregular triangles, normals upward.
std::vector<Triangle> floor_of(int cells, double size, RandomBodies &random)
{
  std::vector<Vector> at;
  for (int j = 0; j <= cells; j++)
    for (int i = 0; i <= cells; i++) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      const double s = size / cells, shake = inner ? 0.3 * s : 0.0;
      at.push_back({i * s - 0.5 * size + random.uniform(-shake, shake),
                    j * s - 0.5 * size + random.uniform(-shake, shake), 0.0});
    }
  std::vector<Triangle> triangles;
  for (int j = 0; j < cells; j++)
    for (int i = 0; i < cells; i++) {
      const int k = j * (cells + 1) + i, l = k + cells + 1;
      add_quad(triangles, at[k], at[k + 1], at[l + 1], at[l]);
    }
  return triangles;
}

/// A box with each face cut into cells^2 (a power of 2) pairs of triangles; normals outward.
std::vector<Triangle> box_of(Vector half, int cells)
{
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; axis++)
    for (const double sign : {1.0, -1.0})
      for (int i = 0; i < cells; i++)
        for (int j = 0; j < cells; j++) {
          const auto point = [&](int u, int v) {
            double x[3];
            const double h[3] = {half.x, half.y, half.z};
            x[axis] = sign * h[axis];
            const int a = (axis + 1) % 3, b = (axis + 2) % 3;
            x[a] = h[a] * (2.0 * u / cells - 1.0);
            x[b] = sign * h[b] * (2.0 * v / cells - 1.0);
            return Vector{x[0], x[1], x[2]};
          };
          add_quad(triangles, point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
  return triangles;
}

double difference(const Load &a, const Load &b)
{
  return std::max(length(a.force - b.force), length(a.torque - b.torque));
}

double weight_of(const ShapeContacts &contacts)
{
  double sum = 0.0;
  for (const ShapeContact &c : contacts.points) sum += c.weight;
  return sum;
}

}    // namespace

/* ---- floors ----------------------------------------------------------------------------------- */

TEST(ConvexMesh, FloorOfManyTrianglesIsAPlane)
{
  RandomBodies random(71);
  Mesh floor(floor_of(12, 8.0, random));
  int touching = 0;
  for (const double radius : {0.0, 0.1})
    for (int n = 0; n < 3000; n++) {
      const ConvexShape body =
          n % 3 ? ConvexShape::polyhedron(random.corners(12, {.6, .5, .4}), radius)
                : ConvexShape::box({1.0, 0.8, 0.6}, radius);
      const double low = n % 2 ? 0.5 : 0.2;
      const Pose pose({random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(low, 0.8)},
                      n % 5 ? random.orientation() : turned(random.uniform(0, 6), 0, 0, 1));
      ShapeContacts plane;
      const bool expected = collide_plane(body, pose, {0, 0, 1}, 0.0, plane);
      ASSERT_EQ(floor.touch(body, pose), expected) << n;
      ASSERT_EQ(floor.contacts.points.size(), plane.points.size()) << n;
      EXPECT_LT(difference(load_of(floor.contacts), load_of(plane)), 1e-13);
      for (const ShapeContact &c : floor.contacts.points) EXPECT_EQ(c.surface, 0U);
      touching += expected;
    }
  EXPECT_GT(touching, 1500);
}

TEST(ConvexMesh, SidesAreThoseOfSpheres)
{
  std::vector<Triangle> square;
  add_quad(square, {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  for (const double radius : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    const double height = 0.5 + radius - 0.01;
    const Pose above({0, 0, height}, straight), below({0, 0, -height}, straight);
    Mesh front(square), back(square, MeshSide::BACKS), both(square, MeshSide::BOTH);
    EXPECT_TRUE(front.touch(cube, above));
    EXPECT_FALSE(front.touch(cube, below));
    EXPECT_FALSE(back.touch(cube, above));
    EXPECT_TRUE(back.touch(cube, below));
    EXPECT_TRUE(both.touch(cube, above));
    EXPECT_EQ(both.contacts.points.size(), 4U);
    EXPECT_NEAR(both.contacts.points[0].normal.z, 1.0, 1e-15);
    EXPECT_TRUE(both.touch(cube, below));
    EXPECT_EQ(both.contacts.points.size(), 4U);
    EXPECT_NEAR(both.contacts.points[0].normal.z, -1.0, 1e-15);
  }
}

/* ---- valleys ---------------------------------------------------------------------------------- */

TEST(ConvexMesh, InsideOfABoxIsItsFaces)
{
  RandomBodies random(72);
  const Vector half{2.0, 2.0, 2.0};
  Mesh box(box_of(half, 4), MeshSide::BACKS);
  int touching = 0;
  for (const double radius : {0.0, 0.15})
    for (int n = 0; n < 3000; n++) {
      const ConvexShape body = ConvexShape::polyhedron(random.corners(10, {.7, .7, .7}), radius);
      const auto place = [&] { return random.uniform(-1.75, 1.75); };
      const Pose pose({place(), place(), place()}, random.orientation());
      Load expected;
      bool deep = false;    // behind one wall by more than a sphere notices another
      for (int v = 0; v < body.core().num_vertices(); v++) {
        const Vector x = pose.point_in_space(body.core().vertex(v));
        const double c[3] = {x.x, x.y, x.z};
        int behind = 0, near = 0;
        for (int axis = 0; axis < 3; axis++) {
          behind += std::fabs(c[axis]) > 2.0;
          near += std::fabs(c[axis]) > 2.0 - radius;
        }
        deep = deep || (behind > 0 && near > behind);
      }
      if (deep) continue;
      ShapeContacts wall;
      for (const double s : {1.0, -1.0})
        for (const Vector n_of : {Vector{s, 0, 0}, Vector{0, s, 0}, Vector{0, 0, s}}) {
          collide_plane(body, pose, n_of, -2.0, wall);
          const Load load = load_of(wall);
          expected.force = expected.force + load.force;
          expected.torque = expected.torque + load.torque;
        }
      touching += box.touch(body, pose);
      EXPECT_LT(difference(load_of(box.contacts), expected), 1e-12) << n << " " << radius;
    }
  EXPECT_GT(touching, 2000);
}

/* ---- ridges and corners ----------------------------------------------------------------------- */

TEST(ConvexMesh, RoundedBodiesOutsideABoxOfManyTriangles)
{
  RandomBodies random(73);
  const ConvexShape block = ConvexShape::box({2.0, 2.0, 2.0}, 0.0);
  Mesh coarse(box_of({1.0, 1.0, 1.0}, 1)), fine(box_of({1.0, 1.0, 1.0}, 4));
  int compared = 0;
  for (int n = 0; n < 6000; n++) {
    const ConvexShape body = ConvexShape::polyhedron(random.corners(10, {.7, .6, .5}), 0.1);
    const Vector d = random.direction();
    const Pose pose(random.uniform(1.2, 2.2) * d, random.orientation());
    SeparatingDirection direction;
    ShapeContacts pair;
    collide(body, pose, block, Pose(), direction, pair);
    if (pair.cores_overlap) continue;
    coarse.touch(body, pose);
    fine.touch(body, pose);
    EXPECT_LT(difference(load_of(coarse.contacts), load_of(fine.contacts)), 1e-12) << n;
    EXPECT_LT(difference(load_of(fine.contacts), load_of(pair)), 1e-9) << n;
    compared += !pair.points.empty();
  }
  EXPECT_GT(compared, 300);
}

TEST(ConvexMesh, CubeOverTheEdgeOfATable)
{
  Mesh table(box_of({2.0, 2.0, 0.2}, 4));
  for (const double radius : {0.0, 0.05}) {
    const double half = 0.5 + radius;
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    // two corners on the table, two beyond; tilted by a little it rests on the edge as well
    const Pose flat({1.9, 0.0, 0.2 + half - 0.01}, straight);
    ASSERT_TRUE(table.touch(cube, flat));
    EXPECT_NEAR(weight_of(table.contacts), 2.0, 1e-9);
    const Pose tilted({1.9, 0.0, 0.2 + half - 0.01}, turned(0.01, 0, 1, 0));
    ASSERT_TRUE(table.touch(cube, tilted));
    EXPECT_EQ(table.contacts.points.size(), 4U);
    // with energies shared: two edges, and what they leave of the corners
    EXPECT_NEAR(weight_of(table.contacts), 2.0 - 2.0 / 9.0, 1e-3);
    std::set<std::uint64_t> names;
    for (const ShapeContact &c : table.contacts.points) {
      EXPECT_GT(c.normal.z, 0.999);
      names.insert(static_cast<std::uint64_t>(c.surface) << 32 | c.name);
    }
    EXPECT_EQ(names.size(), 4U);
    // the edge of a piece of the surface that has no thickness
    std::vector<Triangle> sheet;
    add_quad(sheet, {-2, -2, 0.2}, {2, -2, 0.2}, {2, 2, 0.2}, {-2, 2, 0.2});
    for (const MeshSide side : {MeshSide::NORMALS, MeshSide::BOTH}) {
      Mesh thin(sheet, side);
      ASSERT_TRUE(thin.touch(cube, tilted));
      EXPECT_LT(difference(load_of(thin.contacts), load_of(table.contacts)), 1e-12);
    }
  }
}

TEST(ConvexMesh, CubeOnAnEdgeAcrossARidgeAndCubeOnACorner)
{
  // a roof along y
  std::vector<Triangle> roof;
  add_quad(roof, {0, -3, 0}, {2, -3, -2}, {2, 3, -2}, {0, 3, 0});
  add_quad(roof, {-2, -3, -2}, {0, -3, 0}, {0, 3, 0}, {-2, 3, -2});
  Mesh ridge(roof);
  for (const double radius : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    const double height = std::sqrt(0.5) + radius - 0.01;
    ASSERT_TRUE(
        ridge.touch(cube, Pose({0, 0.3, height}, turned(0.25 * 3.14159265358979, 1, 0, 0))));
    ASSERT_EQ(ridge.contacts.points.size(), 1U);
    EXPECT_NEAR(ridge.contacts.points[0].overlap, 0.01, 1e-9);
    EXPECT_NEAR(ridge.contacts.points[0].normal.z, 1.0, 1e-12);
    EXPECT_NEAR(ridge.contacts.points[0].position.y, 0.3, 1e-9);
    // a face on the ridge: its two edges across
    ASSERT_TRUE(ridge.touch(cube, Pose({0, 0.3, 0.5 + radius - 0.01}, straight)));
    ASSERT_EQ(ridge.contacts.points.size(), 2U);
    EXPECT_NEAR(ridge.contacts.points[1].overlap, 0.01, 1e-12);
  }
  // the tip of a pyramid in the middle of a face
  std::vector<Triangle> pyramid;
  const Vector foot[4] = {{2, 2, -2}, {-2, 2, -2}, {-2, -2, -2}, {2, -2, -2}};
  for (int k = 0; k < 4; k++) pyramid.push_back({{{0, 0, 0}, foot[k], foot[(k + 1) % 4]}});
  Mesh tip(pyramid);
  for (const double radius : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    ASSERT_TRUE(tip.touch(cube, Pose({0.1, 0.2, 0.5 + radius - 0.02}, straight)));
    ASSERT_EQ(tip.contacts.points.size(), 1U);
    EXPECT_NEAR(tip.contacts.points[0].overlap, 0.02, 1e-12);
    EXPECT_NEAR(tip.contacts.points[0].normal.z, 1.0, 1e-12);
  }
}

/* ---- continuity ------------------------------------------------------------------------------- */

TEST(ConvexMesh, ForcesOfRoundedBodiesAreContinuousAlongRandomPaths)
{
  RandomBodies random(74);
  Mesh block(box_of({1.0, 1.0, 1.0}, 4));
  double largest = 0.0;
  int touching = 0;
  for (int n = 0; n < 120; n++) {
    const ConvexShape body = ConvexShape::polyhedron(random.corners(9, {.6, .5, .5}), 0.2);
    const Vector from = 1.6 * random.direction();
    const Vector way = 0.25 * random.direction();
    const Eigen::Quaterniond q = random.orientation();
    const Eigen::Vector3d axis = to_eigen(random.direction());
    constexpr int steps = 2000;
    Load before;
    bool known = false;
    for (int k = 0; k <= steps; k++) {
      const double t = static_cast<double>(k) / steps;
      const Pose pose(from + t * way, Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * t, axis)) * q);
      SeparatingDirection direction;
      ShapeContacts pair;
      static const ConvexShape solid = ConvexShape::box({2.0, 2.0, 2.0}, 0.0);
      collide(body, pose, solid, Pose(), direction, pair);
      if (pair.cores_overlap) {
        known = false;
        continue;
      }
      block.touch(body, pose);
      const Load now = load_of(block.contacts);
      if (known) largest = std::max(largest, difference(now, before));
      touching += !block.contacts.points.empty();
      before = now;
      known = true;
    }
  }
  EXPECT_GT(touching, 4000);
  EXPECT_LT(largest, 0.02);
}

/* ---- one edge ----------------------------------------------------------------------------- */

TEST(ConvexMesh, UprightEdgeOfACubeOnTheFloorMeetsALevelRidge)
{
  // a wedge with its ridge along y, toward the edge; what the floor bears takes nothing from it
  const double floor_overlap = 0.02, overlap = 0.01;
  for (const double radius : {0.0, 0.1}) {
    const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
    const double x = std::sqrt(0.5) + radius - overlap;
    std::vector<Triangle> triangles;
    add_quad(triangles, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
    add_quad(triangles, {x, -1, 0.5}, {x + 1, -1, 1}, {x + 1, 1, 1}, {x, 1, 0.5});
    add_quad(triangles, {x, 1, 0.5}, {x + 1, 1, 0}, {x + 1, -1, 0}, {x, -1, 0.5});
    Mesh mesh(triangles);
    ASSERT_TRUE(mesh.touch(cube, Pose({0, 0, 0.5 + radius - floor_overlap},
                                      turned(0.25 * 3.14159265358979, 0, 0, 1))));
    EXPECT_EQ(mesh.contacts.points.size(), 5U);
    const Load load = load_of(mesh.contacts);
    EXPECT_NEAR(load.force.x, -overlap, 1e-12);
    EXPECT_NEAR(load.force.z, 4 * floor_overlap, 1e-12);
  }
}

TEST(ConvexMesh, NearlyParallelEdgesTouchOnlyWhereTheyAreNear)
{
  // a cube on its edge, above a ridge along y and beside it
  std::vector<Triangle> roof;
  add_quad(roof, {0, -3, 0}, {2, -3, -2}, {2, 3, -2}, {0, 3, 0});
  add_quad(roof, {-2, -3, -2}, {0, -3, 0}, {0, 3, 0}, {-2, 3, -2});
  Mesh ridge(roof);
  const double radius = 0.1;
  const ConvexShape cube = ConvexShape::box({1.0, 1.0, 1.0}, radius);
  const Eigen::Quaterniond on_edge = turned(0.25 * 3.14159265358979, 0, 1, 0);
  RandomBodies random(75);
  for (int n = 0; n < 2000; n++) {
    const Vector axis = random.direction();
    const Eigen::Quaterniond q = turned(1e-15, axis.x, axis.y, axis.z) * on_edge;
    const double distance = random.uniform(0.05, 0.15), side = random.uniform(-0.6, 0.6);
    const Vector away{distance * std::sin(side), 0.0, distance * std::cos(side)};
    ridge.touch(cube, Pose(away + Vector{0, random.uniform(-1, 1), std::sqrt(0.5)}, q));
    if (distance > radius) {
      EXPECT_EQ(ridge.contacts.points.size(), 0U) << n;
    }
    double weight = 0.0;
    for (const ShapeContact &c : ridge.contacts.points) {
      EXPECT_NEAR(c.overlap, radius - distance, 1e-9) << n;
      EXPECT_NEAR(dot(c.normal, away), distance, 1e-9) << n;
      weight += c.weight;
    }
    if (distance < radius - 1e-9) {
      EXPECT_NEAR(weight, 2.0, 1e-3) << n;
    }
  }
}
