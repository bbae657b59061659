// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids on walls that are curved inward: each place that is touched counts once. On all surfaces forces are
// minus the gradient of the energy; and histories stay with their places.

#include "shape/contact/point_contact.h"
#include "touched_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

/* ---- walls that are curved inward ------------------------------------------------------------- */

TEST(SmoothPlaces, a_place_counts_once_where_curvatures_are_close)
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

TEST(SmoothPlaces, curved_inward_each_place_is_found)
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

TEST(SmoothPlaces, forces_are_minus_the_gradient_of_the_energy)
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

/* ---- names ------------------------------------------------------------------------------------ */

TEST(SmoothPlaces, names_of_places_are_directions)
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

TEST(SmoothPlaces, histories_stay_with_their_places)
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
