// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two cores in the frame of the first one, for the parts of the narrow phase.

#ifndef TALUS_SHAPE_CONVEX_CORE_PAIR_H
#define TALUS_SHAPE_CONVEX_CORE_PAIR_H

#include "shape/convex/convex_core.h"
#include "shape/pose.h"

namespace Talus {

struct CorePair {
  const ConvexCore &a, &b;
  Pose seen;    ///< of b in the frame of a

  Vector3<double> vertex_of_b(int v) const { return seen.point_in_space(b.vertex(v)); }
  /// Size of both, to which tolerances relate.
  double scale() const { return a.outer_radius() + b.outer_radius(); }
};

/// A vertex and its height, direction . x.
struct Support {
  int vertex;
  double height;
};

/// The vertex that is highest along the direction, which need not be a unit vector; of several the
/// first.
Support highest_vertex(const ConvexCore &core, const Vector3<double> &direction);

/// Only the height.
double largest_height(const ConvexCore &core, const Vector3<double> &direction);

/// A direction and what lies between two cores along it: the least height of a minus the largest of
/// b. They are apart if it is positive.
struct Gap {
  Vector3<double> direction;    ///< unit vector, from b to a
  double width;
};

/// Looks for a direction in which the cores are apart by more than `enough`, and returns it as soon
/// as it is found; else one whose width comes within `accuracy` of the distance of the cores; or,
/// where the cores overlap or are too near to tell, one with a width <= 0. `start`: the first
/// direction to be tried, not zero. By the algorithm of Gilbert, Johnson and Keerthi (IEEE J.
/// Robot. Autom. 4, 193, 1988) on the vertices of the difference of both. The width is that of the
/// direction in any case.
Gap find_gap(const CorePair &pair, const Vector3<double> &start, double enough, double accuracy);

/// The direction in which cores that overlap are moved apart by the least distance, among the
/// normals of faces and the cross products of edges; `kind` tells which, and a and b the faces or
/// edges of it (or -1). FACES: a face of each, which are parallel and as deep but for rounding.
struct LeastDepth {
  enum { FACE_OF_A, FACE_OF_B, FACES, EDGES } kind;
  int of_a, of_b;
  Vector3<double> direction;    ///< unit vector, from b to a
  double depth;                 ///< <= 0: the cores are apart
};
/// `known`: any direction and the width of the gap along it, which is minus the depth: what needs
/// more is not looked at. The result depends on the pair only.
LeastDepth find_least_depth(const CorePair &pair, const Gap &known);

/// The point of a core that is nearest to x; a point inside belongs to the nearest face.
struct CorePoint {
  enum { FACE, EDGE, VERTEX } kind;
  int part;
  Vector3<double> point;
  Vector3<double> normal;    ///< unit vector from the point to x; outward if x is inside
  double distance;           ///< negative inside
};
CorePoint nearest_point(const ConvexCore &core, const Vector3<double> &x);

}    // namespace Talus

#endif
