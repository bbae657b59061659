// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The rule "stock" of sliding.h to second order in the time step, for laws whose stiffness does not
// vanish faster than their dashpot where a contact begins: the force T = k d + g v of spring and
// dashpot together returns to its limit, and d is set back to what T then leaves for the spring.
// The return is along the mean of the old and the new force (generalized midpoint rule: Ortiz and
// Popov 1985, Int. J. Numer. Meth. Eng. 21, 1561).
//
// Where a contact begins, a time theta dt before the first step, T jumps to g v or to its limit
// there, which d then makes up for. d is not set back in that step itself: v does not yet know the
// contact.

#ifndef TALUS_LAWS_TANGENTIAL_SET_BACK_H
#define TALUS_LAWS_TANGENTIAL_SET_BACK_H

#include "base/simd.h"
#include "base/vector3.h"

namespace Talus {

/// v shortened or stretched to a length; zero stays zero.
template <class Real> TALUS_INLINE Vector3<Real> with_length(Real length, const Vector3<Real> &v)
{
  const Real zero = splat<Real>(0.0), size = square_root(dot(v, v));
  return select(size > zero, length / size, zero) * v;
}

/// Not above the limit; of that length along `other` if v is.
template <class Real>
TALUS_INLINE Vector3<Real> limited(const Vector3<Real> &v, Real limit, const Vector3<Real> &other)
{
  return select(dot(v, v) > limit * limit, with_length(limit, other), v);
}
template <class Real> TALUS_INLINE Vector3<Real> limited(const Vector3<Real> &v, Real limit)
{
  return limited(v, limit, v);
}

/// From `trial`, longer than the limit, to a force of its length. old: force a step ago.
template <class Real>
TALUS_INLINE Vector3<Real> midpoint_return(const Vector3<Real> &trial, const Vector3<Real> &old,
                                           Real limit)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const Real square = limit * limit, beyond = dot(trial, trial) - square;
  const Real b = dot(trial, old) + square;
  const Real root = b * b - (dot(old, old) - square) * beyond;
  const Real sum = b + square_root(select(root > zero, root, zero));
  const Real share = select((root >= zero) & (sum > zero), beyond / sum, zero);
  // of the length of the limit but for rounding, and radially where there is no such return
  return with_length(limit, one / (one + share) * (trial - share * old));
}

}    // namespace Talus

#endif
