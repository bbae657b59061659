// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_FLAT_WALLS_H
#define TALUS_SHAPED_FLAT_WALLS_H

#include "body/shape/large_body_shape.h"

#include <vector>

namespace Talus {

/// A flat wall n . x = offset, particles are where the unit vector n points to.
struct FlatWall {
  Vector3<double> normal;
  double offset;
  bool two_sided;    ///< particles are on the side where their center is
};

/// The walls of a large body, in its frame, if it consists of infinite flat walls as far as convex
/// particles are concerned: a plane, or a box from inside. None of another body.
std::vector<FlatWall> flat_walls(const LargeBodyShape &body);

}    // namespace Talus

#endif
