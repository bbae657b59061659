// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where a superellipsoid and another one, or a ball, touch: at the points of both whose normals are
// opposite and along the line between them, a common normal. Along a direction n (a unit vector from a to b)
// the two reach into each other by
//
//   f(n) = h_a(n) + h_b(-n) - n . d,
//
// with the heights h of their surfaces and d from the center of a to that of b. The overlap is the least of it,
// the distance by which they must be moved to be apart; where it is negative they are apart, by that distance
// at least. So the force of a law along n follows from an energy, and the points are the derivatives of the
// heights.
//
// Found by Newton's method in the coordinates of the flatter one of the two surfaces, with f to judge steps,
// started from the common normal of two ellipsoids, or of the step before. As long as the overlap is small, f has no other minimum
// within a right angle of the least one. That a result is not another one is proven: bodies that touch by a
// point that is inside both, those that do not by a direction with f < 0. Where the first fails, n starts from
// the direction with the largest ratio of n . d and the sum of the heights: the normal where both touch when
// they are scaled about their centers. This ratio has one maximum only, which is below 1 if they overlap.
//
// All in the frame of a, by plain arithmetic: the same bits on all instruction sets. Thread-safe.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_LEAST_OVERLAP_H
#define TALUS_SHAPE_SUPERELLIPSOID_LEAST_OVERLAP_H

#include "shape/superellipsoid/superellipsoid.h"

namespace Talus {

struct CommonNormal {
  Vector3<double> normal;         ///< n
  double overlap;                 ///< f(n); negative: they are apart
  Superellipsoid::Point of_a;     ///< in the frame of a
  Vector3<double> place_on_b;     ///< the same
  double curvature_of_b = 0.0;    ///< as laws have it, of a superellipsoid that touches
};

/// Of two superellipsoids; b is at this pose in the frame of a. Apart: any direction in which they are. `start`: a unit
/// vector from which the search begins if it is not 0, as the normal of the step before; what is found differs by
/// rounding.
CommonNormal find_common_normal(const Superellipsoid &a, const Superellipsoid &b,
                                const Pose &b_seen, const Vector3<double> &start = {0.0, 0.0, 0.0});
/// Overlaps below this have one minimum of f near by.
double deep_overlap(const Superellipsoid &a, const Superellipsoid &b);
/// To which steps of the search relate.
double size_of_both(const Superellipsoid &a, const Superellipsoid &b);

/// Of a superellipsoid and a ball, or a point if its radius is 0: also where they are apart. A point deep inside
/// may be nearest to several places: one of them.
CommonNormal find_common_normal(const Superellipsoid &a, const Vector3<double> &center,
                                double radius);

}    // namespace Talus

#endif
