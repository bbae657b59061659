// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_CONVEX_NEAREST_LINES_H
#define TALUS_SHAPE_CONVEX_NEAREST_LINES_H

#include "base/vector3.h"

namespace Talus {

/// From `from` to `from + along`.
struct Segment {
  Vector3<double> from, along;
  double square;    ///< of its length
};

/// The points at which the lines of two segments are nearest to each other, if they are between the
/// ends of both; see C. Ericson, Real-time collision detection (2005), section 5.1.9. None of lines
/// that are parallel to within 1e-6: rounding would choose them, and their ends touch as deep.
inline bool find_nearest_inside(const Segment &a, const Segment &b, Vector3<double> &of_a,
                                Vector3<double> &of_b)
{
  constexpr double least_square_of_sine = 1.0e-12;
  const Vector3<double> d = a.from - b.from;
  const double ab = dot(a.along, b.along), ad = dot(a.along, d), bd = dot(b.along, d);
  const double det = a.square * b.square - ab * ab;
  const double s = ab * bd - ad * b.square, t = a.square * bd - ab * ad;
  if (!(s > 0.0 && t > 0.0 && s < det && t < det)) return false;
  if (!(det > least_square_of_sine * a.square * b.square)) return false;
  of_a = a.from + (s / det) * a.along;
  of_b = b.from + (t / det) * b.along;
  return true;
}

}    // namespace Talus

#endif
