// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two superellipsoids, and one and a ball: random pairs, each with a proof of its result; a slow search of all
// directions; known answers; continuity. TALUS_LARGE_TESTS=1: ten million pairs.

#include "all_directions.h"
#include "convex_bodies.h"
#include "shape/superellipsoid/least_overlap.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

int number_of_pairs()
{
  return std::getenv("TALUS_LARGE_TESTS") ? 10000000 : 500000;
}

class RandomPairs : public RandomBodies {
 public:
  using RandomBodies::RandomBodies;

  /// Half axes up to 1:aspect; ellipsoids, or exponents from 2 to 12.
  Superellipsoid shape(double aspect, bool is_ellipsoid)
  {
    const auto axis = [&] { return std::pow(aspect, uniform(-1.0, 0.0)); };
    const double a = axis(), b = axis(), c = axis();
    const auto exponent = [&] {
      return is_ellipsoid || chance(0.2) ? 2.0 : 2.0 * std::pow(6.0, uniform(0.0, 1.0));
    };
    const double n1 = exponent(), n2 = chance(0.3) ? n1 : exponent();
    return {{a, b, c}, n1, n2};
  }
  /// Of a pair whose surfaces touch with a common normal, moved together by `overlap`.
  Pose touching(const Superellipsoid &a, const Superellipsoid &b, double overlap, Vector &normal)
  {
    Pose pose({0.0, 0.0, 0.0}, orientation());
    normal = direction();
    const Vector of_b = pose.direction_in_space(b.at_normal(pose.direction_in_body(normal)).place);
    pose.position = a.at_normal(normal).place + of_b - overlap * normal;
    return pose;
  }
};

/// By which the two reach into each other along a normal.
double overlap_along(const Superellipsoid &a, const Superellipsoid &b, const Pose &seen,
                     const Vector &normal)
{
  return a.at_normal(normal).height + b.at_normal(seen.direction_in_body(normal)).height -
         dot(normal, seen.position);
}

struct Kind {
  double aspect;
  bool ellipsoids;
};
constexpr Kind kinds[] = {{3.0, true}, {3.0, false}, {10.0, true}, {10.0, false}};

/* ---- proofs ----------------------------------------------------------------------------------- */

/// What is apart has a direction that shows it; what touches has a point inside both, the two points a common
/// normal, and less overlap than along the direction from which the pair was made.
TEST(SuperellipsoidPairs, each_result_is_proven)
{
  RandomPairs random(11);
  int touch = 0, apart = 0;
  for (int k = 0; k < number_of_pairs();) {
    const Kind &kind = kinds[random.below(4)];
    std::vector<Superellipsoid> pool;
    for (int n = 0; n < 6; n++) pool.push_back(random.shape(kind.aspect, kind.ellipsoids));
    for (int n = 0; n < 2000; n++, k++) {
      const Superellipsoid &a = pool[random.below(6)], &b = pool[random.below(6)];
      const double least = std::min(a.inscribed_radius(), b.inscribed_radius()),
                   size = a.bounding_radius() + b.bounding_radius();
      const double wanted =
          least * std::pow(10.0, random.uniform(-8.0, -1.3)) * (random.chance(0.5) ? 1.0 : -1.0);
      Vector normal;
      const Pose seen = random.touching(a, b, wanted, normal);
      const CommonNormal found = find_common_normal(a, b, seen);
      ASSERT_NEAR(length(found.normal), 1.0, 1.0e-14);
      ASSERT_NEAR(overlap_along(a, b, seen, found.normal), found.overlap, 1.0e-8 * least);
      if (wanted < 0.0) {
        apart++;
        ASSERT_LT(found.overlap, 0.0) << "pair " << k;
        continue;
      }
      touch++;
      ASSERT_GT(found.overlap, 0.0) << "pair " << k;
      ASSERT_LE(found.overlap, wanted * (1.0 + 1.0e-6) + 1.0e-14 * size) << "pair " << k;
      const Vector between = found.of_a.place - found.place_on_b,
                   middle = 0.5 * (found.of_a.place + found.place_on_b);
      ASSERT_LT(length(between - found.overlap * found.normal), 1.0e-9 * size) << "pair " << k;
      ASSERT_LT(a.gauge(middle), 1.0) << "pair " << k;
      ASSERT_LT(b.gauge(seen.point_in_body(middle)), 1.0) << "pair " << k;
      ASSERT_NEAR(a.gauge(found.of_a.place), 1.0, 1.0e-12);
      ASSERT_NEAR(b.gauge(seen.point_in_body(found.place_on_b)), 1.0, 1.0e-12);
    }
  }
  EXPECT_GT(touch, number_of_pairs() / 3);
  EXPECT_GT(apart, number_of_pairs() / 3);
}

/* ---- the slow twin: all directions ------------------------------------------------------------ */

double least_of_all(const Superellipsoid &a, const Superellipsoid &b, const Pose &seen)
{
  return least_of_all_directions([&](const Vector &n) { return overlap_along(a, b, seen, n); });
}

TEST(SuperellipsoidPairs, agree_with_a_search_of_all_directions)
{
  RandomPairs random(12);
  const int pairs = std::getenv("TALUS_LARGE_TESTS") ? 4000 : 400;
  for (int k = 0; k < pairs; k++) {
    const Kind &kind = kinds[k % 4];
    const Superellipsoid a = random.shape(kind.aspect, kind.ellipsoids),
                         b = random.shape(kind.aspect, kind.ellipsoids);
    const double least = std::min(a.inscribed_radius(), b.inscribed_radius());
    Vector normal;
    const Pose seen = random.touching(a, b, least * random.uniform(-0.02, 0.05), normal);
    const CommonNormal found = find_common_normal(a, b, seen);
    const double expected = least_of_all(a, b, seen);
    ASSERT_EQ(found.overlap > 0.0, expected > 0.0) << "pair " << k;
    if (expected > 0.0) {
      ASSERT_NEAR(found.overlap, expected, 1.0e-9 * least) << "pair " << k;
    }
  }
}

/// Deep ones: still a common normal, and never less than the least.
TEST(SuperellipsoidPairs, deep_overlaps_have_a_common_normal)
{
  RandomPairs random(13);
  int least_found = 0;
  constexpr int pairs = 300;
  for (int k = 0; k < pairs; k++) {
    const Kind &kind = kinds[k % 2];
    const Superellipsoid a = random.shape(kind.aspect, kind.ellipsoids),
                         b = random.shape(kind.aspect, kind.ellipsoids);
    const double least = std::min(a.inscribed_radius(), b.inscribed_radius());
    Vector normal;
    const Pose seen = random.touching(a, b, least * random.uniform(0.1, 0.8), normal);
    const CommonNormal found = find_common_normal(a, b, seen);
    const double expected = least_of_all(a, b, seen);
    ASSERT_GE(found.overlap, expected - 1.0e-9 * least) << "pair " << k;
    ASSERT_NEAR(overlap_along(a, b, seen, found.normal), found.overlap, 1.0e-9 * least);
    if (found.overlap < expected + 1.0e-6 * least) least_found++;
  }
  EXPECT_GT(least_found, 0.98 * pairs);
}

/* ---- known answers ---------------------------------------------------------------------------- */

TEST(SuperellipsoidPairs, spheres)
{
  const Superellipsoid a({0.7, 0.7, 0.7}, 2.0, 2.0), b({0.4, 0.4, 0.4}, 2.0, 2.0);
  RandomPairs random(14);
  for (int k = 0; k < 200; k++) {
    const Vector n = random.direction();
    Pose seen(1.09 * n, random.orientation());
    const CommonNormal found = find_common_normal(a, b, seen);
    EXPECT_NEAR(found.overlap, 0.01, 1.0e-15);
    EXPECT_LT(length(found.normal - n), 1.0e-14);
    EXPECT_LT(length(found.of_a.place - 0.7 * n), 1.0e-14);
    EXPECT_NEAR(found.curvature_of_b, 2.5, 1.0e-13);
    const CommonNormal with_ball = find_common_normal(a, seen.position, 0.4);
    EXPECT_NEAR(with_ball.overlap, 0.01, 1.0e-15);
    EXPECT_LT(length(with_ball.normal - n), 1.0e-14);
    seen.position = 1.11 * n;
    EXPECT_LT(find_common_normal(a, b, seen).overlap, 0.0);
    EXPECT_NEAR(find_common_normal(a, seen.position, 0.4).overlap, -0.01, 1.0e-15);
  }
}

TEST(SuperellipsoidPairs, poles_that_face_each_other)
{
  for (const double n : {2.0, 3.0, 4.0, 8.0}) {
    const Superellipsoid a({0.5, 0.6, 0.7}, n, n), b({0.3, 0.8, 0.4}, n, n);
    Pose seen;
    seen.position = {0.0, 0.0, 1.09};
    const CommonNormal along_z = find_common_normal(a, b, seen);
    EXPECT_NEAR(along_z.overlap, 0.01, 1.0e-14);
    EXPECT_LT(length(along_z.normal - Vector{0, 0, 1}), 1.0e-14);
    seen.position = {0.0, -1.38, 0.0};
    const CommonNormal along_y = find_common_normal(a, b, seen);
    EXPECT_NEAR(along_y.overlap, 0.02, 1.0e-14);
    EXPECT_LT(length(along_y.normal - Vector{0, -1, 0}), 1.0e-14);
  }
}

TEST(SuperellipsoidPairs, the_same_center)
{
  const Superellipsoid a({0.5, 0.6, 0.7}, 2.0, 2.0), b({0.3, 0.8, 0.4}, 4.0, 4.0);
  const CommonNormal found = find_common_normal(a, b, Pose());
  EXPECT_GT(found.overlap, 0.0);
  EXPECT_NEAR(length(found.normal), 1.0, 1.0e-14);
  EXPECT_NEAR(find_common_normal(a, {0.0, 0.0, 0.0}, 0.1).overlap, 0.6, 1.0e-14);
}

/// Of a point the foot on the surface: from the surface outward and inward along its normal.
TEST(SuperellipsoidPairs, points_find_their_foot)
{
  RandomPairs random(15);
  for (int k = 0; k < 20000; k++) {
    const Kind &kind = kinds[k % 4];
    const Superellipsoid a = random.shape(kind.aspect, kind.ellipsoids);
    for (int q = 0; q < 5; q++) {
      const Superellipsoid::Point p = a.on_ray(random.direction());
      const double away = a.inscribed_radius() * random.uniform(-0.02, 2.0);
      const CommonNormal found = find_common_normal(a, p.place + away * p.normal, 0.0);
      // far inside of an edge another foot is nearer
      const double curvature = std::max(p.xx, std::max(p.yy, p.zz));
      if (away < 0.0 && -away * curvature > 0.3) continue;
      ASSERT_NEAR(found.overlap, -away, 1.0e-12) << k;
      ASSERT_LT(length(found.of_a.place - p.place), 1.0e-8) << k;
    }
    k += 19;
  }
}

/* ---- eight at a time -------------------------------------------------------------------------- */

void expect_same(const Vector &x, const Vector &y)
{
  EXPECT_EQ(x.x, y.x);
  EXPECT_EQ(x.y, y.y);
  EXPECT_EQ(x.z, y.z);
}

void expect_same(const ShapeContacts &one, const ShapeContacts &other)
{
  ASSERT_EQ(one.points.size(), other.points.size());
  for (std::size_t n = 0; n < one.points.size(); n++) {
    const ShapeContact &a = one.points[n], &b = other.points[n];
    expect_same(a.normal, b.normal);
    expect_same(a.position, b.position);
    EXPECT_EQ(a.overlap, b.overlap);
    EXPECT_EQ(a.curvature[0], b.curvature[0]);
    EXPECT_EQ(a.curvature[1], b.curvature[1]);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.begins_search, b.begins_search);
  }
}

/// Of pairs as steps ask for them.
struct Jobs {
  explicit Jobs(const Superellipsoid &shape_a, const Superellipsoid &shape_b) :
      a(shape_a), b(shape_b)
  {
  }
  const Superellipsoid &a, &b;
  std::vector<Pose> pose_a, pose_b;
  std::vector<SeparatingDirection> direction;
  std::vector<Vector> start;    // 0: none

  /// b is seen by a at this pose, and a is anywhere.
  void add(const Pose &seen, const Pose &of_a, const Vector &along, const Vector &normal)
  {
    Pose of_b;
    of_b.position = of_a.point_in_space(seen.position);
    of_b.rotation = of_a.rotation * seen.rotation;
    pose_a.push_back(of_a);
    pose_b.push_back(of_b);
    direction.push_back({-of_a.direction_in_space(along)});
    start.push_back(-of_a.direction_in_space(normal));
  }
  const Vector *start_of(std::size_t k) const
  {
    return dot(start[k], start[k]) > 0.0 ? &start[k] : nullptr;
  }
  std::vector<ShapeContacts> together()
  {
    std::vector<ShapeContacts> found(pose_a.size());
    std::vector<CollisionJob> jobs;
    for (std::size_t k = 0; k < pose_a.size(); k++)
      jobs.push_back({&a, &b, &pose_a[k], &pose_b[k], &direction[k], &found[k], start_of(k)});
    many_superellipsoids(jobs.data(), static_cast<int>(jobs.size()));
    return found;
  }
  ShapeContacts alone(std::size_t k) const
  {
    ShapeContacts found;
    CollisionRequest request;
    request.start = start_of(k);
    superellipsoid_and_superellipsoid({a, pose_a[k]}, {b, pose_b[k]}, request, found);
    return found;
  }
};

/// Whatever stands in the other lanes, also pairs that need the second search: those of one at a time.
TEST(SuperellipsoidPairs, eight_have_the_bits_of_one)
{
  RandomPairs random(17);
  int touch = 0, apart = 0;
  for (int k = 0; k < 500; k++) {
    const Kind &kind = kinds[k % 4];
    const Superellipsoid a = random.shape(kind.aspect, kind.ellipsoids),
                         other = random.shape(kind.aspect, kind.ellipsoids), &b = k % 3 ? other : a;
    const double least = std::min(a.inscribed_radius(), b.inscribed_radius());
    Jobs jobs(a, b);
    const int count = 1 + k % 19;
    for (int n = 0; n < count; n++) {
      Vector normal;
      const Pose seen =
          random.touching(a, b, least * random.uniform(-0.05, n ? 0.06 : 0.5), normal);
      const Vector near_by =
                       normal + (std::pow(10.0, random.uniform(-9.0, 0.0))) * random.direction(),
                   start = random.chance(0.3) ? Vector{0.0, 0.0, 0.0}
                                              : (1.0 / length(near_by)) * near_by;
      jobs.add(seen, Pose(4.0 * random.direction(), random.orientation()), normal, start);
    }
    const std::vector<ShapeContacts> found = jobs.together();
    for (int n = 0; n < count; n++) {
      expect_same(found[n], jobs.alone(n));
      (found[n].points.empty() ? apart : touch)++;
    }
  }
  EXPECT_GT(touch, 1500);
  EXPECT_GT(apart, 1500);
}

/* ---- the normal of the step before ------------------------------------------------------------ */

/// From wherever a search begins it finds the same overlap and normal, to rounding.
TEST(SuperellipsoidPairs, begin_where_the_last_step_ended)
{
  RandomPairs random(18);
  for (int k = 0; k < 400; k++) {
    const Kind &kind = kinds[k % 4];
    const Superellipsoid a = random.shape(kind.aspect, kind.ellipsoids),
                         b = random.shape(kind.aspect, kind.ellipsoids);
    const double least = std::min(a.inscribed_radius(), b.inscribed_radius());
    for (int n = 0; n < 100; n++) {
      Vector normal;
      const Pose seen =
          random.touching(a, b, least * std::pow(10.0, random.uniform(-6.0, -1.0)), normal);
      const CommonNormal found = find_common_normal(a, b, seen);
      const Vector near_by =
          found.normal + std::pow(10.0, random.uniform(-9.0, -1.0)) * random.direction();
      const CommonNormal again = find_common_normal(a, b, seen, (1.0 / length(near_by)) * near_by);
      ASSERT_GT(found.overlap, 0.0);
      ASSERT_NEAR(again.overlap, found.overlap, 1.0e-13 * size_of_both(a, b)) << k;
    }
  }
}

/* ---- continuity ------------------------------------------------------------------------------- */

/// Small motions of b change the normal by no more than some times their size, however small they are.
TEST(SuperellipsoidPairs, follow_continuously)
{
  RandomPairs random(16);
  double largest = 0.0;
  for (int k = 0; k < 4000; k++) {
    const Superellipsoid a = random.shape(3.0, true), b = random.shape(3.0, true);
    const double least = std::min(a.inscribed_radius(), b.inscribed_radius());
    Vector normal;
    const Pose seen = random.touching(a, b, 0.02 * least, normal);
    const double step = std::pow(10.0, random.uniform(-9.0, -4.0));
    Pose moved = seen;
    moved.position = moved.position + (step * least) * random.direction();
    const Vector axis = random.direction();
    moved.rotation = Eigen::AngleAxisd(step, to_eigen(axis)).toRotationMatrix() * moved.rotation;
    const CommonNormal before = find_common_normal(a, b, seen),
                       after = find_common_normal(a, b, moved);
    ASSERT_GT(after.overlap, 0.0);
    largest = std::max(largest, length(after.normal - before.normal) / step);
  }
  EXPECT_LT(largest, 60.0);
}

}    // namespace
