// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Shapes of convex particles: mass, center and inertia against closed formulas and points in space, frames, hulls, and
// what is refused.

#include "convex_bodies.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <string>

using namespace Talus;

namespace {

constexpr double pi = 3.14159265358979323846;

std::string error_of(const Points &points, double radius = 0.0)
{
  try {
    ConvexShape::polyhedron(points, radius);
  } catch (const std::runtime_error &error) {
    return error.what();
  }
  return "";
}

void expect_error(const std::string &text, const std::string &part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' has no '" << part << "'";
}

std::string stl_of(const std::vector<Triangle> &triangles)
{
  std::string text = "solid body\n";
  for (const Triangle &t : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto &p : t.corner) {
      char line[100];
      snprintf(line, sizeof line, "vertex %.9g %.9g %.9g\n", p.x, p.y, p.z);
      text += line;
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid body\n";
}

/// Every edge between two faces in opposite senses, Euler's formula, and no vertex above a face.
void expect_closed(const ConvexCore &core)
{
  EXPECT_EQ(core.num_vertices() - core.num_edges() + core.num_faces(), 2);
  int corners = 0;
  for (int f = 0; f < core.num_faces(); f++) {
    corners += core.num_corners(f);
    EXPECT_NEAR(length(core.normal(f)), 1.0, 1e-14);
    for (int k = 0; k < core.num_corners(f); k++) {
      const ConvexCore::Edge &edge = core.edge(core.edges_of_face(f)[k]);
      const int v = core.corners(f)[k], next = core.corners(f)[(k + 1) % core.num_corners(f)];
      const int side = edge.face[0] == f ? 0 : 1;
      EXPECT_EQ(edge.face[side], f);
      EXPECT_EQ(edge.vertex[side], v);
      EXPECT_EQ(edge.vertex[1 - side], next);
    }
    for (int v = 0; v < core.num_vertices(); v++)
      EXPECT_LE(dot(core.normal(f), core.vertex(v)), core.offset(f));
  }
  EXPECT_EQ(corners, 2 * core.num_edges());
}

}    // namespace

TEST(ConvexMass, Box)
{
  const ConvexShape box = ConvexShape::box({1.0, 2.0, 3.0}, 0.0);
  EXPECT_NEAR(box.volume(), 6.0, 1e-14);
  EXPECT_NEAR(box.principal_moments()[0], 6.0 / 12.0 * 13.0, 1e-13);
  EXPECT_NEAR(box.principal_moments()[1], 6.0 / 12.0 * 10.0, 1e-13);
  EXPECT_NEAR(box.principal_moments()[2], 6.0 / 12.0 * 5.0, 1e-13);
  EXPECT_EQ(box.given_frame().rotation, Eigen::Matrix3d::Identity());
  EXPECT_EQ(box.given_frame().position.x, 0.0);
  EXPECT_EQ(box.core().vertex(7).z, 1.5);
  EXPECT_NEAR(box.bounding_radius(), 0.5 * std::sqrt(14.0), 1e-14);
  EXPECT_NEAR(box.inscribed_radius(), 0.5, 1e-14);
  expect_closed(box.core());
}

TEST(ConvexMass, TetrahedronAwayFromTheOrigin)
{
  const double s = 1.0 / std::sqrt(8.0);    // edges of length 1
  Points corners{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
  for (auto &c : corners) c = c + Vector3<double>{10.0, -20.0, 5.0};
  const ConvexShape shape = ConvexShape::polyhedron(corners, 0.0);
  EXPECT_NEAR(shape.volume(), std::sqrt(2.0) / 12.0, 1e-12);
  for (int k = 0; k < 3; k++)
    EXPECT_NEAR(shape.principal_moments()[k], shape.volume() / 20.0, 1e-11);
  EXPECT_NEAR(shape.given_frame().position.x, 10.0, 1e-11);
  EXPECT_NEAR(shape.given_frame().position.y, -20.0, 1e-11);
  EXPECT_NEAR(shape.given_frame().position.z, 5.0, 1e-11);
  EXPECT_EQ(shape.core().num_faces(), 4);
  expect_closed(shape.core());
}

TEST(ConvexMass, Dodecahedron)
{
  const ConvexShape shape = ConvexShape::polyhedron(dodecahedron_corners(), 0.0);
  EXPECT_EQ(shape.core().num_faces(), 12);
  EXPECT_EQ(shape.core().num_edges(), 30);
  EXPECT_EQ(shape.core().num_vertices(), 20);
  expect_closed(shape.core());
  EXPECT_NEAR(shape.volume(), (15.0 + 7.0 * std::sqrt(5.0)) / 4.0, 1e-12);
  const double inertia = (95.0 + 39.0 * std::sqrt(5.0)) / 300.0 * shape.volume();
  for (int k = 0; k < 3; k++) EXPECT_NEAR(shape.principal_moments()[k], inertia, 1e-12);
}

/* By parts along each axis: the rounded box is the product of nothing, but a sum of its core, 6
   slabs, 12 quarters of cylinders and 8 octants of a ball. */

TEST(ConvexMass, RoundedBox)
{
  const double a = 1.0, b = 1.5, c = 0.7, r = 0.2;
  const ConvexShape box = ConvexShape::box({a, b, c}, r);
  const double volume = a * b * c + 2.0 * r * (a * b + b * c + c * a) + pi * r * r * (a + b + c) +
                        4.0 / 3.0 * pi * r * r * r;
  EXPECT_NEAR(box.volume(), volume, 1e-13);
  // integral of x^2 over slabs of thickness r beyond h, quarter cylinders, octants
  const auto square = [&](double x, double y, double z) {
    const double h = 0.5 * x;
    const double line = x * x * x / 12.0;    // over the length x
    const double beyond = h * h * r + h * r * r + r * r * r / 3.0;
    const double quarter =
        pi * r * r / 4.0 * h * h + 2.0 * h * r * r * r / 3.0 + pi * r * r * r * r / 16.0;
    const double octant = pi * r * r * r / 6.0 * h * h + 2.0 * h * pi * std::pow(r, 4) / 16.0 +
                          pi * std::pow(r, 5) / 30.0;
    return line * (y * z + 2.0 * r * (y + z) + pi * r * r) + 2.0 * beyond * y * z +
           4.0 * quarter * (y + z) + 8.0 * octant;
  };
  const double xx = square(a, b, c), yy = square(b, c, a), zz = square(c, a, b);
  EXPECT_NEAR(box.principal_moments()[0], yy + zz, 1e-13);
  EXPECT_NEAR(box.principal_moments()[1], zz + xx, 1e-13);
  EXPECT_NEAR(box.principal_moments()[2], xx + yy, 1e-13);
  EXPECT_NEAR(box.bounding_radius(), 0.5 * std::sqrt(a * a + b * b + c * c) + r, 1e-14);
}

TEST(ConvexMass, RoundingOfNothingIsASphere)
{
  const double s = 1.0e-5;
  const ConvexShape shape =
      ConvexShape::polyhedron({{0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}}, 1.0);
  EXPECT_NEAR(shape.volume(), 4.0 / 3.0 * pi, 1e-4);
  for (int k = 0; k < 3; k++) EXPECT_NEAR(shape.principal_moments()[k], 8.0 / 15.0 * pi, 1e-4);
}

/* A body without any symmetry against points in space (Halton's sequence). A point belongs to the
   rounded body if its distance from the core, by the nearest point of all triangles, is small. */

TEST(ConvexMass, RoundedWithoutSymmetryAgainstPointsInSpace)
{
  const Points corners{
      {0.1, 0.0, 0.2}, {1.0, 0.1, 0.0}, {0.2, 0.8, -0.1}, {0.3, 0.4, 1.1}, {0.9, 0.7, 0.6}};
  const double r = 0.3;
  const ConvexShape shape = ConvexShape::polyhedron(corners, r);
  const ConvexCore &core = shape.core();
  const auto halton = [](int n, int base) {
    double f = 1.0, sum = 0.0;
    for (; n; n /= base) sum += (f /= base) * (n % base);
    return sum;
  };
  const auto inside = [&](const Vector3<double> &p) {
    double highest = -1.0;
    for (int f = 0; f < core.num_faces(); f++)
      highest = std::max(highest, dot(core.normal(f), p) - core.offset(f));
    if (highest <= 0.0) return true;
    if (highest > r) return false;
    for (int f = 0; f < core.num_faces();
         f++) {    // the nearest of an edge or of the inside of a face
      const int count = core.num_corners(f);
      bool over = true;
      for (int k = 0; k < count; k++) {
        const auto x = core.vertex(core.corners(f)[k]),
                   y = core.vertex(core.corners(f)[(k + 1) % count]);
        over = over && dot(cross(core.normal(f), y - x), p - x) >= 0.0;
        const double t = std::clamp(dot(p - x, y - x) / dot(y - x, y - x), 0.0, 1.0);
        if (length(p - x - t * (y - x)) <= r) return true;
      }
      const double height = dot(core.normal(f), p) - core.offset(f);
      if (over && height >= 0.0 && height <= r) return true;
    }
    return false;
  };
  const double half = shape.bounding_radius();
  const int count = 1000000;
  double hits = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int n = 1; n <= count; n++) {
    const Vector3<double> p{half * (2.0 * halton(n, 2) - 1.0), half * (2.0 * halton(n, 3) - 1.0),
                            half * (2.0 * halton(n, 5) - 1.0)};
    if (!inside(p)) continue;
    hits += 1.0;
    sum += to_eigen(p);
    squares += to_eigen(p) * to_eigen(p).transpose();
  }
  const double cell = 8.0 * half * half * half / count;
  EXPECT_NEAR(cell * hits / shape.volume(), 1.0, 1e-3);
  EXPECT_LT((sum / hits).norm(), 1e-3);
  const Eigen::Matrix3d inertia = cell * (squares.trace() * Eigen::Matrix3d::Identity() - squares);
  const Eigen::Matrix3d expected = shape.principal_moments().asDiagonal();
  EXPECT_LT((inertia - expected).norm(), 2e-3 * expected.norm());
}

TEST(ConvexFrame, LeadsBackToWhatWasGiven)
{
  RandomBodies random(7);
  for (int trial = 0; trial < 20; trial++) {
    const Points corners = random.corners(12, {1.0, 2.0, 0.5});
    const ConvexShape shape = ConvexShape::polyhedron(corners, 0.1);
    const ConvexCore &core = shape.core();
    EXPECT_EQ(core.num_vertices(), 12);
    for (int v = 0; v < 12; v++)
      EXPECT_LT(length(shape.given_frame().point_in_space(core.vertex(v)) - corners[v]), 1e-13);
    EXPECT_NEAR(shape.given_frame().rotation.determinant(), 1.0, 1e-13);
    const MassProperties body = mass_properties(core, 0.1);
    EXPECT_LT(body.center.norm(), 1e-13);
    const Eigen::Matrix3d inertia = body.inertia();
    EXPECT_LT((inertia - Eigen::Matrix3d(inertia.diagonal().asDiagonal())).norm(), 1e-12);
  }
}

TEST(ConvexHull, FacesOfManyVertices)
{
  RandomBodies random(11);
  for (const int count : {4, 5, 8, 30, 100, 500, 1500}) {
    const ConvexShape shape = ConvexShape::polyhedron(random.corners(count, {1.0, 1.0, 1.0}), 0.0);
    expect_closed(shape.core());
    EXPECT_GE(shape.core().num_vertices(), count - count / 50);
  }
}

TEST(ConvexHull, PointsInFacesAndEdgesAreLeftOut)
{
  Points grid;
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      for (int k = 0; k < 4; k++)
        if (i % 3 == 0 || j % 3 == 0 || k % 3 == 0) grid.push_back({0.1 * i, 0.1 * j, 0.1 * k});
  const ConvexShape cube = ConvexShape::polyhedron(grid, 0.0);
  EXPECT_EQ(cube.core().num_vertices(), 8);
  EXPECT_EQ(cube.core().num_faces(), 6);
  EXPECT_NEAR(cube.volume(), 0.027, 1e-15);
  expect_closed(cube.core());
}

TEST(ConvexHull, CoordinatesWithFewDigits)
{
  Points corners = dodecahedron_corners();
  Eigen::Quaterniond q = RandomBodies(3).orientation();
  for (auto &c : corners) {
    c = from_eigen(q * to_eigen(c));
    for (double *x : {&c.x, &c.y, &c.z}) *x = std::round(*x * 1.0e5) * 1.0e-5;
  }
  const ConvexShape shape = ConvexShape::polyhedron(corners, 0.0);
  EXPECT_EQ(shape.core().num_faces(), 12);
  expect_closed(shape.core());
}

TEST(ConvexHull, ExtremeShapes)
{
  RandomBodies random(5);
  expect_closed(ConvexShape::polyhedron(random.corners(40, {50.0, 1.0, 1.0}), 0.0).core());
  expect_closed(ConvexShape::polyhedron(random.corners(40, {50.0, 50.0, 1.0}), 0.0).core());
  expect_closed(ConvexShape::polyhedron(random.corners(40, {1.0e-6, 5.0e-6, 1.0e-7}), 0.0).core());
  expect_closed(ConvexShape::polyhedron(random.corners(40, {1.0e6, 5.0e6, 1.0e5}), 0.0).core());
  Points prism;    // 200 corners in one plane
  for (int k = 0; k < 200; k++)
    for (const double z : {-0.1, 0.1})
      prism.push_back({std::cos(k * pi / 100), std::sin(k * pi / 100), z});
  const ConvexShape coin = ConvexShape::polyhedron(prism, 0.0);
  EXPECT_EQ(coin.core().num_faces(), 202);
  expect_closed(coin.core());
}

TEST(ConvexErrors, Vertices)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
               "it has 3 vertices: a body has 4 or more");
  expect_error(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}}),
               "in one plane: give a body that has a volume");
  expect_error(error_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}),
               "on one line: give a body that has a volume");
  expect_error(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}),
               "vertex 5 is the same point as vertex 2: give every vertex once");
  expect_error(error_of({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}, {0, 0, 1}}),
               "vertex 3 has a coordinate that is not a finite number");
  expect_error(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}}),
               "vertex 5 is inside the hull of the others");
  expect_error(error_of(dodecahedron_corners(), -0.1),
               "the rounding radius is -0.1: it must be 0 or positive");
  expect_error(error_of(dodecahedron_corners(), nan), "it must be 0 or positive");
}

TEST(ConvexErrors, Box)
{
  for (const double edge : {0.0, -1.0, std::numeric_limits<double>::infinity()}) try {
      ConvexShape::box({1.0, edge, 1.0}, 0.0);
      ADD_FAILURE() << edge;
    } catch (const std::runtime_error &error) {
      expect_error(error.what(), "it must be positive");
    }
}

TEST(ConvexStl, ClosedConvexFile)
{
  const ConvexShape shape = ConvexShape::polyhedron(dodecahedron_corners(), 0.0);
  const ConvexShape read = ConvexShape::stl(stl_of(shape.core_surface()), 0.001, 0.0001);
  EXPECT_EQ(read.core().num_faces(), 12);
  EXPECT_NEAR(mass_properties(read.core(), 0.0).volume, 1e-9 * shape.volume(), 1e-16);
}

TEST(ConvexStl, WhatIsRefused)
{
  const auto error = [](const std::vector<Triangle> &triangles, double scale = 1.0) -> std::string {
    try {
      ConvexShape::stl(stl_of(triangles), scale, 0.0);
    } catch (const std::runtime_error &wrong) {
      return wrong.what();
    }
    return "";
  };
  std::vector<Triangle> surface = ConvexShape::box({1.0, 1.0, 1.0}, 0.0).core_surface();
  expect_error(error(surface, 0.0), "the scale is 0: it must be positive");
  // two cubes that share a corner region are not one convex body: the second one smaller, on top
  std::vector<Triangle> two = surface;
  for (Triangle t : surface) {
    for (auto &p : t.corner) p = 0.5 * p + Vector3<double>{0.0, 0.0, 1.0};
    two.push_back(t);
  }
  expect_error(error(two), "it is not convex");
  surface.pop_back();
  expect_error(error(surface), "its surface is open at 3 edges: close it");
}

TEST(ConvexSurface, RoundedSurfaceIsClosedAndApproachesTheVolume)
{
  const ConvexShape shape =
      ConvexShape::polyhedron(RandomBodies(2).corners(20, {1.0, 0.8, 0.6}), 0.2);
  double volume = 0.0;
  Vector3<double> area{0.0, 0.0, 0.0};
  for (const Triangle &t : shape.surface(8)) {
    const Vector3<double> n = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
    volume += dot(t.corner[0], n) / 6.0;
    area = area + n;
  }
  EXPECT_LT(length(area), 1e-12);
  EXPECT_NEAR(volume / shape.volume(), 1.0, 0.01);
}
