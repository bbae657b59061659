// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The angle of a point in the plane, of one or of each of a vector, from operations that every processor rounds
// alike: see base/power.h.

#ifndef TALUS_BASE_ARC_TANGENT_H
#define TALUS_BASE_ARC_TANGENT_H

#include "base/simd.h"

namespace Talus {

/// Of |t| <= tan(pi/8), by the series of Gregory; Abramowitz and Stegun 4.4.42.
template <class Real> TALUS_INLINE Real arc_tangent_of_small(Real t)
{
  const Real t2 = t * t, t4 = t2 * t2;
  // t2 times the terms 1, 3, 5 ... and 2, 4, 6 ... behind the first one
  Real odd = splat<Real>(-1.0 / 39.0), even = splat<Real>(1.0 / 41.0);
  constexpr int most = 35;
  for (int n = most; n >= 3; n -= 4) {
    odd = odd * t4 - 1.0 / n;
    even = even * t4 + 1.0 / (n + 2);
  }
  return t + t * (t2 * odd + t4 * even);
}

/// The angle between the x-axis and (x, y), in -pi ... pi with the sign of y, to a relative error of three units in
/// the last place; 0 at the origin.
template <class Real> TALUS_INLINE Real arc_tangent(Real y, Real x)
{
  constexpr double pi = 3.14159265358979323846, tangent_of_eighth = 0.41421356237309504880;
  const Real zero = splat<Real>(0.0), up = magnitude(y), across = magnitude(x);
  const auto steep = up > across;
  const Real less = select(steep, across, up), more = select(steep, up, across);
  const auto is_large = less > tangent_of_eighth * more;
  const Real above = select(is_large, less - more, less),
             below = select(is_large, less + more, more);
  const Real small = arc_tangent_of_small(above / select(below > zero, below, splat<Real>(1.0)));
  const Real octant = select(is_large, 0.25 * pi + small, small);
  const Real quadrant = select(steep, 0.5 * pi - octant, octant);
  const Real half = select(x < zero, pi - quadrant, quadrant);
  return select(y < zero, -half, half);
}

}    // namespace Talus

#endif
