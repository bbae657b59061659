// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of a superellipsoid with what others consist of: planes, points, edges and rims. The signed distance
// of a point from a convex body is a convex function, so that a straight edge has one point that is nearest or
// deepest.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_TOUCH_H
#define TALUS_SHAPE_SUPERELLIPSOID_TOUCH_H

#include "shape/collisions.h"
#include "shape/superellipsoid/least_overlap.h"

namespace Talus {

/// A circle.
struct Circle {
  Vector3<double> center, side,
      other;    ///< the last two: unit vectors in its plane, at right angles
  double radius;
  Vector3<double> at(double angle) const
  {
    return center + (radius * std::cos(angle)) * side + (radius * std::sin(angle)) * other;
  }
};

/// At one pose. Points, normals and results are in the frame in which that is given; normals of results point
/// from the shape to the other.
class SuperellipsoidTouch {
  using Vector = Vector3<double>;

 public:
  SuperellipsoidTouch(const Superellipsoid &superellipsoid, const Pose &pose) :
      shape(superellipsoid), at(pose)
  {
  }

  struct Found {
    Vector normal;                                           ///< outward
    Vector place;                                            ///< on the surface of the shape
    Vector middle;                                           ///< half way to the other surface
    Vector other() const { return 2.0 * middle - place; }    ///< on that surface
    double overlap;                                          ///< negative: apart by that
    double curvature;                                        ///< as laws have it, if they touch
  };
  /// With a plane whose normal points to the shape.
  Found plane(const Vector &normal, double offset) const;
  /// With a ball, or a point.
  Found ball(const Vector &center, double radius) const;
  /// With the ball that is deepest among those along a line or circle.
  struct AlongLine {
    bool touches = false;      ///< one of those that were looked at
    bool is_within = false;    ///< the deepest is not at an end, and touches
    Found deepest{};           ///< if it is within
    Vector of_ball{};          ///< the center of that ball
  };
  /// Of balls along a straight line whose radii change from r0 to r1. An end counts as within if the distance still
  /// falls there by this slope (over the length of the line) at most.
  AlongLine edge(const Vector &from, const Vector &along, double r0, double r1,
                 double slack = 0.0) const;
  /// The same with the points of a circle.
  AlongLine circle(const Circle &rim) const;

  /// Of a plane that cuts the shape between its center and its lowest point: where the straight line between both
  /// meets it, which is a point of the shape.
  Vector crossing(const Found &lowest, double height_of_center) const
  {
    return at.position +
           height_of_center / (height_of_center + lowest.overlap) * (lowest.place - at.position);
  }
  bool is_inside(const Vector &x) const { return shape.gauge(at.point_in_body(x)) < 1.0; }

  /// No point of the box around the shape is as near as this to x.
  bool is_beyond(const Vector &x, double distance) const;

 private:
  /// The same of the points of a straight line; of an ellipsoid and the distance 0, no point is inside of it.
  bool is_beyond(const Vector &from, const Vector &along, double distance) const;
  Found in_space(const CommonNormal &found) const;

  const Superellipsoid &shape;
  const Pose &at;
};

/// As contacts of particles have it; the other surface has that curvature.
ShapeContact shape_contact(const SuperellipsoidTouch::Found &found, double other_curvature,
                           std::uint32_t name);

}    // namespace Talus

#endif
