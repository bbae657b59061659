// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_HOLLOW_WALLS_H
#define TALUS_SHAPED_HOLLOW_WALLS_H

#include "body/shape/large_body_shape.h"

#include <vector>

namespace Talus {

/// A wall behind which nothing of a convex particle can be unless one of its vertices is: flat,
/// n . x = offset, particles are where the unit vector n points to; or the inside of an endless
/// cylinder.
struct HollowWall {
  Vector3<double> normal;    ///< of a cylinder: along its axis
  double offset = 0.0;
  bool two_sided = false;    ///< particles are on the side where their center is
  /// Of a cylinder; 0: the wall is flat. The axis leads through `point`.
  double radius = 0.0;
  Vector3<double> point{0.0, 0.0, 0.0};
};

/// The walls of a large body, in its frame, if it consists of hollow ones as far as convex
/// particles are concerned: a plane, a box or a cylinder from inside. None of another body.
std::vector<HollowWall> hollow_walls(const LargeBodyShape &body);

}    // namespace Talus

#endif
