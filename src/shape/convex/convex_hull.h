// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Convex hull of points: every point is added to a closed surface of triangles, whose part that it
// sees is replaced by triangles that lead to it. Then triangles in one plane become one face.

#ifndef TALUS_SHAPE_CONVEX_CONVEX_HULL_H
#define TALUS_SHAPE_CONVEX_CONVEX_HULL_H

#include "base/vector3.h"

#include <array>
#include <vector>

namespace Talus {

struct ConvexHull {
  std::vector<std::array<int, 3>> triangles;    ///< of points, counterclockwise seen from outside
  /// The corners that are left when triangles in one plane are one face, and when points on the
  /// line between two others are left out; counterclockwise.
  std::vector<std::vector<int>> faces;
  /// Smallest distance of two parallel planes with the hull between them, one of them a face.
  double least_width = 0.0;
};

/// Triangles whose vertices are within flatness * least_width of the plane of a larger one are of
/// one face with it. At least 4 points, finite and different from each other; throws
/// std::runtime_error if they are in one plane to 1e-6 of their extent. Takes a time that grows as
/// the square of the number of points.
ConvexHull convex_hull(const std::vector<Vector3<double>> &points, double flatness);

}    // namespace Talus

#endif
