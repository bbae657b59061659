// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces and torques of convex particles on surfaces of large bodies, against central differences of
// the energy that their contacts tell: all polyhedra with all surfaces, from 1e-6 of their width deep
// to .3 of it. TALUS_LARGE_TESTS=1: ten times as many poses.

#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/plane.h"
#include "body/shape/rectangle.h"
#include "convex_bodies.h"
#include "shape/contact/body_surfaces.h"
#include "shape/convex/convex_words.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

int number_of_poses()
{
  return std::getenv("TALUS_LARGE_TESTS") ? 400 : 40;
}

/* ---- bodies ---------------------------------------------------------------------------------- */

std::vector<Triangle> triangles_of(const LargeBodyShape &body)
{
  std::vector<Triangle> triangles;
  body.tessellate({Eigen::Vector3d(-2, -2, -2), Eigen::Vector3d(2, 2, 2)}, triangles);
  return triangles;
}

struct Wall {
  Wall(const std::string &wall_name, LargeBodyShape *shape, bool particles_inside = false) :
      name(wall_name), body(shape), triangles(triangles_of(*shape)),
      side(particles_inside ? -1.0 : 1.0)
  {
  }
  std::string name;
  std::unique_ptr<LargeBodyShape> body;
  std::vector<Triangle> triangles;
  double side;    // 1: particles are where normals of the triangles point to; -1: on the other side
};

MeshShape *mesh_of(const Box &box, MeshSide side)
{
  return new MeshShape(TriangleMesh(triangles_of(box)), side);
}

std::vector<Wall> all_walls()
{
  const double endless = std::numeric_limits<double>::infinity();
  const Vector o{0, 0, 0}, up{0, 0, 1}, across{1, 0, 0};
  std::vector<Wall> walls;
  walls.emplace_back("plane", new Plane(o, up, false));
  walls.emplace_back("rectangle", new Rectangle(o, up, across, 1.5, 1.2, false));
  walls.emplace_back("rectangle, two sides", new Rectangle(o, up, across, 1.5, 1.2, true));
  walls.emplace_back("box", new Box(o, {2, 1.5, 1}, false));
  walls.emplace_back("box inside", new Box(o, {4, 5, 6}, true), true);
  walls.emplace_back("ball", new Ball(o, 1, false));
  walls.emplace_back("ball inside", new Ball(o, 2, true), true);
  walls.emplace_back("cylinder", new Frustum(o, up, 1, 1, 2, false));
  walls.emplace_back("thin cylinder", new Frustum(o, up, .3, .3, 2, false));
  walls.emplace_back("endless cylinder", new Frustum(o, up, 1, 1, endless, false));
  walls.emplace_back("cylinder inside", new Frustum(o, up, 2, 2, 6, true), true);
  walls.emplace_back("cone", new Frustum(o, up, 1.2, .3, 2, false));
  walls.emplace_back("cone with a tip", new Frustum(o, up, 1, 0, 2, false));
  walls.emplace_back("cone inside", new Frustum(o, up, 2, 4, 4, true), true);
  walls.emplace_back("mesh", mesh_of(Box(o, {2, 2, 2}, false), MeshSide::NORMALS));
  walls.emplace_back("mesh inside", mesh_of(Box(o, {4, 4, 4}, false), MeshSide::BACKS), true);
  return walls;
}

struct Kind {
  std::string name;
  ConvexShape shape;
};

std::vector<Kind> all_kinds()
{
  const Points tetrahedron = {{.5, .5, .5}, {.5, -.5, -.5}, {-.5, .5, -.5}, {-.5, -.5, .5}};
  Points dodecahedron = dodecahedron_corners();
  for (Vector &x : dodecahedron) x = 0.4 * x;
  std::vector<Kind> kinds;
  for (const double radius : {0.0, 0.05}) {
    const std::string how = radius > 0.0 ? "rounded " : "sharp ";
    kinds.push_back({how + "cube", ConvexShape::box({.9, .9, .9}, radius)});
    kinds.push_back({how + "brick", ConvexShape::box({.6, .5, .4}, radius)});
    kinds.push_back({how + "needle", ConvexShape::box({1, .1, .1}, radius)});
    kinds.push_back({how + "plate", ConvexShape::box({.8, .8, .08}, radius)});
    kinds.push_back({how + "tetrahedron", ConvexShape::polyhedron(tetrahedron, radius)});
    kinds.push_back({how + "dodecahedron", ConvexShape::polyhedron(dodecahedron, radius)});
  }
  kinds.push_back({"ball swept along a brick", ConvexShape::box({.6, .2, .2}, .3)});
  return kinds;
}

/* ---- what contacts tell ----------------------------------------------------------------------- */

struct Place {
  Vector x;
  Eigen::Quaterniond turn;

  /// Along or about an axis.
  Place moved(int degree, double by) const
  {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(degree % 3);
    if (degree < 3) return {x + by * from_eigen(axis), turn};
    return {x, (Eigen::Quaterniond(Eigen::AngleAxisd(by, axis)) * turn).normalized()};
  }
};

struct Told {
  double energy = 0.0, push[6] = {},
         sum = 0.0;    // push: force and torque; sum: of the sizes of forces
};

class Pair {
 public:
  Pair(const Wall &wall, const ConvexShape &particle) :
      types(collisions()), walls(*wall.body, with(types, particle)), shape(particle)
  {
  }
  /// With stiffness 1.
  Told at(const Place &place, double exponent) const
  {
    Told told;
    ShapeContacts contacts;
    const Pose pose(place.x, place.turn);
    for (int w = 0; w < walls.size(); w++) {
      if (!walls.touch(w, {1, shape, pose, exponent}, contacts)) continue;
      for (const ShapeContact &c : contacts.points) {
        const double size = std::pow(c.overlap, exponent);
        const Vector force = (c.weight * size) * c.normal,
                     torque = cross(c.position - place.x, force);
        told.energy += c.energy * size * c.overlap / (exponent + 1.0);
        told.sum += std::fabs(c.weight) * size;
        const double push[6] = {force.x, force.y, force.z, torque.x, torque.y, torque.z};
        for (int d = 0; d < 6; d++) told.push[d] += push[d];
      }
    }
    return told;
  }
  bool touches(const Place &place) const { return at(place, 1.0).energy > 0.0; }
  double width() const { return 2.0 * shape.inscribed_radius(); }

  const ConvexShape &particle() const { return shape; }

 private:
  static const Collisions &collisions()
  {
    static const Collisions all = [] {
      Collisions table;
      add_convex_collisions(table);
      return table;
    }();
    return all;
  }
  static const ShapeTable &with(ShapeTable &table, const ConvexShape &particle)
  {
    table.set(1,
              std::make_shared<ParticleShape>(std::make_shared<const ConvexShape>(particle), 1.0));
    return table;
  }
  ShapeTable types;
  BodySurfaces walls;
  const ConvexShape &shape;
};

/* ---- poses ----------------------------------------------------------------------------------- */

/// In a triangle, on an edge or at a corner of it.
Vector point_of(const Triangle &triangle, RandomBodies &random)
{
  double part[3], sum = 0.0;
  for (double &one : part) sum += one = random.chance(.4) ? 0.0 : random.uniform(0.0, 1.0);
  if (sum == 0.0) return triangle.corner[random.below(3)];
  Vector point{0, 0, 0};
  for (int k = 0; k < 3; k++) point = point + (part[k] / sum) * triangle.corner[k];
  return point;
}

/// In any orientation, one of seven with a face nearly parallel to the wall.
Eigen::Quaterniond turned(RandomBodies &random, const ConvexShape &shape, const Vector &normal)
{
  const Eigen::Quaterniond any = random.orientation();
  if (!random.chance(.15)) return any;
  const Eigen::Vector3d face =
      to_eigen(shape.core().normal(random.below(shape.core().num_faces())));
  const double angle = random.decade(-6, -1);
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, to_eigen(random.direction()))) *
         Eigen::Quaterniond::FromTwoVectors(face, -to_eigen(normal));
}

/// Flies toward the wall until it touches, and by `depth` further. Returns false where it does not.
bool find_place(RandomBodies &random, const Wall &wall, const Pair &pair, double depth,
                Place &place)
{
  const Triangle &triangle = wall.triangles[random.below(static_cast<int>(wall.triangles.size()))];
  const Vector across = cross(triangle.corner[1] - triangle.corner[0],
                              triangle.corner[2] - triangle.corner[0]),
               normal = (wall.side / length(across)) * across;
  const double lean = random.uniform(0.0, 1.2);
  Vector back = normal + lean * random.direction();
  back = (1.0 / length(back)) * back;
  place.turn = turned(random, pair.particle(), normal);
  const Vector aim = point_of(triangle, random) + (.3 * pair.width()) * random.direction();
  const auto at = [&](double away) { return Place{aim + away * back, place.turn}; };
  double in = pair.particle().bounding_radius() + .02, out = in;
  if (pair.touches(at(in))) return false;
  while (!pair.touches(at(in))) {
    out = in;
    in -= .02 * pair.width();
    if (in < -.2) return false;
  }
  for (int step = 0; step < 45; step++) {
    const double middle = 0.5 * (in + out);
    (pair.touches(at(middle)) ? in : out) = middle;
  }
  place = at(in - depth);
  return pair.touches(place);
}

/* ---- comparison ------------------------------------------------------------------------------ */

constexpr double tolerance = 1e-3;    // of forces of 1, with lengths of about 1

struct Comparison {
  int places = 0, kinks = 0, wrong = 0;
  double worst = 0.0;
};

/* Differences of second order from one side and from the other, and of third and fourth order: they
   differ where there is a kink or a jump nearby, as where the direction changes in which a corner or a
   face is nearest to the outside. */

void compare(const Pair &pair, const Place &place, double step, double exponent, Comparison &with)
{
  const Told told = pair.at(place, exponent);
  bool has_kink = false;
  double error = 0.0;
  for (int d = 0; d < 6; d++) {
    double e[5];
    for (int s = 0; s < 5; s++) e[s] = pair.at(place.moved(d, (s - 2) * step), exponent).energy;
    const double unit = 2.0 * step * told.sum, slope = (e[3] - e[1]) / unit,
                 forward = (4.0 * e[3] - 3.0 * e[2] - e[4]) / unit,
                 backward = (3.0 * e[2] - 4.0 * e[1] + e[0]) / unit,
                 third = (e[4] - 2.0 * e[3] + 2.0 * e[1] - e[0]) / unit,
                 fourth = (e[0] - 4.0 * e[1] + 6.0 * e[2] - 4.0 * e[3] + e[4]) / unit;
    if (std::max({std::fabs(forward - backward), std::fabs(third), std::fabs(fourth)}) > tolerance)
      has_kink = true;
    else
      error = std::max(error, std::fabs(slope + told.push[d] / told.sum));
  }
  with.worst = std::max(with.worst, error);
  with.wrong += error > tolerance;
  with.places++;
  with.kinks += has_kink;
}

Comparison compared(const Wall &wall, const ConvexShape &shape)
{
  Comparison all;
  RandomBodies random(7);
  const Pair pair(wall, shape);
  for (int k = 0; k < number_of_poses(); k++) {
    const double depth = pair.width() * random.decade(-6, std::log10(.3));
    Place place;
    if (!find_place(random, wall, pair, depth, place)) continue;
    const double exponent = k % 2 ? 1.5 : 1.0,
                 mean = std::pow((exponent + 1.0) * pair.at(place, exponent).energy,
                                 1.0 / (exponent + 1.0));
    compare(pair, place, 1e-3 * std::min(depth, mean), exponent, all);
  }
  return all;
}

}    // namespace

/* Points that share the force of two sharp bodies lean by a tenth at most, see face_contacts.cpp: the
   torque about its axis is not all there where a face is deep in an edge or corner of a box, in one
   place of fifty. */

TEST(ConvexEnergy, ForcesAreItsGradient)
{
  Comparison all, of_box;
  for (const Wall &wall : all_walls())
    for (const Kind &kind : all_kinds()) {
      const bool is_box = wall.name == "box";
      const Comparison here = compared(wall, kind.shape);
      for (Comparison *sum : {&all, &of_box}) {
        if (sum == &of_box && !is_box) continue;
        sum->places += here.places;
        sum->kinks += here.kinks;
        sum->wrong += here.wrong;
      }
      EXPECT_GT(here.places, number_of_poses() / 20) << wall.name << ", " << kind.name;
      EXPECT_LT(here.worst, is_box ? 3e-2 : tolerance) << wall.name << ", " << kind.name;
      EXPECT_LE(here.kinks, 2 + here.places / 20) << wall.name << ", " << kind.name;
    }
  EXPECT_LT(all.kinks, all.places / 50);
  EXPECT_EQ(all.wrong, of_box.wrong);
  EXPECT_LE(of_box.wrong, of_box.places / 20);
}

/* An edge of a brick across the rim of a cap: the forces of one contact whose energy is k o^2/2. */

TEST(ConvexEnergy, EdgeAcrossTheRimOfACap)
{
  const ConvexShape brick = ConvexShape::box({.6, .5, .4}, 0.0);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(-0.6743, -0.4489, 0.0167, 0.5860).normalized();
  const Place place{{.552, .203, .118}, turn};
  constexpr double stiffness = 2e4, digits = 0.01;
  const Wall cylinder("cylinder", new Frustum({0, 0, -1}, {0, 0, 1}, .3, .3, 2, false)),
      cone("cone", new Frustum({0, 0, -1}, {0, 0, 1}, 1.2, .3, 2, false));
  const Told of_cylinder = Pair(cylinder, brick).at(place, 1.0),
             of_cone = Pair(cone, brick).at(place, 1.0);
  const double right[2][3] = {{3.71, -.27, 2.74}, {5.85, -.43, 4.32}};
  for (int d = 0; d < 3; d++) {
    EXPECT_NEAR(stiffness * of_cylinder.push[d], right[0][d], digits);
    EXPECT_NEAR(stiffness * of_cone.push[d], right[1][d], digits);
  }
}
