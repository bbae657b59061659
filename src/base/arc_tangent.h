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

namespace arc_tangent_detail {

template <class Real> TALUS_INLINE auto is_tiny(Real y, Real x)
{
  return magnitude(y) * 32.0 <= x;
}

/// Of |y| <= x/32, six terms of the same series: the next one is below 1e-19 of the first.
template <class Real> TALUS_INLINE Real of_tiny(Real y, Real x)
{
  const Real t = y / select(x > splat<Real>(0.0), x, splat<Real>(1.0)), t2 = t * t;
  Real sum = splat<Real>(-1.0 / 11.0);
  for (int n = 9; n >= 3; n -= 2) sum = sum * t2 + (n % 4 == 1 ? 1.0 : -1.0) / n;
  return t + t * (t2 * sum);
}

template <class Real> TALUS_INLINE Real of_any(Real y, Real x)
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

}    // namespace arc_tangent_detail

/// The angle between the x-axis and (x, y), in -pi ... pi with the sign of y, to a relative error of three units in
/// the last place; 0 at the origin. Faster if all are below 1/32; the bits of one do not depend on the others.
TALUS_INLINE double arc_tangent(double y, double x)
{
  using namespace arc_tangent_detail;
  return is_tiny(y, x) ? of_tiny(y, x) : of_any(y, x);
}
TALUS_INLINE Vec8 arc_tangent(Vec8 y, Vec8 x)
{
  using namespace arc_tangent_detail;
  constexpr unsigned all = 0xFF;
  const auto tiny = is_tiny(y, x);
  const Vec8 found = of_tiny(y, x);
  return bits_of(tiny) == all ? found : select(tiny, found, of_any(y, x));
}

}    // namespace Talus

#endif
