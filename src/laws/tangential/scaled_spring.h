// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Springs of LAMMPS' pair granular with the stiffness k = kt a whose history is more than their
// displacement (see granular.h), to second order in the time step. With the displacement d = f/k
// that belongs to the elastic force f,
//
//   mindlin/force           f' = k v                   d' = v - d a'/a
//   mindlin_rescale         f' = k v + 2 f a'/a        d' = v + d a'/a    while a falls, else mindlin
//   mindlin_rescale/force   f' = k v + f a'/a          d' = v             while a falls, else the first
//
// A step from a contact radius x a to a has, with a^2 linear in time within it (a is the root of the
// overlap), exactly for a constant v
//
//   d = share d_0 + mean dt v,   d_0 = f_old/k of the laws that keep f, d_old of the other
//
// so that a spring which begins with its contact, x = 0, has f = 2/3 k v t.

#ifndef TALUS_LAWS_TANGENTIAL_SCALED_SPRING_H
#define TALUS_LAWS_TANGENTIAL_SCALED_SPRING_H

#include "base/simd.h"

namespace Talus {

template <class Real> struct SpringStep {
  Real share, mean;
};

template <bool of_force, bool rescales, class Real>
TALUS_INLINE SpringStep<Real> spring_step(Real x)
{
  const Real one = splat<Real>(1.0);
  const auto falls = x > one;
  const Real share = rescales ? select(falls, one / x, one) : one;
  if constexpr (!of_force) return {share, select(falls, splat<Real>(2.0) / (one + x), one)};
  const Real mean = splat<Real>(2.0 / 3.0) * (one + x + x * x) / (one + x);
  return {share, rescales ? select(falls, one, mean) : mean};
}

/// The exponent of the overlap with which a spring that sticks ends, p that of k.
template <bool of_force, bool rescales, class Real> TALUS_INLINE Real end_exponent(Real p)
{
  if constexpr (of_force == rescales) return p;
  return of_force ? splat<Real>(0.0) : splat<Real>(1.0);
}

}    // namespace Talus

#endif
