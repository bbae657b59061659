// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Box, ball, cylinder and cone against closed forms, and against the same solids made of triangles.

#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

using namespace Talus;

namespace {

using V = Vector3<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

V random_point(RandomSource &random, double half)
{
  const auto p = random.in_cube(half);
  return {p[0], p[1], p[2]};
}

struct Found {
  int count;
  SurfaceContact contact[LargeBodyShape::max_contacts];
};

Found contacts_of(const LargeBodyShape &shape, const V &x, double r)
{
  std::vector<NearPart> parts;
  Found f{0, {}};
  if (!shape.is_near(x, r, parts)) return f;
  f.count = shape.find_contacts(x, r, {parts.data(), parts.data() + parts.size()}, f.contact);
  return f;
}

void expect_contact(const SurfaceContact &c, const V &normal, double overlap)
{
  EXPECT_NEAR(length(c.normal - normal), 0.0, 1e-13);
  EXPECT_NEAR(c.overlap, overlap, 1e-13);
}

/// Rules that every shape keeps: unit normals, overlap > 0, the same answer from touches() and
/// find_contacts(), and nothing touched beyond the bound of the broad phase.
void check_rules(const LargeBodyShape &shape, double half, int least)
{
  RandomSource random(11);
  int touched = 0;
  for (int n = 0; n < 4000; n++) {
    const V x = random_point(random, half);
    const double r = random.uniform(0.05, 0.5);
    const Found f = contacts_of(shape, x, r);
    SurfaceContact deepest;
    ASSERT_EQ(shape.touches(x, r, deepest), f.count > 0);
    ASSERT_LE(f.count, shape.most_contacts());
    if (f.count) {
      ASSERT_LT(shape.distance_bound(x), r);
      ASSERT_EQ(deepest.overlap, f.contact[0].overlap);
    }
    for (int k = 0; k < f.count; k++) {
      ASSERT_NEAR(length(f.contact[k].normal), 1.0, 1e-14);
      ASSERT_GT(f.contact[k].overlap, 0.0);
      if (k) {
        ASSERT_GE(f.contact[k - 1].overlap, f.contact[k].overlap);
      }
    }
    touched += f.count > 0;
  }
  EXPECT_GT(touched, least);
}

TEST(Primitives, KeepTheRules)
{
  const V c{0.1, -0.2, 0.3}, axis{0.6, 0.0, 0.8};
  for (const bool inside : {false, true}) {
    check_rules(Box(c, {2.0, 1.4, 1.1}, inside), 1.5, 300);
    check_rules(Ball(c, 0.9, inside), 1.5, 300);
    check_rules(Frustum(c, axis, 0.6, 0.6, 1.5, inside), 1.5, 300);
    check_rules(Frustum(c, axis, 0.6, 0.6, infinity, inside), 1.5, 300);
    check_rules(Frustum(c, axis, 0.3, 0.9, 1.5, inside), 1.5, 300);
    check_rules(Frustum(c, axis, 0.0, 0.9, 1.5, inside), 1.5, 300);
  }
}

TEST(Primitives, BoxFromOutside)
{
  const Box box({1, 2, 3}, {2, 4, 6}, false);    // 0 ... 2, 0 ... 4, 0 ... 6
  Found f = contacts_of(box, {2.2, 1.0, 1.0}, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {1, 0, 0}, 0.1);
  f = contacts_of(box, {2.3, 4.4, 1.0}, 0.6);    // edge: 0.5 away
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0.6, 0.8, 0.0}, 0.1);
  f = contacts_of(box, {-0.2, -0.3, 6.6}, 0.8);    // corner: 0.7 away
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], 1.0 / 0.7 * V{-0.2, -0.3, 0.6}, 0.1);
  f = contacts_of(box, {1.0, 3.8, 3.0}, 0.3);    // deep: out through the nearest face
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 1, 0}, 0.5);
  EXPECT_EQ(contacts_of(box, {1.0, 2.0, 3.0}, 0.3).count, 0);    // deeper than its radius
  EXPECT_EQ(contacts_of(box, {2.3, 4.4, 1.0}, 0.499).count, 0);
}

/// Memory is set aside for so many: also where a sphere is wider than what holds it.
TEST(Primitives, NoMoreContactsThanTold)
{
  const V c{0.1, -0.2, 0.3}, axis{0.2, 0.3, 0.9};
  const Box box(c, {1.6, 1.6, 0.8}, true), narrow(c, {0.8, 0.8, 0.8}, true);
  const Frustum can(c, axis, 0.4, 0.4, 0.8, true), cone(c, axis, 0.2, 0.6, 0.8, true);
  int most_of_narrow = 0;
  for (const LargeBodyShape *shape :
       {(const LargeBodyShape *) &box, (const LargeBodyShape *) &narrow,
        (const LargeBodyShape *) &can, (const LargeBodyShape *) &cone}) {
    RandomSource random(7);
    for (int n = 0; n < 2000; n++) {
      const Found f = contacts_of(*shape, c + random_point(random, 0.5), random.uniform(0.3, 1.2));
      ASSERT_LE(f.count, shape->most_contacts());
      if (shape == &narrow) most_of_narrow = std::max(most_of_narrow, f.count);
    }
  }
  EXPECT_EQ(most_of_narrow, 6);
}

TEST(Primitives, BoxFromInside)
{
  const Box box({1, 2, 3}, {2, 4, 6}, true);
  Found f = contacts_of(box, {0.25, 3.8, 5.9}, 0.3);
  ASSERT_EQ(f.count, 3);    // deepest first
  expect_contact(f.contact[0], {0, 0, -1}, 0.2);
  expect_contact(f.contact[1], {0, -1, 0}, 0.1);
  expect_contact(f.contact[2], {1, 0, 0}, 0.05);
  f = contacts_of(box, {-0.1, 2.0, 3.0}, 0.3);    // center behind a face
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {1, 0, 0}, 0.4);
  EXPECT_EQ(contacts_of(box, {-0.31, 2.0, 3.0}, 0.3).count, 0);
  EXPECT_EQ(contacts_of(box, {1.0, 2.0, 3.0}, 0.3).count, 0);
}

TEST(Primitives, BallFromBothSides)
{
  const V c{1, 1, 1};
  Found f = contacts_of(Ball(c, 2.0, false), c + V{0, 2.2, 0}, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 1, 0}, 0.1);
  f = contacts_of(Ball(c, 2.0, false), c + V{0, 1.9, 0}, 0.3);    // deep
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 1, 0}, 0.4);
  f = contacts_of(Ball(c, 2.0, true), c + V{0, 1.9, 0}, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, -1, 0}, 0.2);
  EXPECT_EQ(contacts_of(Ball(c, 2.0, true), c + V{0, 2.4, 0}, 0.3).count, 0);
  EXPECT_EQ(contacts_of(Ball(c, 0.2, true), c, 0.3).count, 0);
}

TEST(Primitives, CylinderMantleCapsAndRim)
{
  const V z{0, 0, 1};
  const Frustum outside({0, 0, 0}, z, 1.0, 1.0, 4.0, false),
      inside({0, 0, 0}, z, 1.0, 1.0, 4.0, true);
  Found f = contacts_of(outside, {0.0, 1.2, 0.5}, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 1, 0}, 0.1);
  f = contacts_of(outside, {0.3, 0.2, -2.2}, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 0, -1}, 0.1);
  f = contacts_of(outside, {1.3, 0.0, 2.4}, 0.6);    // rim: 0.5 away
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0.6, 0.0, 0.8}, 0.1);
  f = contacts_of(inside, {0.0, -0.8, 1.85}, 0.3);    // where lateral surface and cap meet
  ASSERT_EQ(f.count, 2);
  expect_contact(f.contact[0], {0, 0, -1}, 0.15);
  expect_contact(f.contact[1], {0, 1, 0}, 0.1);
  const Frustum endless({0, 0, 0}, z, 1.0, 1.0, infinity, true);
  f = contacts_of(endless, {0.0, -0.8, 1.0e6}, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 1, 0}, 0.1);
}

TEST(Primitives, ConeMantle)
{
  // r = 1 + 0.75 s: outward normal (0.8, -0.6), a slope of 3 : 4
  const V z{0, 0, 1};
  const Frustum outside({0, 0, 0}, z, 0.25, 1.75, 2.0, false),
      inside({0, 0, 0}, z, 0.25, 1.75, 2.0, true);
  const V on{1.0, 0.0, 0.0}, normal{0.8, 0.0, -0.6};
  Found f = contacts_of(outside, on + 0.2 * normal, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], normal, 0.1);
  f = contacts_of(inside, on - 0.2 * normal, 0.3);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], -normal, 0.1);
  f = contacts_of(outside, {0.0, 0.25, -1.5}, 0.6);    // small cap, straight below its rim
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 0, -1}, 0.1);
  const Frustum tip({0, 0, 0}, z, 0.0, 1.5, 2.0, false);
  f = contacts_of(tip, {0.0, 0.0, -1.4}, 0.5);
  ASSERT_EQ(f.count, 1);
  expect_contact(f.contact[0], {0, 0, -1}, 0.1);
}

// The same box of triangles: the same contacts, at faces, edges, corners, from both sides.
TEST(Primitives, BoxOfTrianglesAgrees)
{
  for (const bool inside : {false, true}) {
    const Box box({0.1, 0.2, -0.1}, {2.0, 1.6, 1.2}, inside);
    std::vector<Triangle> soup;
    box.tessellate({}, soup);
    if (inside)
      for (Triangle &t : soup) std::swap(t.corner[0], t.corner[1]);
    const MeshShape mesh(TriangleMesh(soup), MeshSide::NORMALS);
    EXPECT_TRUE(mesh.surface().report().closed());
    EXPECT_NEAR(mesh.surface().volume(), (inside ? -1.0 : 1.0) * 2.0 * 1.6 * 1.2, 1e-13);
    RandomSource random(5);
    int compared = 0, corners = 0;
    for (int n = 0; n < 6000; n++) {
      const V x = random_point(random, 1.3);
      const double r = random.uniform(0.05, 0.4);
      const V d = x - V{0.1, 0.2, -0.1};
      const bool within = std::fabs(d.x) < 1.0 && std::fabs(d.y) < 0.8 && std::fabs(d.z) < 0.6;
      if (within != inside) continue;    // centers behind the surface: no contact with a mesh
      const Found a = contacts_of(box, x, r), b = contacts_of(mesh, x, r);
      ASSERT_EQ(a.count, b.count);
      for (int k = 0; k < a.count; k++) {
        ASSERT_NEAR(a.contact[k].overlap, b.contact[k].overlap, 1e-13);
        ASSERT_NEAR(length(a.contact[k].normal - b.contact[k].normal), 0.0, 1e-12);
      }
      compared += a.count > 0;
      corners +=
          a.count > 1 || (a.count == 1 && length(cross(a.contact[0].normal, {1, 0, 0})) < 0.9 &&
                          std::fabs(a.contact[0].normal.x) < 0.9);
    }
    EXPECT_GT(compared, 500);
    EXPECT_GT(corners, 50);
  }
}

}    // namespace
