// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Constant directional torque, as rolling_friction cdt of LIGGGHTS (model A of Ai et al. 2011, Powder
// Technology 206, 269): with w = omega_1 - omega_2 and the effective radius R
//
//   T = -mu_r F_e R (w/|w| - (w/|w| . n) n)    on body 1, its opposite on body 2,
//
// where F_e is the elastic part of the normal force. It resists two bodies that roll on each other; R
// is half the radius between equal spheres and the radius at a wall. As there it is not limited: a
// body that should rest is turned back and forth. `capped` limits it to what stops the rotation.

#ifndef TALUS_LAWS_ROLLING_CDT_H
#define TALUS_LAWS_ROLLING_CDT_H

#include "laws/law_definition.h"
#include "laws/rolling/common.h"

namespace Talus {

struct CdtRolling : RollingLaw {
  static constexpr const char *name = "cdt", *label = "rolling cdt";
  static constexpr bool needs_radius = true;
  template <class Real> struct Row {
    Real mu;
  };
  static constexpr CoefficientName coefficients[] = {{"mu_cdt"}};

  static void read(LawReader &r)
  {
    r.set_not_negative("mu_cdt");
    if (r.words.take("capped")) r.spec.law.choose(stage, capped());
  }
  static Row<double> mix(const Mixing &m) { return {m.friction("mu_cdt")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    add_torque(s, torque(c, s));
  }

  static const Law *capped();    // CappedCdt

 protected:
  /// Over the rotation across the normal.
  template <class Real> TALUS_INLINE static Real torque(const Row<Real> &c, ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real speed = square_root(dot(s.relative_omega, s.relative_omega));
    const auto turns = speed > zero;
    const Real presses = select(s.elastic > zero, s.elastic, zero);
    return select(turns, c.mu * presses * s.radius / select(turns, speed, one), zero);
  }
  template <class Real> TALUS_INLINE static void add_torque(ContactLanes<Real> &s, Real over_omega)
  {
    const Vector3<Real> across = s.relative_omega - dot(s.relative_omega, s.normal) * s.normal;
    s.twisting_torque = s.twisting_torque - over_omega * across;
  }
};

/// Not more than what takes stopping_share of the rotation away in a step, of solid spheres. For w
/// changes by 5/2 dt (1/(m_1 r_1^2) + 1/(m_2 r_2^2)) for each unit of torque, and that is not more
/// than with R in place of the radii.
struct CappedCdt : CdtRolling {
  static constexpr const char *name = "cdt capped", *label = "rolling cdt capped";
  static constexpr std::nullptr_t read = nullptr;

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double dt)
  {
    const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
    const Real turns = response(s.inverse_mass, dt);
    const Real most =
        select(turns > zero,
               stopping_share * s.radius * s.radius / select(turns > zero, turns, one), zero);
    const Real whole = torque(c, s);
    add_torque(s, select(whole < most, whole, most));
  }
};

}    // namespace Talus

#endif
