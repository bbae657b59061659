// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The lever arm of spinning resistance. Lengths.

#ifndef TALUS_LAWS_INTERSECTION_RADIUS_H
#define TALUS_LAWS_INTERSECTION_RADIUS_H

#include "base/simd.h"

namespace Talus {

/// Radius of the circle in which the surfaces of two spheres intersect, 0 if they do not. Loses no
/// digits at small overlaps, and none of its bits depends on which sphere comes first.
template <class Real>
inline Real intersection_radius_of(Real first_radius, Real second_radius, Real overlap)
{
  const Real zero = splat<Real>(0.0), sum = first_radius + second_radius;
  const Real distance = sum - overlap;
  const Real square = overlap * (2.0 * sum - overlap) *
                      ((2.0 * first_radius - overlap) * (2.0 * second_radius - overlap));
  return select((square > zero) & (distance > zero), square_root(square) / (2.0 * distance), zero);
}

}    // namespace Talus

#endif
