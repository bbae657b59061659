// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_SOLID_H
#define TALUS_SHAPED_SOLID_H

#include "shape/collide.h"

namespace Talus {

/// A particle in the narrow phase: a shape at its place, or a sphere.
struct Solid {
  const ConvexShape *shape = nullptr;    ///< nullptr: a sphere
  Pose pose;                             ///< of the frame of the shape's core
  double radius = 0.0;                   ///< of the sphere around

  const Vector3<double> &center() const { return pose.position; }
  /// What laws take for the radius of the surface.
  double contact_radius() const { return shape ? shape->contact_radius() : radius; }
  /// The spheres around overlap.
  bool may_touch(const Solid &other) const
  {
    const Vector3<double> d = center() - other.center();
    const double reach = radius + other.radius;
    return dot(d, d) < reach * reach;
  }
};

/// Contacts of two particles of which at least one has a shape, with normals from b to a; returns
/// whether there are any. The direction is read and written, see SeparatingDirection.
/// `force_exponent`: see collide().
bool touch(const Solid &a, const Solid &b, NarrowPhase method, double force_exponent,
           SeparatingDirection &direction, ConvexContacts &contacts);

}    // namespace Talus

#endif
