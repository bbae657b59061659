// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// On which side of a mesh spheres are touched: files whose triangles face any side, what is inside,
// thin plates, and what is said of spheres that went through or are on a side that does not act.

#include "body/shape/mesh_interior.h"
#include "body/shape/mesh_shape.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace Talus;

namespace {

using V = Vector3<double>;

/// The surface of a box as n x n squares on each side, each cut into two; normals outward.
std::vector<Triangle> box(const V &low, const V &high, int n)
{
  std::vector<Triangle> soup;
  const double lo[3] = {low.x, low.y, low.z}, hi[3] = {high.x, high.y, high.z};
  for (int axis = 0; axis < 3; axis++)
    for (const bool upper : {false, true})
      for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
          const int u = (axis + 1) % 3, v = (axis + 2) % 3;
          const auto at = [&](int a, int b) {
            double p[3];
            p[axis] = upper ? hi[axis] : lo[axis];
            p[u] = a == n ? hi[u] : lo[u] + (hi[u] - lo[u]) * a / n;
            p[v] = b == n ? hi[v] : lo[v] + (hi[v] - lo[v]) * b / n;
            return V{p[0], p[1], p[2]};
          };
          const V a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          soup.push_back(upper ? Triangle{{a, b, c}} : Triangle{{a, c, b}});
          soup.push_back(upper ? Triangle{{a, c, d}} : Triangle{{a, d, c}});
        }
  return soup;
}

/// The lateral surface of a cylinder about z of facets, normals outward.
std::vector<Triangle> pipe(int facets)
{
  const auto at = [facets](int k, double z) {
    const double angle = 2.0 * std::acos(-1.0) * k / facets;
    return V{std::cos(angle), std::sin(angle), z};
  };
  std::vector<Triangle> soup;
  for (int k = 0; k < facets; k++) {
    soup.push_back({{at(k, 0.0), at(k + 1, 0.0), at(k + 1, 1.0)}});
    soup.push_back({{at(k, 0.0), at(k + 1, 1.0), at(k, 1.0)}});
  }
  return soup;
}

void shuffle_sides(std::vector<Triangle> &soup, RandomSource &random)
{
  for (Triangle &t : soup)
    if (random.chance(0.5)) std::swap(t.corner[1], t.corner[2]);
}

std::vector<NearPart> near(const MeshShape &mesh, const V &x, double reach)
{
  std::vector<NearPart> parts;
  mesh.is_near(x, reach, parts);
  return parts;
}

NearParts view(const std::vector<NearPart> &parts)
{
  return {parts.data(), parts.data() + parts.size()};
}

std::vector<SurfaceContact> contacts(const MeshShape &mesh, const V &x, double r)
{
  const auto parts = near(mesh, x, r);
  std::vector<SurfaceContact> found(LargeBodyShape::max_contacts);
  found.resize(mesh.find_contacts(x, r, view(parts), found.data()));
  return found;
}

// Facets of a smooth surface: the force on a sphere turns at once where they make a hollow.
TEST(MeshSides, JumpsAreOnTheHollowSideOfFacets)
{
  const auto jumps = [](const std::vector<Triangle> &soup, MeshSide side) {
    return MeshShape(TriangleMesh(soup), side).has_jumps();
  };
  EXPECT_TRUE(jumps(pipe(16), MeshSide::BACKS));
  EXPECT_FALSE(jumps(pipe(16), MeshSide::NORMALS));
  EXPECT_TRUE(jumps(pipe(16), MeshSide::BOTH));
  EXPECT_FALSE(jumps(pipe(8), MeshSide::BACKS)) << "these are edges, where both facets are touched";
  EXPECT_FALSE(jumps(box({0, 0, 0}, {1, 1, 1}, 3), MeshSide::BOTH));
}

TEST(MeshInside, RandomAndRegularPoints)
{
  RandomSource random(5);
  const V low{0.1, -0.3, 0.2}, high{1.1, 0.7, 2.2};
  std::vector<Triangle> soup = box(low, high, 4);
  for (const Triangle &t : box({0.3, -0.1, 0.4}, {0.9, 0.5, 2.0}, 3))
    soup.push_back(t);    // cavity
  shuffle_sides(soup, random);
  const TriangleMesh mesh(soup, true);
  ASSERT_TRUE(mesh.report().closed());
  EXPECT_NEAR(std::fabs(mesh.volume()), 2.0 - 0.6 * 0.6 * 1.6, 1e-12)
      << "parts face as they should";
  const MeshInterior interior(mesh);
  const auto within = [](const V &x, const V &a, const V &b) {
    return x.x > a.x && x.x < b.x && x.y > a.y && x.y < b.y && x.z > a.z && x.z < b.z;
  };
  const auto expected = [&](const V &x) {
    return within(x, low, high) && !within(x, {0.3, -0.1, 0.4}, {0.9, 0.5, 2.0});
  };
  int inside = 0;
  for (int n = 0; n < 4000; n++) {
    V x{random.uniform(0.0, 1.2), random.uniform(-0.4, 0.8), random.uniform(0.1, 2.3)};
    // rays through corners and edges of the triangulation
    if (n % 3 == 0) x = {x.x, low.y + 0.25 * random.below(5), low.z + 0.5 * random.below(5)};
    if (n % 3 == 1) x = {x.x, -0.1 + 0.2 * random.below(4), x.z};
    const double margin = 1e-9;
    if (expected(x + V{0, margin, margin}) != expected(x - V{0, margin, margin})) continue;
    EXPECT_EQ(interior.contains(x), expected(x)) << x.x << " " << x.y << " " << x.z;
    inside += expected(x);
  }
  EXPECT_GT(inside, 500);
}

TEST(MeshSides, TrianglesOfAnyOrientationActAsOneSurface)
{
  RandomSource random(9);
  const std::vector<Triangle> good = box({0, 0, 0}, {1, 1, 1}, 5);
  const MeshShape whole(TriangleMesh(good), MeshSide::NORMALS);
  for (int trial = 0; trial < 6; trial++) {
    std::vector<Triangle> soup = good;
    shuffle_sides(soup, random);
    EXPECT_GT(TriangleMesh(soup).report().inconsistent_edges, 50);
    MeshShape mesh(TriangleMesh(soup, true), MeshSide::BOTH);
    EXPECT_TRUE(mesh.surface().report().closed());
    EXPECT_GT(mesh.surface().report().repaired_edges, 50);
    for (const bool inside : {false, true}) {
      mesh.set_side(mesh.side_within(inside));
      int touched = 0;
      for (int n = 0; n < 300; n++) {
        const V x{random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2)};
        const bool is_in = x.x > 0 && x.x < 1 && x.y > 0 && x.y < 1 && x.z > 0 && x.z < 1;
        const auto found = contacts(mesh, x, 0.15);
        if (is_in != inside) {
          EXPECT_TRUE(found.empty());
          continue;
        }
        touched += !found.empty();
        if (inside) {
          for (const SurfaceContact &c : found)
            EXPECT_GT(dot(c.normal, V{0.5, 0.5, 0.5} - x), 0.0) << "pushed inward";
          continue;
        }
        const auto expected = contacts(whole, x, 0.15);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); k++) {
          EXPECT_NEAR(found[k].overlap, expected[k].overlap, 1e-14);
          EXPECT_NEAR(length(found[k].normal - expected[k].normal), 0.0, 1e-13);
        }
      }
      EXPECT_GT(touched, 30);
    }
  }
}

TEST(MeshSides, PartsMayGoThroughEachOther)
{
  // a vessel, and in it a paddle that sticks out through the wall at one end
  std::vector<Triangle> soup = box({0, 0, 0}, {4, 4, 4}, 3);
  for (Triangle &t : soup) std::swap(t.corner[1], t.corner[2]);
  for (const Triangle &t : box({-0.5, 1, 0}, {1, 1.5, 4}, 1)) soup.push_back(t);
  for (const bool turned : {false, true}) {
    if (turned)
      for (std::size_t t = 108; t < soup.size(); t++)
        std::swap(soup[t].corner[1], soup[t].corner[2]);
    MeshShape mesh(TriangleMesh(soup, true), MeshSide::BOTH);
    mesh.set_side(mesh.side_within(true));
    const auto at_paddle = contacts(mesh, {0.5, 1.6, 2.1}, 0.2);
    ASSERT_EQ(at_paddle.size(), 1U);
    EXPECT_NEAR(at_paddle[0].normal.y, 1.0, 1e-14);
    const auto at_wall = contacts(mesh, {0.1, 3.1, 2.1}, 0.2);
    ASSERT_EQ(at_wall.size(), 1U);
    EXPECT_NEAR(at_wall[0].normal.x, 1.0, 1e-14);
    EXPECT_TRUE(contacts(mesh, {-0.1, 3.1, 2.1}, 0.2).empty());
  }
}

TEST(MeshSides, AThinPlateTouchesOnce)
{
  // closed, a wedge whose faces are not quite parallel
  std::vector<Triangle> soup = box({-2, -2, -0.05}, {2, 2, 0.0}, 3);
  for (Triangle &t : soup)
    for (V &p : t.corner)
      if (p.z < 0.0) p.z -= 0.05 * (p.x + 2.0);
  const MeshShape plate(TriangleMesh(soup, true), MeshSide::BOTH);
  const auto above = contacts(plate, {0.3, 0.1, 0.25}, 0.5);
  ASSERT_EQ(above.size(), 1U);
  EXPECT_NEAR(above[0].overlap, 0.25, 1e-14);
  EXPECT_NEAR(above[0].normal.z, 1.0, 1e-14);
  const auto below = contacts(plate, {0.3, 0.1, -0.5}, 0.5);
  ASSERT_EQ(below.size(), 1U);
  EXPECT_LT(below[0].normal.z, -0.99);
}

TEST(MeshSides, WhatWentThroughIsNoticed)
{
  RandomSource random(11);
  const MeshShape plate(TriangleMesh(box({-1, -1, -3}, {1, 1, 0}, 4), true), MeshSide::NORMALS);
  int through = 0;
  for (int n = 0; n < 500; n++) {
    V from{random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), random.uniform(0.0, 0.3)};
    V to{random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), random.uniform(-0.3, 0.1)};
    if (n % 4 == 0) from.x = to.x = 0.5 * random.below(3) - 0.5;    // through edges
    if (n % 8 == 0) from.y = to.y = 0.5 * random.below(3) - 0.5;    // and corners
    const double s = from.z / (from.z - to.z);
    const V at = from + s * (to - from);
    const bool expected = to.z < 0.0 && std::fabs(at.x) < 1.0 && std::fabs(at.y) < 1.0;
    const bool beside = to.z < 0.0 && !expected;    // perhaps through another face
    const auto parts = near(plate, from, 4.0);
    const Passage down = plate.passage(from, to, view(parts));
    if (!beside) {
      ASSERT_EQ(down.part >= 0, expected) << n;
    }
    if (!expected) continue;
    through++;
    EXPECT_TRUE(down.from_acting_side);
    const auto parts_below = near(plate, to, 4.0);
    const Passage up = plate.passage(to, from, view(parts_below));
    ASSERT_GE(up.part, 0);
  }
  EXPECT_GT(through, 150);
  const auto parts = near(plate, {0.1, 0.2, -0.1}, 0.5);
  EXPECT_FALSE(plate.passage({0.1, 0.2, -0.1}, {0.1, 0.2, 0.1}, view(parts)).from_acting_side);
}

TEST(MeshSides, WhatIsOnTheOtherSideIsNoticed)
{
  const MeshShape block(TriangleMesh(box({0, 0, 0}, {1, 1, 1}, 2), true), MeshSide::NORMALS);
  const auto idle = [&](const V &x) {
    const auto parts = near(block, x, 0.4);
    return block.idle_part(x, 0.3, view(parts));
  };
  EXPECT_GE(idle({0.5, 0.4, 0.9}), 0);
  EXPECT_GE(idle({0.02, 0.02, 0.03}), 0);
  EXPECT_EQ(idle({0.5, 0.4, 1.1}), -1);
  EXPECT_EQ(idle({0.5, 0.5, 0.5}), -1) << "out of reach";
  EXPECT_EQ(idle({-0.1, -0.1, -0.1}), -1) << "at a corner";
  const MeshShape thin(TriangleMesh(box({-2, -2, -0.05}, {2, 2, 0.0}, 3), true), MeshSide::NORMALS);
  const V above{0.3, 0.1, 0.2};
  EXPECT_EQ(thin.idle_part(above, 0.3, view(near(thin, above, 0.4))), -1);
}

TEST(MeshSides, AStripWithATwistHasNoSides)
{
  std::vector<Triangle> soup;
  constexpr int n = 24;
  const auto at = [](int k, double w) {
    const double a = 2.0 * std::acos(-1.0) * (k % n) / n, half = 0.5 * a;
    const double r = 1.0 + w * std::cos(half);
    return V{r * std::cos(a), r * std::sin(a), w * std::sin(half)};
  };
  for (int k = 0; k < n; k++) {
    const double s = k + 1 == n ? -1.0 : 1.0;    // the ends meet turned over
    const V a = at(k, -0.3), b = at(k, 0.3), c = at(k + 1, 0.3 * s), d = at(k + 1, -0.3 * s);
    soup.push_back({{a, b, c}});
    soup.push_back({{a, c, d}});
  }
  const TriangleMesh strip(soup, true);
  EXPECT_EQ(strip.report().inconsistent_edges, 1);
  EXPECT_FALSE(strip.report().closed());
}

}    // namespace
