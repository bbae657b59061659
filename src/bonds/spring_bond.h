// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The spring between two bonded particles, for one bond (Real = double) or eight (Real = Vec8): that of LAMMPS' bond_style
// bpm/spring. Particle 1 is the one with the lower ID. Any consistent units.
//
// J. T. Clemmer, J. M. Monti, J. B. Lechman, Soft Matter 20, 1702 (2024). With n from 2 to 1, r the distance, r0 that at
// rest, e = (r - r0)/r0, v the velocity of 1 less that of 2:
//
//   force on 1 = s (-k (r - r0) - gamma v.n + av (c - e)) n,    s = 1 - (e/ecrit)^8 with `smooth`, else 1
//
// c is the strain of the volumes around both: with V the sum of r^d over the bonds of a particle in d dimensions, V0 that
// of r0^d, c = ((V1 + V2)/(V01 + V02))^(1/d) - 1. The bond breaks beyond |e| = ecrit.

#ifndef TALUS_BONDS_SPRING_BOND_H
#define TALUS_BONDS_SPRING_BOND_H

#include "base/vector3.h"

namespace Talus {

/// Force per length, strain, force over velocity, and force.
template <class Real> struct SpringCoeffs {
  Real stiffness, limit, damping, of_volume;
};

template <class Real> struct SpringPair {
  Real length_at_rest;
  Vector3<Real> separation, velocity;    ///< of 1 less those of 2
  Real volume_strain;                    ///< c
};

template <class Real> struct SpringLoads {
  Vector3<Real> force;    ///< the force on 1; that on 2 is the opposite
  Real strain;            ///< e
  Real energy;            ///< of the stiffness alone
  Real share;             ///< s: `force` has been multiplied by it
};

template <class Real>
TALUS_INLINE SpringLoads<Real> load_spring(const SpringPair<Real> &pair,
                                           const SpringCoeffs<Real> &c, bool smooth)
{
  const Real one = splat<Real>(1.0);
  const Real length = square_root(dot(pair.separation, pair.separation));
  const Vector3<Real> normal = (one / length) * pair.separation;
  const Real stretch = length - pair.length_at_rest;
  SpringLoads<Real> to;
  to.strain = stretch / pair.length_at_rest;
  to.energy = splat<Real>(0.5) * c.stiffness * stretch * stretch;
  to.share = one;
  if (smooth) {
    const Real part = to.strain / c.limit, square = part * part, fourth = square * square;
    to.share = one - fourth * fourth;
  }
  const Real force = c.of_volume * (pair.volume_strain - to.strain) - c.stiffness * stretch -
                     c.damping * dot(pair.velocity, normal);
  to.force = (to.share * force) * normal;
  return to;
}

}    // namespace Talus

#endif
