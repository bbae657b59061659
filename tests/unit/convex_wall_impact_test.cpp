// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Elastic impacts of convex particles on large bodies that are at rest: what they keep of their
// energy.

#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/plane.h"
#include "flying_body.h"
#include "shape/contact/body_surfaces.h"
#include "shape/contact/shape_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace Talus;

namespace {

using Vector = Vector3<double>;

struct Wall {
  std::string name;
  std::unique_ptr<LargeBodyShape> body;
  /// Where the line of flight ends, and what leads from there to where it begins.
  Vector aim[2], from[2];
};

Wall wall(const std::string &name, LargeBodyShape *body, Vector aim, Vector spread, Vector from,
          Vector lean)
{
  return {name, std::unique_ptr<LargeBodyShape>(body), {aim, spread}, {from, lean}};
}

void add_quad(std::vector<Triangle> &to, Vector a, Vector b, Vector c, Vector d)
{
  to.push_back({{a, b, c}});
  to.push_back({{a, c, d}});
}

/// A block of triangles, corners at +-1.
MeshShape *block()
{
  std::vector<Triangle> triangles;
  for (const double s : {1.0, -1.0}) {
    add_quad(triangles, {s, -1, -s}, {s, 1, -s}, {s, 1, s}, {s, -1, s});
    add_quad(triangles, {-s, s, -1}, {-s, s, 1}, {s, s, 1}, {s, s, -1});
    add_quad(triangles, {-1, -s, s}, {1, -s, s}, {1, s, s}, {-1, s, s});
  }
  return new MeshShape(TriangleMesh(triangles), MeshSide::NORMALS);
}

std::vector<Wall> all_walls()
{
  const double endless = std::numeric_limits<double>::infinity();
  const Vector up{0, 0, 1}, little{0.3, 0.3, 0}, none{0, 0, 0}, along{0, 0.3, 0};
  const Vector edge{0.7, 0, 0.7}, corner{0.6, 0.6, 0.6}, any{0.3, 0.3, 0.3};
  std::vector<Wall> walls;
  walls.push_back(wall("plane", new Plane({0, 0, 0}, up, false), none, none, up, little));
  walls.push_back(
      wall("box, face", new Box({0, 0, -1}, {2, 2, 2}, false), none, little, up, little));
  walls.push_back(
      wall("box, edge", new Box({0, 0, 0}, {2, 2, 2}, false), {1, 0, 1}, along, edge, any));
  walls.push_back(wall("mesh, face", block(), {0, 0, 1}, little, up, little));
  walls.push_back(wall("mesh, edge", block(), {1, 0, 1}, along, edge, any));
  walls.push_back(wall("mesh, corner", block(), {1, 1, 1}, none, corner, any));
  walls.push_back(wall("cylinder, mantle", new Frustum({0, 0, 0}, {0, 1, 0}, 1, 1, endless, false),
                       {0, 0, 1}, along, up, little));
  walls.push_back(wall("cylinder, cap", new Frustum({0, 0, -1}, up, 0.6, 0.6, 2, false), none,
                       little, up, little));
  walls.push_back(wall("cylinder, rim", new Frustum({0, 0, 0}, {0, 1, 0}, 1, 1, 2, false),
                       {0, 1, 1}, none, {0, .7, .7}, any));
  walls.push_back(wall("cylinder inside", new Frustum({0, 0, 0}, {0, 1, 0}, 2, 2, 6, true),
                       {0, 0, -2}, along, up, little));
  walls.push_back(wall("ball", new Ball({0, 0, -1}, 1, false), none, little, up, little));
  walls.push_back(wall("ball inside", new Ball({0, 0, 0}, 2, true), {0, 0, -2}, none, up, little));
  walls.push_back(wall("cone, mantle", new Frustum({0, 0, 0}, {0, 1, 0}, 1.5, 0.5, 2, false),
                       {0, 0, 1}, along, {0, 0.4, 0.8}, little));
  walls.push_back(
      wall("cone, tip", new Frustum({0, 0, -1}, up, 1, 0, 2, false), none, none, up, any));
  walls.push_back(wall("cone inside", new Frustum({0, 0, 0}, up, 2, 4, 4, true), {3, 0, 0}, none,
                       {-0.8, 0, 0.4}, little));
  return walls;
}

struct Kind {
  std::string name;
  ConvexShape shape;
};

std::vector<Kind> all_kinds(double radius)
{
  const Points tetrahedron = {{.5, .5, .5}, {.5, -.5, -.5}, {-.5, .5, -.5}, {-.5, -.5, .5}};
  Points dodecahedron = dodecahedron_corners();
  for (Vector &x : dodecahedron) x = 0.4 * x;
  return {{"cube", ConvexShape::box({.9, .9, .9}, radius)},
          {"tetrahedron", ConvexShape::polyhedron(tetrahedron, radius)},
          {"dodecahedron", ConvexShape::polyhedron(dodecahedron, radius)}};
}

/// Toward the wall, in any orientation; or with a face nearly parallel to it.
Flying thrown(RandomBodies &random, const Wall &wall, const ConvexShape &shape, bool flat)
{
  const auto spread = [&random](const Vector &v) {
    return Vector{random.uniform(-v.x, v.x), random.uniform(-v.y, v.y), random.uniform(-v.z, v.z)};
  };
  Flying body{&shape, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, random.orientation()};
  Vector back = wall.from[0] + spread(wall.from[1]);
  back = (1.0 / length(back)) * back;
  const Vector aim = wall.aim[0] + spread(wall.aim[1]);
  if (flat) {
    const ConvexCore &core = shape.core();
    const Eigen::Vector3d face = to_eigen(core.normal(random.below(core.num_faces())));
    const Eigen::Vector3d wander = 0.02 * to_eigen(random.direction());
    body.turn = Eigen::Quaterniond(Eigen::AngleAxisd(wander.norm(), wander.normalized())) *
                Eigen::Quaterniond::FromTwoVectors(face, -to_eigen(wall.from[0]));
  }
  body.x = to_eigen(aim + (shape.bounding_radius() + 0.05) * back);
  body.v = -to_eigen(back);
  body.momentum = (flat ? 1e-4 : 0.02) * to_eigen(random.direction());
  return body;
}

/// Turned so that an edge of a box falls across a rim, which it leads over.
Eigen::Quaterniond across(RandomBodies &random, const Vector &outward)
{
  const Eigen::Vector3d down = -to_eigen(outward).normalized(), over(0.7, 0, -0.7);
  const Eigen::Quaterniond edge_down =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d(0, 1, 1), down);
  const Eigen::Vector3d along = edge_down * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d axis = to_eigen(random.direction());
  const Eigen::Vector3d wander = random.uniform(0.05, 0.4) * axis;
  return Eigen::Quaterniond(Eigen::AngleAxisd(wander.norm(), wander.normalized())) *
         Eigen::Quaterniond::FromTwoVectors(along, over) * edge_down;
}

/// Away from the wall until it touches nothing.
void step_back(Flying &body, const BodySurfaces &walls)
{
  ShapeContacts contacts;
  const auto touches = [&] {
    const Pose pose = body.pose();
    for (int w = 0; w < walls.size(); w++)
      if (walls.touch(w, {1, *body.shape, pose, 1.0}, contacts)) return true;
    return false;
  };
  while (touches()) body.x -= 0.02 * body.v;
}

/// Returns by which part the energy has changed.
double energy_error(Flying body, const BodySurfaces &walls, double stiffness, double exponent,
                    double dt)
{
  const double energy = body.energy();
  ShapeContacts contacts;
  double last = -1.0;
  for (double t = 0.0; t < 2.0 && (last < 0.0 || t - last < 0.05); t += dt) {
    const Pose pose = body.pose();
    for (int w = 0; w < walls.size(); w++) {
      if (!walls.touch(w, {1, *body.shape, pose, exponent}, contacts)) continue;
      last = t;
      for (const ShapeContact &c : contacts.points) body.push(c, 1.0, stiffness, exponent, dt);
    }
    body.move(dt);
  }
  EXPECT_GT(last, 0.0) << "they touch";
  return std::fabs(body.energy() / energy - 1.0);
}

}    // namespace

/* The energy of rounded bodies is kept as the time step becomes smaller, whatever they meet. Twice
   more for a flat face on a cap, where one contact jumps along an edge that lies on it. */

TEST(ConvexWallImpact, EnergyOfRoundedBodies)
{
  constexpr int count = 4;
  for (const Wall &wall : all_walls()) {
    for (const Kind &kind : all_kinds(0.05)) {
      ShapeTable types(collisions_of_shapes());
      types.set(
          1, std::make_shared<ParticleShape>(std::make_shared<const ConvexShape>(kind.shape), 1.0));
      const BodySurfaces walls(*wall.body, types);
      RandomBodies random(41);
      Errors coarse, fine;
      for (int k = 0; k < count; k++) {
        Flying body = thrown(random, wall, kind.shape, k % 2);
        step_back(body, walls);
        const double exponent = k < count / 2 ? 1.0 : 1.5, stiffness = exponent > 1.0 ? 1e6 : 5e4;
        coarse.add(energy_error(body, walls, stiffness, exponent, 2e-4), count);
        fine.add(energy_error(body, walls, stiffness, exponent, 5e-5), count);
      }
      std::printf("%-17s %-13s mean %.1e -> %.1e, largest %.1e -> %.1e\n", wall.name.c_str(),
                  kind.name.c_str(), coarse.mean, fine.mean, coarse.largest, fine.largest);
      const bool jumps = wall.name == "cylinder, cap" && kind.name == "tetrahedron";
      EXPECT_LT(fine.mean, jumps ? 4e-3 : 3e-4) << wall.name << ", " << kind.name;
      EXPECT_LT(fine.largest, jumps ? 1.5e-2 : 1e-3) << wall.name << ", " << kind.name;
      EXPECT_LT(fine.mean, 0.4 * coarse.mean) << wall.name << ", " << kind.name;
    }
  }
}

/* Sharp bricks whose edge falls across the rim of a cap: forces jump along with what is deepest. */

TEST(ConvexWallImpact, EnergyOfSharpBricksOnRims)
{
  constexpr int count = 12;
  const ConvexShape brick = ConvexShape::box({.6, .5, .4}, 0.0);
  const Vector up{0, 0, 1}, outward{0.7, 0, 0.7}, lean{0.3, 0.3, 0.3}, none{0, 0, 0};
  const Wall walls[] = {wall("cylinder, rim", new Frustum({0, 0, -1}, up, .3, .3, 2, false),
                             {.3, 0, 0}, none, outward, lean),
                        wall("cone, rim", new Frustum({0, 0, -1}, up, 1.2, .3, 2, false),
                             {.3, 0, 0}, none, outward, lean)};
  ShapeTable types(collisions_of_shapes());
  types.set(1, std::make_shared<ParticleShape>(std::make_shared<const ConvexShape>(brick), 1.0));
  for (const Wall &rim : walls) {
    const BodySurfaces surfaces(*rim.body, types);
    for (const double exponent : {1.0, 1.5}) {
      RandomBodies random(43);
      Errors coarse, fine;
      for (int k = 0; k < count; k++) {
        Flying body = thrown(random, rim, brick, false);
        body.turn = across(random, rim.from[0]);
        step_back(body, surfaces);
        const double stiffness = exponent > 1.0 ? 1e6 : 5e4;
        coarse.add(energy_error(body, surfaces, stiffness, exponent, 2e-4), count);
        fine.add(energy_error(body, surfaces, stiffness, exponent, 5e-5), count);
      }
      std::printf("%-17s force ~ overlap^%.1f mean %.1e -> %.1e, largest %.1e -> %.1e\n",
                  rim.name.c_str(), exponent, coarse.mean, fine.mean, coarse.largest, fine.largest);
      EXPECT_LT(fine.mean, 2e-4) << rim.name;
      EXPECT_LT(fine.largest, 1e-3) << rim.name;
      EXPECT_LT(fine.mean, 0.15 * coarse.mean) << rim.name;
    }
  }
}
