// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A freely moving convex body of density 1, moved by a reference implementation of the motion.

#ifndef TALUS_TESTS_FLYING_BODY_H
#define TALUS_TESTS_FLYING_BODY_H

#include "convex_bodies.h"
#include "shape/shape_contact.h"

#include <algorithm>
#include <cmath>

namespace Talus {

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
  /// `pushed`: +1 if it is body a of the contact, -1 if b.
  void push(const ShapeContact &c, double pushed, double stiffness, double force_exponent,
            double dt)
  {
    const double size = stiffness * c.weight * std::pow(c.overlap, force_exponent);
    const Eigen::Vector3d f = (pushed * dt * size) * to_eigen(c.normal);
    v += f / mass();
    momentum += (to_eigen(c.position) - x).cross(f);
  }
};

/// Of several impacts.
struct Errors {
  double mean = 0.0, largest = 0.0;
  void add(double error, int count)
  {
    mean += error / count;
    largest = std::max(largest, error);
  }
};

}    // namespace Talus

#endif
