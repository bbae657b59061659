// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Tangential laws: F_t = -(kt d_t + gt v_t), capped at the Coulomb limit mu |F_n|.
// v_t is the relative surface velocity of body i against body j without its normal part (velocity
// units), d_t the tangential displacement (length) in the sense of the chosen law.
//
// The multistep laws keep d_t for the life of a contact. They differ in what happens to it at the
// limit L = mu |F_n|, where T = kt d_t + gt v_t is the force that would be and F = L T/|T| is what
// remains of it:
//
//   stock    d_t <- (F - gt v_t)/kt: spring and dashpot together reach the limit with the velocity
//   of
//            the whole slip. The rule of Cundall and Strack as the stock gran/*/history styles and
//            Chrono have it. Where the dashpot alone exceeds the limit it winds the spring up
//            against the sliding: friction falls short of the limit later, or energy is gained.
//   slider   spring and dashpot in parallel, both in series with a slider: the dashpot sees only
//   the
//            rate of d_t. Backward Euler of gt d_t' = F - kt d_t, which is d_t <- (dt F + gt
//            d_0)/(dt kt + gt) with d_0 from before the step. F d_t' = gt d_t'^2 + rate of kt
//            d_t^2/2, and the slip takes the rest of F v_t: no energy can be gained at constant kt,
//            however large gt is. (Return mapping of viscoplasticity: Simo and Hughes 1998,
//            Computational Inelasticity, chapter 1; the body is Bingham's.) Equal to stock if gt =
//            0.
//
// In both, kt d_t + gt v_t of the new d_t is along F and not shorter than it. The force of a
// contact at its limit is taken along (d_t + gt/kt v_t) of the *stored* displacement, with the
// length of the limit: so the force is a function of positions, velocities and stored history
// alone, and a restart or a new run reproduces it bit for bit without advancing the history. (If
// other velocities have come in between, as with fix nve/sphere, and the force is clearly below the
// limit with them, then it is not at the limit.)

#ifndef TALUS_CONTACT_TANGENTIAL_LAWS_H
#define TALUS_CONTACT_TANGENTIAL_LAWS_H

#include "contact/normal_laws.h"
#include "contact/vector3.h"

namespace Talus {

/// History of one contact as seen from its first body.
template <class Real> struct TangentialHistory {
  Vector3<Real> displacement{};    ///< d_t, length
  Real at_limit{};                 ///< 1 if the last force was the Coulomb limit, else 0
};

/// What a tangential law is given: k, v_t, the normal, mu |F_n|, mu F_n, the time step and the
/// speed below which a law with a threshold does nothing.
template <class Real> struct TangentialInput {
  Stiffness<Real> k;
  Vector3<Real> velocity;
  Vector3<Real> normal;
  Real limit;
  Real signed_limit;
  Real dt;    ///< what the contact has lasted of the step, for the midpoint laws
  Real slip_min;
  Vector3<Real> increment;    ///< displacement of this step; only for the midpoint laws
};

/// Shortens a trial force to the limit; forces within it pass unchanged.
template <class Real> inline Vector3<Real> capped(Vector3<Real> trial, Real limit)
{
  const Real square = dot(trial, trial);
  const auto exceeds = square > limit * limit;
  if (!any(exceeds)) return trial;
  return select(exceeds, limit / square_root(square), splat<Real>(1.0)) * trial;
}

struct TangentialNone {
  static constexpr bool friction = false, history = false, midpoint = false;
};

struct TangentialDashpot {
  static constexpr bool friction = true, history = false, midpoint = false;

  template <class Real> TALUS_INLINE static Vector3<Real> force(const TangentialInput<Real> &in)
  {
    return capped(-in.k.gt * in.velocity, in.limit);
  }
};

struct TangentialOnestep {
  static constexpr bool friction = true, history = false, midpoint = false;

  template <class Real> TALUS_INLINE static Vector3<Real> force(const TangentialInput<Real> &in)
  {
    return capped(-(in.k.kt * in.dt + in.k.gt) * in.velocity, in.limit);
  }
};

/// Chrono's PlainCoulomb: F_t = -mu F_n tanh(5 |v_t|) v_t/|v_t|, with the sign of F_n; the 5 has
/// the unit 1/velocity and is not scaled by `units`.
struct TangentialTanh {
  static constexpr bool friction = true, history = false, midpoint = false;

  template <class Real> TALUS_INLINE static Vector3<Real> force(const TangentialInput<Real> &in)
  {
    const Real speed = square_root(dot(in.velocity, in.velocity));
    const auto slips = (speed >= in.slip_min) & (speed > splat<Real>(0.0));
    const Real pull = in.signed_limit * hyperbolic_tangent(5.0 * speed) / speed;
    return select(slips, -pull, splat<Real>(0.0)) * in.velocity;
  }
};

/// The displacement that is stored at the limit; share = limit/|trial force|, slide = gt/kt, reach
/// = d + slide v_t with the trial displacement d.
template <bool slider, class Real>
inline Vector3<Real> set_back(const TangentialInput<Real> &in, const Vector3<Real> &d, Real share,
                              Real slide, const Vector3<Real> &reach)
{
  if constexpr (slider) {
    const Real time = in.dt + slide, zero = splat<Real>(0.0);
    const auto takes_time = time > zero;    // else a spring alone
    const Real fresh = select(takes_time, in.dt / time, splat<Real>(1.0));
    const Vector3<Real> before = d - in.dt * in.velocity;
    return (fresh * share) * reach + select(takes_time, slide / time, zero) * before;
  }
  return share * reach - slide * in.velocity;
}

/// From the trial displacement to the force: the Coulomb limit, and the displacement that is
/// stored. Most vectors of contacts in a bed at rest are within the limit in all lanes: these do
/// without the roots and quotients of the limit.
template <bool advance, bool slider, class Real>
TALUS_INLINE Vector3<Real> limited_force(const TangentialInput<Real> &in, Vector3<Real> d,
                                         bool_of<Real> moved, TangentialHistory<Real> &history)
{
  const Real zero = splat<Real>(0.0);
  const Vector3<Real> trial = -(in.k.kt * d + in.k.gt * in.velocity);
  const Real square = dot(trial, trial);
  const auto exceeds = square > in.limit * in.limit;
  if (advance && !any(exceeds)) {
    history = {d, zero};
    return trial;
  }

  // without overlap kt is zero; so is the limit, and any finite number serves
  const Real slide = select(in.k.kt > zero, in.k.gt / in.k.kt, zero);
  const Real size = square_root(square);
  Vector3<Real> reach = d + slide * in.velocity;
  auto at_limit = moved & exceeds;
  if (advance) {
    d = select(at_limit, set_back<slider>(in, d, in.limit / size, slide, reach), d);
    reach = d + slide * in.velocity;
    history.displacement = d;
    history.at_limit = select(at_limit, splat<Real>(1.0), zero);
  } else {
    // the flag counts as long as spring and dashpot reach the limit but for rounding: not with
    // other velocities or coefficients
    const Real parts = in.k.kt * square_root(dot(d, d)) +
                       in.k.gt * square_root(dot(in.velocity, in.velocity)) + in.limit;
    at_limit = at_limit | ((history.at_limit > zero) & (size + 1.0e-12 * parts >= in.limit));
  }

  const Real length = square_root(dot(reach, reach));
  const Real pull = select(length > zero, -in.limit / length, zero);
  // beyond the limit without any displacement (first force of a run): none, as the stock styles
  const Vector3<Real> within = select(exceeds, Vector3<Real>{zero, zero, zero}, trial);
  return select(at_limit, pull * reach, within);
}

/// d in the plane normal to n, with its length.
template <class Real> inline Vector3<Real> turned(const Vector3<Real> &d, const Vector3<Real> &n)
{
  const Vector3<Real> flat = d - dot(d, n) * n;
  const Real before = dot(d, d), after = dot(flat, flat);
  return select(after > splat<Real>(0.0), square_root(before / after), splat<Real>(0.0)) * flat;
}

/// With `midpoint` the update of the displacement is consistent to second order in the time step:
///   * the displacement of a step is taken along the surface half way through it, not at its end;
///   * a contact that began during the step adds only the part of it that it lasted;
///   * the stored displacement keeps its length when it turns with the contact.
/// (Xue et al. 2023, CMES 134, 1469, on why the usual update limits a scheme to first order.)
template <bool midpoint_, bool slider> struct TangentialMultistep {
  static constexpr bool friction = true, history = true, midpoint = midpoint_;

  /// Force on the first body. `advance` adds the displacement of this step and turns the stored one
  /// into the tangent plane; without it (set-up of a run, queries) the history is only read.
  template <bool advance, class Real>
  TALUS_INLINE static Vector3<Real> force(const TangentialInput<Real> &in,
                                          TangentialHistory<Real> &history)
  {
    const Real zero = splat<Real>(0.0);
    Vector3<Real> d = history.displacement;
    if (advance)
      d = midpoint ? turned(d, in.normal) + turned(in.increment, in.normal)
                   : d + in.dt * in.velocity;
    const auto moved = dot(d, d) > zero;
    if (advance && !midpoint) d = d - dot(d, in.normal) * in.normal;
    return limited_force<advance, slider>(in, d, moved, history);
  }
};

}    // namespace Talus

#endif
