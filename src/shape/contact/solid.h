// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_CONTACT_SOLID_H
#define TALUS_SHAPE_CONTACT_SOLID_H

#include "shape/pose.h"
#include "shape/shape.h"

namespace Talus {

/// A particle in the narrow phase: a shape at its place, or a sphere.
struct Solid {
  const Shape *shape = nullptr;    ///< nullptr: a sphere
  Pose pose;                       ///< of the frame of the shape
  Sphere bounding_sphere;          ///< the sphere that contains it

  const Geometry &geometry() const
  {
    if (shape) return *shape;
    return bounding_sphere;
  }
  const Vector3<double> &center() const { return pose.position; }
  /// The spheres around overlap.
  bool may_touch(const Solid &other) const
  {
    const Vector3<double> d = center() - other.center();
    const double reach = bounding_sphere.radius + other.bounding_sphere.radius;
    return dot(d, d) < reach * reach;
  }
};

}    // namespace Talus

#endif
