// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spring, dashpot and slider of twisting, as LAMMPS' pair granular has them: torque M n on body 1,
// -M n on body 2 with M = -(k xi + g w), w = (omega_1 - omega_2).n, xi the integral of w; where |M|
// exceeds the limit L, M = -L sign(w) and xi is set back to (L sign(w) - g w)/k. What is computed
// at the limit is the torque of the xi that is stored, so that a set-up reproduces it.

#ifndef TALUS_LAWS_TWISTING_SPRING_H
#define TALUS_LAWS_TWISTING_SPRING_H

#include "laws/law_definition.h"

namespace Talus {

template <class Real> struct TwistInput {
  Real k, damping, limit;
};

template <bool advance, class Real>
TALUS_INLINE void add_twisting_spring(const TwistInput<Real> &in, ContactLanes<Real> &s, Real &kept,
                                      double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const Real w = dot(s.relative_omega, s.normal), drag = in.damping * w;
  const Real direction = select(w > zero, one, select(w < zero, -one, zero));
  const auto by_spring = (in.k > zero) & (in.limit > zero);
  const Real xi = advance ? kept + w * dt : kept;
  Real torque = -(in.k * xi + drag);
  // of a stored xi at the limit the torque is the limit but for rounding
  const double slack = advance && dt > 0.0 ? 0.0 : 1.0e-12;
  const Real rounding =
      select(by_spring, slack * (in.k * magnitude(xi) + magnitude(drag) + in.limit), zero);
  const auto slides = magnitude(torque) > in.limit + rounding;
  const Real set_back = (in.limit * direction - drag) / select(in.k > zero, in.k, one);
  const Real left = select(slides & (in.k > zero), set_back, xi);
  const Real at_limit = -in.limit * direction;
  torque = select(slides, advance ? select(by_spring, -(in.k * left + drag), at_limit) : at_limit,
                  torque);
  if constexpr (advance) kept = left;
  // zeros without a sign: it would not be the same in a step and in a later set-up
  s.twisting_torque = s.twisting_torque + (torque + zero) * s.normal;
}

}    // namespace Talus

#endif
