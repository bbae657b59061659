// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random impacts of convex bodies, moved by a twin of their own: what is kept.

#include "convex_bodies.h"
#include "shape/collide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace Talus;

namespace {

struct Flying {
  const ConvexShape *shape;
  Eigen::Vector3d x, v, momentum;    // the last one about the center
  Eigen::Quaterniond turn;

  double mass() const { return shape->volume(); }
  Pose pose() const { return Pose(from_eigen(x), turn); }
  Eigen::Vector3d omega() const
  {
    return turn * (turn.conjugate() * momentum).cwiseQuotient(shape->principal_moments());
  }
  double energy() const { return 0.5 * mass() * v.squaredNorm() + 0.5 * momentum.dot(omega()); }
  Eigen::Vector3d whole_momentum() const { return momentum + mass() * x.cross(v); }
  void rotate(const Eigen::Vector3d &by, double dt)
  {
    if (by.norm() > 0.0)
      turn = (Eigen::Quaterniond(Eigen::AngleAxisd(by.norm() * dt, by.normalized())) * turn)
                 .normalized();
  }
  void move(double dt)
  {
    x += dt * v;
    Flying half = *this;
    half.rotate(omega(), 0.5 * dt);
    rotate(half.omega(), dt);
  }
};

}    // namespace

/* Elastic and without friction: momenta are kept to rounding. Energy is kept as well but where contacts share their
   weight, which some impacts pass through. */

TEST(ConvexImpact, MomentaAndEnergyOfRandomImpacts)
{
  RandomBodies random(37);
  for (const double r : {0.0, 0.05}) {
    std::vector<ConvexShape> shapes;
    shapes.push_back(ConvexShape::box({1.0, 1.0, 1.0}, r));
    shapes.push_back(ConvexShape::box({1.0, 0.6, 0.3}, r));
    shapes.push_back(ConvexShape::polyhedron(random.corners(14, {0.6, 0.5, 0.4}), r));
    std::vector<double> errors;
    const double dt = 5e-5, stiffness = 1e5;
    while (errors.size() < 40) {
      Flying a{&shapes[random.below(3)], {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, random.orientation()},
          b = a;
      b.shape = &shapes[random.below(3)];
      b.turn = random.orientation();
      const Eigen::Vector3d d = to_eigen(random.direction());
      b.x = (a.shape->bounding_radius() + b.shape->bounding_radius()) * d;
      b.v = -d + 0.2 * to_eigen(random.direction());
      a.momentum = 0.05 * to_eigen(random.direction());
      const double energy = a.energy() + b.energy();
      const Eigen::Vector3d turning = a.whole_momentum() + b.whole_momentum();
      SeparatingDirection direction;
      ConvexContacts contacts;
      int last = -1;
      for (int step = 0; step < 40000 && (last < 0 || step - last < 1000); step++) {
        if (collide(*a.shape, a.pose(), *b.shape, b.pose(), direction, contacts)) last = step;
        for (const ConvexContact &c : contacts.points) {
          const Eigen::Vector3d f = (dt * stiffness * c.weight * c.overlap) * to_eigen(c.normal),
                                x = to_eigen(c.position);
          a.v += f / a.mass();
          b.v -= f / b.mass();
          a.momentum += (x - a.x).cross(f);
          b.momentum -= (x - b.x).cross(f);
        }
        a.move(dt);
        b.move(dt);
      }
      if (last < 0) continue;
      errors.push_back(std::fabs((a.energy() + b.energy()) / energy - 1.0));
      EXPECT_LT((a.whole_momentum() + b.whole_momentum() - turning).norm(), 1e-11);
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[20], 1e-4);
    EXPECT_LT(errors[35], 1e-2);
    EXPECT_LT(errors[39], 0.15);
  }
}
