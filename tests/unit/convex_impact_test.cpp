// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random impacts of convex bodies, moved by a reference implementation: what is conserved.

#include "flying_body.h"
#include "shape/convex/collide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace Talus;

namespace {

/// Two bodies before they touch, and what is between them.
struct Impact {
  Flying a, b;
  double stiffness, force_exponent;
};

/// Elastic and without friction; returns by which part the energy has changed.
double energy_error(Impact scene, double dt)
{
  Flying &a = scene.a, &b = scene.b;
  const double energy = a.energy() + b.energy();
  const Eigen::Vector3d turning = a.whole_momentum() + b.whole_momentum(),
                        moving = a.mass() * a.v + b.mass() * b.v;
  SeparatingDirection direction;
  ShapeContacts contacts;
  double last = -1.0;
  for (double t = 0.0; t < 2.0 && (last < 0.0 || t - last < 0.05); t += dt) {
    if (collide(*a.shape, a.pose(), *b.shape, b.pose(), direction, contacts, NarrowPhase::FEATURES,
                scene.force_exponent))
      last = t;
    for (const ShapeContact &c : contacts.points) {
      a.push(c, 1.0, scene.stiffness, scene.force_exponent, dt);
      b.push(c, -1.0, scene.stiffness, scene.force_exponent, dt);
    }
    a.move(dt);
    b.move(dt);
  }
  EXPECT_GT(last, 0.0) << "they touch";
  EXPECT_LT((a.whole_momentum() + b.whole_momentum() - turning).norm(), 1e-11);
  EXPECT_LT((a.mass() * a.v + b.mass() * b.v - moving).norm(), 1e-11);
  return std::fabs((a.energy() + b.energy()) / energy - 1.0);
}

enum class Meeting { RANDOM, FACES, ALIGNED_FACES, EDGES, PARALLEL_EDGES, CORNER, EDGE_ON_FACE };

class Meetings {
 public:
  explicit Meetings(double radius) : random(37)
  {
    shapes.push_back(ConvexShape::box({1.0, 1.0, 1.0}, radius));
    shapes.push_back(ConvexShape::box({1.0, 0.6, 0.3}, radius));
    shapes.push_back(ConvexShape::polyhedron(random.corners(14, {0.6, 0.5, 0.4}), radius));
    shapes.push_back(ConvexShape::polyhedron(
        {{0.5, 0.5, 0.5}, {0.5, -0.5, -0.5}, {-0.5, 0.5, -0.5}, {-0.5, -0.5, 0.5}}, radius));
    Points small = dodecahedron_corners();
    for (Vector3<double> &x : small) x = 0.4 * x;
    shapes.push_back(ConvexShape::polyhedron(small, radius));
  }
  Impact next(Meeting kind, double stiffness, double force_exponent)
  {
    Impact scene = kind == Meeting::RANDOM ? random_impact() : nearly(kind);
    scene.stiffness = stiffness;
    scene.force_exponent = force_exponent;
    return scene;
  }

 private:
  Flying body(int shape)
  {
    return {&shapes[shape], {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, random.orientation()};
  }
  Impact random_impact()
  {
    for (;;) {
      Impact scene{body(random.below(5)), body(random.below(5)), 0.0, 0.0};
      const Eigen::Vector3d d = to_eigen(random.direction());
      const double reach = scene.a.shape->inscribed_radius() + scene.b.shape->inscribed_radius();
      scene.b.x = (scene.a.shape->bounding_radius() + scene.b.shape->bounding_radius()) * d;
      scene.b.v = -d + 0.2 * to_eigen(random.direction());
      scene.a.momentum = 0.05 * to_eigen(random.direction());
      // their middles pass each other nearer than that: they touch
      if ((scene.b.x - scene.b.x.dot(scene.b.v) / scene.b.v.squaredNorm() * scene.b.v).norm() <
          reach)
        return scene;
    }
  }
  /// Parts that lie on each other but for a hundredth of a radian.
  Impact nearly(Meeting kind)
  {
    using Eigen::Quaterniond;
    const Eigen::Vector3d x(1, 0, 0), z(0, 0, 1);
    const Quaterniond none = Quaterniond::Identity(), up(Eigen::AngleAxisd(0.25 * M_PI, x)),
                      across(Eigen::AngleAxisd(random.uniform(0.3, 1.2), z)),
                      corner = Quaterniond::FromTwoVectors(Eigen::Vector3d(1, 1, 1), z);
    Impact scene{body(0), body(random.below(2)), 0.0, 0.0};
    const bool edges = kind == Meeting::EDGES || kind == Meeting::PARALLEL_EDGES;
    const Quaterniond lower = kind == Meeting::FACES           ? across
                              : kind == Meeting::EDGES         ? across * up
                              : kind == Meeting::CORNER        ? corner
                              : kind == Meeting::ALIGNED_FACES ? none
                                                               : up;
    scene.a.turn = tilt() * lower;
    scene.b.turn = tilt() * (edges ? up : none);
    const double aside = kind == Meeting::ALIGNED_FACES ? 0.02 : 0.4;
    scene.b.x = {random.uniform(-aside, aside), random.uniform(-aside, aside), 2.0};
    if (edges) scene.b.x.y() *= 0.05;
    scene.b.v = -z;
    return scene;
  }
  Eigen::Quaterniond tilt()
  {
    return Eigen::Quaterniond(Eigen::AngleAxisd(0.02, to_eigen(random.direction())));
  }

  RandomBodies random;
  std::vector<ConvexShape> shapes;
};

const char *name_of(Meeting kind)
{
  static constexpr const char *names[] = {"random",         "faces",  "aligned faces", "edges",
                                          "parallel edges", "corner", "edge on face"};
  return names[static_cast<int>(kind)];
}

/* Elastic and without friction: momenta are kept to rounding, the energy to second order in the time
   step, since forces follow from an energy. */

void expect_second_order(double radius, double exponent)
{
  constexpr int count = 24;
  for (const Meeting kind :
       {Meeting::RANDOM, Meeting::FACES, Meeting::ALIGNED_FACES, Meeting::EDGES,
        Meeting::PARALLEL_EDGES, Meeting::CORNER, Meeting::EDGE_ON_FACE}) {
    Meetings meetings(radius);
    Errors coarse, fine;
    for (int k = 0; k < count; k++) {
      const Impact scene = meetings.next(kind, exponent > 1.0 ? 2e6 : 1e5, exponent);
      coarse.add(energy_error(scene, 2e-4), count);
      fine.add(energy_error(scene, 5e-5), count);
    }
    const double order = 0.5 * std::log2(coarse.mean / fine.mean);
    std::printf("rounded %.2f, force ~ overlap^%.1f, %s: mean %.1e -> %.1e, largest %.1e -> %.1e, "
                "order %.2f\n",
                radius, exponent, name_of(kind), coarse.mean, fine.mean, coarse.largest,
                fine.largest, order);
    EXPECT_LT(fine.mean, radius > 0.0 ? 1e-3 : 6e-4);
    EXPECT_LT(fine.largest, radius > 0.0 ? 8e-3 : 4e-3);
    EXPECT_GT(order, 1.5);
  }
}

}    // namespace

TEST(ConvexImpact, EnergyOfRoundedBodiesIsOfSecondOrder)
{
  for (const double exponent : {1.0, 1.5}) expect_second_order(0.05, exponent);
}

TEST(ConvexImpact, EnergyOfSharpBodiesIsOfSecondOrder)
{
  for (const double exponent : {1.0, 1.5}) expect_second_order(0.0, exponent);
}
