// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The walls of a body that is filled: flat, or curved inward as those of a drum, a cone or a ball. How far a point is
// behind such a wall is a convex function of the point. Lengths in the units of the script, in the frame of the body.

#ifndef TALUS_BODY_SHAPE_INWARD_WALL_H
#define TALUS_BODY_SHAPE_INWARD_WALL_H

#include "base/vector3.h"

#include <cmath>

namespace Talus {

struct InwardWall {
  enum class Kind { FLAT, ROUND, BALL };

  Kind kind;
  int part;                 ///< of its contacts, see SurfaceContact
  Vector3<double> point;    ///< of the plane; on the axis; the center
  Vector3<double> axis;     ///< unit vector: of a plane the normal toward the wall
  /// Of round walls: a unit vector normal to the axis, and the components of the normal toward the wall, away from the
  /// axis and along it.
  Vector3<double> side{};
  double normal_away = 1.0, normal_along = 0.0;
  double radius = 0.0;    ///< of a round wall beside `point`, or of a ball

  /// Where the wall is, as seen from a point: the unit vector toward it, and how far the point is behind it.
  struct Outward {
    Vector3<double> direction;
    double behind;
  };
  Outward from(const Vector3<double> &x) const
  {
    const Vector3<double> d = x - point;
    if (kind == Kind::FLAT) return {axis, dot(d, axis)};
    if (kind == Kind::BALL) {
      const double distance = length(d);
      return {distance > 0.0 ? (1.0 / distance) * d : axis, distance - radius};
    }
    const double along = dot(d, axis);
    const Vector3<double> flat = d - along * axis;
    const double away = length(flat);
    const Vector3<double> outward = away > 0.0 ? (1.0 / away) * flat : side;
    return {normal_away * outward + normal_along * axis,
            (away - radius) * normal_away + along * normal_along};
  }

  /// How the direction turns if the point x moves along the unit vector t, both normal to it.
  Vector3<double> turn(const Vector3<double> &x, const Vector3<double> &t) const
  {
    if (kind == Kind::FLAT) return {0.0, 0.0, 0.0};
    const Vector3<double> d = x - point;
    if (kind == Kind::BALL) return (1.0 / length(d)) * t;
    const Vector3<double> flat = d - dot(d, axis) * axis, around = cross(axis, flat);
    return normal_away * dot(around, t) / std::pow(dot(flat, flat), 1.5) * around;
  }
};

}    // namespace Talus

#endif
