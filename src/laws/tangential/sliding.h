// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a displacement that is kept becomes at the Coulomb limit L = mu |F_n|. T = kt d_t + gt v_t
// is the force that would be and F = L T/|T| is what remains of it:
//
//   stock    d_t <- (F - gt v_t)/kt: spring and dashpot together reach the limit with the velocity
//            of the whole slip. The rule of Cundall and Strack as the stock gran/*/history styles
//            and Chrono have it. Where the dashpot alone exceeds the limit it winds the spring up
//            against the sliding: friction falls short of the limit later, or energy is gained.
//   slider   spring and dashpot in parallel, both in series with a slider: the dashpot sees only
//            the rate of d_t. Backward Euler of gt d_t' = F - kt d_t, which is
//            d_t <- (dt F + gt d_0)/(dt kt + gt) with d_0 from before the step.
//            F d_t' = gt d_t'^2 + rate of kt d_t^2/2, and the slip takes the rest of F v_t: no
//            energy can be gained at
//            constant kt, however large gt is. (Return mapping of viscoplasticity: Simo and Hughes
//            1998, Computational Inelasticity, chapter 1; the body is Bingham's.) Equal to stock if
//            gt = 0.
//
// In both, kt d_t + gt v_t of the new d_t is along F and not shorter than it. The force of a
// contact at its limit is computed from the *stored* displacement, as the force of spring and
// dashpot (stock) or along it with the length of the limit (slider): so the force is a function of
// positions, velocities and stored history alone, and a restart or a new run reproduces it bit for
// bit without advancing the history. (If other velocities have come in between, as with fix
// nve/sphere, then the limit applies to them.)

#ifndef TALUS_LAWS_TANGENTIAL_SLIDING_H
#define TALUS_LAWS_TANGENTIAL_SLIDING_H

#include "base/vector3.h"

namespace Talus {

/// History of one contact as seen from its first body.
template <class Real> struct TangentialHistory {
  Vector3<Real> displacement{};    ///< d_t, length
  Real sliding{};                  ///< 1 if the last force was the Coulomb limit, else 0
};

template <class Real> struct SlidingInput {
  Real kt, gt;
  Vector3<Real> velocity;    ///< v_t
  Real limit;                ///< mu critical_force
  Real dt;                   ///< what the contact has lasted of the step
};

/// A trial displacement d and its force T, with what stands between it and the Coulomb limit.
template <class Real> struct Trial {
  Vector3<Real> displacement, force;
  Vector3<Real> drag;       ///< gt v_t
  Real square;              ///< |T|^2
  bool_of<Real> exceeds;    ///< |T| > L
  bool_of<Real> moved;      ///< whether there is a displacement at all
};

/// kt |d| + gt |v_t| + L: what a force at the limit consists of, and its rounding errors.
template <class Real> inline Real parts_of(const SlidingInput<Real> &in, const Trial<Real> &trial)
{
  return in.kt * square_root(dot(trial.displacement, trial.displacement)) +
         square_root(dot(trial.drag, trial.drag)) + in.limit;
}

/// The same numbers, zeros without a sign.
template <class Real> TALUS_INLINE Vector3<Real> unsigned_zeros(const Vector3<Real> &v)
{
  const Real zero = splat<Real>(0.0);
  return v + Vector3<Real>{zero, zero, zero};
}

/// The limit of `stock`. The force is that of the displacement that is stored, which has the length
/// of the limit but for rounding; without a spring, or if the limit is zero, it is L T/|T| itself:
/// then a zero would have the sign of T, which is not the same in a step and in a later set-up.
template <bool advance, class Real>
TALUS_INLINE Vector3<Real> stock_limit(const SlidingInput<Real> &in, const Trial<Real> &trial,
                                       TangentialHistory<Real> &history)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto with_spring = in.kt > zero;
  const Real kt = select(with_spring, in.kt, one), size = square_root(trial.square);
  const Real inverse = one / (size * kt);    // two quotients for the price of one
  const Vector3<Real> capped = (in.limit * kt * inverse) * trial.force;
  const auto by_spring = with_spring & (in.limit > zero);
  if constexpr (advance) {
    const Vector3<Real> set_back = -(size * inverse) * (capped + trial.drag);
    // only where no time passes a displacement can be zero while a velocity is not
    const auto slides = trial.exceeds & trial.moved;
    const Vector3<Real> d = select(slides & with_spring, set_back, trial.displacement);
    history = {d, select(slides, one, zero)};
    const Vector3<Real> sliding = select(by_spring, -(in.kt * d + trial.drag), capped);
    const Vector3<Real> none{zero, zero, zero};
    return unsigned_zeros(select(trial.exceeds, select(slides, sliding, none), trial.force));
  }
  // the flag counts as long as spring and dashpot do not exceed the limit but for rounding: not
  // with other velocities or coefficients
  const Real rounding = 1.0e-12 * parts_of(in, trial);
  const auto was_there = history.sliding > zero;
  const auto stays = was_there & by_spring & (size <= in.limit + rounding);
  const Vector3<Real> beyond =
      select(trial.moved | was_there, capped, Vector3<Real>{zero, zero, zero});
  return unsigned_zeros(select(stays, trial.force, select(trial.exceeds, beyond, trial.force)));
}

/// The limit of `slider`. The force is taken along d + gt/kt v_t of the displacement that is
/// stored.
template <bool advance, class Real>
TALUS_INLINE Vector3<Real> slider_limit(const SlidingInput<Real> &in, const Trial<Real> &trial,
                                        TangentialHistory<Real> &history)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  // without overlap kt is zero; so is the limit, and any finite number serves
  const Real slide = select(in.kt > zero, in.gt / in.kt, zero);
  const Real size = square_root(trial.square);
  Vector3<Real> d = trial.displacement, reach = d + slide * in.velocity;
  auto sliding = trial.moved & trial.exceeds;
  if (advance) {
    const Real time = in.dt + slide;
    const auto takes_time = time > zero;    // else a spring alone
    const Real fresh = select(takes_time, in.dt / time, one);
    const Vector3<Real> before = d - in.dt * in.velocity;
    const Vector3<Real> set_back =
        (fresh * (in.limit / size)) * reach + select(takes_time, slide / time, zero) * before;
    d = select(sliding, set_back, d);
    reach = d + slide * in.velocity;
    history = {d, select(sliding, one, zero)};
  } else {
    // as with stock
    sliding =
        sliding | ((history.sliding > zero) & (size + 1.0e-12 * parts_of(in, trial) >= in.limit));
  }
  const Real length = square_root(dot(reach, reach));
  const Real pull = select(length > zero, -in.limit / length, zero);
  const Vector3<Real> within = select(trial.exceeds, Vector3<Real>{zero, zero, zero}, trial.force);
  return select(sliding, pull * reach, within);
}

/// From the trial displacement to the force: the Coulomb limit, and the displacement that is
/// stored. Beyond the limit without any displacement (first force of a run) there is none, as in
/// the stock styles.
template <bool advance, bool slider, class Real>
TALUS_INLINE Vector3<Real> limited_force(const SlidingInput<Real> &in, const Vector3<Real> &d,
                                         bool_of<Real> moved, TangentialHistory<Real> &history)
{
  const Vector3<Real> drag = in.gt * in.velocity, force = -(in.kt * d + drag);
  const Real square = dot(force, force);
  const Trial<Real> trial{d, force, drag, square, square > in.limit * in.limit, moved};
  if (slider && advance && !any(trial.exceeds)) {    // spares many roots and quotients
    history = {d, splat<Real>(0.0)};
    return force;
  }
  return slider ? slider_limit<advance>(in, trial, history)
                : stock_limit<advance>(in, trial, history);
}

}    // namespace Talus

#endif
