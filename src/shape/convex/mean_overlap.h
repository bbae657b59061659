// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The overlap of two cores as one length that follows continuously from their poses, and its
// derivatives: what the elastic energy of sharp bodies depends on.

#ifndef TALUS_SHAPE_CONVEX_MEAN_OVERLAP_H
#define TALUS_SHAPE_CONVEX_MEAN_OVERLAP_H

#include "shape/convex/core_pair.h"

namespace Talus {

/// Let n be the direction of least depth and g(p) > 0 how far the upper side of b is above the
/// lower side of a on the line along n through p. The overlap is (15 <g^4>)^(1/4), the mean being
/// over all p with g > 0: the depth d where a corner is in a face or edges cross, 3^(1/4) d where
/// an edge lies on a face, and 15^(1/4) d where a face does: with linear springs they are 1.73 and
/// 3.87 times as stiff. Where n jumps from one face or pair of edges to another one the depths are
/// equal, and so are the overlaps, but for what is of higher order.
struct MeanOverlap {
  double value;
  /// What a moves along to be free of b: minus the derivatives by its place, and by its turning
  /// about the origin of the pair.
  Vector3<double> push, turn;
};

/// `least`: find_least_depth(pair, ...) with a depth > 0; heights along its direction. Returns false
/// where rounding leaves nothing.
bool find_mean_overlap(const CorePair &pair, const LeastDepth &least, double bottom_of_a,
                       double top_of_b, MeanOverlap &overlap);

/// Whether a corner is in the middle of a face, or two edges cross far enough from their ends: then
/// the overlap is the depth. `of_a`: the point of a that is deepest, or if they are not so a guess.
bool find_single_point(const CorePair &pair, const LeastDepth &least, Vector3<double> &of_a);

}    // namespace Talus

#endif
