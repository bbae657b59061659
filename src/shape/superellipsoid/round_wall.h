// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where a superellipsoid is behind a round wall around it, a cylinder or a cone. Such a wall is what all planes beside
// it leave, whose normals n(phi) lie on a cone; over that one angle
//
//   g(phi) = n(phi) . (c - p) + h(n(phi)) - b
//
// tells how far the shape goes beyond the plane: c is its center, p . n = b its middle plane and h its support function.
// Places that are touched are maxima of g above zero. There g' = t . (x - p) is zero, where x is the point of the shape
// with normal n and t the tangent of the wall: g' costs no more than g, and g'' only needs to know how the shape is
// curved there.
//
// Shapes are symmetric, and flattest at the ends of their axes, so that one maximum at most belongs to each octant of
// a shape. Directions are asked eight at a time, on the part of the circle that the shape can reach; angles are never
// computed.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_ROUND_WALL_H
#define TALUS_SHAPE_SUPERELLIPSOID_ROUND_WALL_H

#include "body/shape/inward_wall.h"
#include "shape/collisions.h"
#include "shape/superellipsoid/superellipsoid.h"

#include "base/lanes.h"

namespace Talus {

class RoundWall {
 public:
  static constexpr int most_places = 9;

  /// Both must exist as long as this does. `wall.kind` is ROUND.
  RoundWall(const Placed<Superellipsoid> &placed, const InwardWall &wall);

  /// Normals (unit vectors, in the frame of the body, toward the wall) of the places that are touched; returns how many.
  int find(Vector3<double> (&normal)[most_places]) const;

 private:
  /// A direction of the plane normal to the axis: cosine and sine of phi, which is zero where the center of the shape is.
  struct Direction {
    double c, s;
  };
  struct Sample {
    Direction at;
    double beyond, slope;    ///< g, g'
    double bend = 0.0;       ///< g'', where it is known
  };
  using Samples = Sample[lanes];
  double least_cosine() const;
  /// Counter-clockwise; wide: more than a quarter of the circle.
  struct Arc {
    Direction begin, end;
    bool is_wide;
  };
  static double order(const Direction &at);
  bool narrow_down(Arc &arc, Samples &samples) const;
  int cuts(const Arc &arc, Direction *cut) const;
  void sample(const Direction &from, const Direction &to, Samples &samples) const;
  Sample sample(const Direction &at) const;
  bool may_touch_between(const Sample &one, const Sample &next) const;
  double bend(const Superellipsoid::Point &point, const Vector3<double> &tangent,
              const Direction &at) const;
  Direction maximum_between(Sample low, Sample high) const;
  Vector3<double> normal_at(const Direction &at) const;

  static constexpr int most_cuts = 9;
  const Placed<Superellipsoid> &shape;
  const InwardWall &wall;
  Vector3<double> away, around;     ///< of the center from the axis, and normal to that
  Vector3<double> own[3];           ///< away, around and the axis in the frame of the shape
  double from_axis, along, size;    ///< of the center; the bounding radius
};

}    // namespace Talus

#endif
