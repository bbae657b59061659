// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Normal laws. Every law turns coefficients and the state of a contact into the four numbers of
//
//   F_n = kn overlap - gn v_n ,   F_t = -(kt d_t + gt v_t)
//
// with overlap = r_i + r_j - |x_i - x_j|, v_n = (v_i - v_j) . n (negative when approaching; n points from j to i).
// All functions are pure and free of branches; Real is one contact (double) or eight (Vec8).

#ifndef TALUS_CONTACT_NORMAL_LAWS_H
#define TALUS_CONTACT_NORMAL_LAWS_H

#include "contact/contact_law.h"
#include "contact/simd.h"

namespace Talus {

/// Stiffness (force/distance) and damping (force/velocity) of one contact at one instant.
template <class Real> struct Stiffness {
  Real kn, gn, kt, gt;
};

/// Linear spring and dashpot (Cundall and Strack 1979; stock `gran/hooke*` with mass damping):
/// F_n = kn overlap - m_eff gn v_n.
struct NormalHooke {
  static constexpr bool needs_radius = false;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, Real /*overlap*/, Real mass_eff,
                                   Real /*radius_eff*/)
  {
    return {c.kn, mass_eff * c.gn, c.kt, mass_eff * c.gt};
  }
};

/// Hertzian contact with coefficients (stock `gran/hertz/history`, Silbert et al. 2001):
/// F_n = sqrt(overlap R_eff) (kn overlap - m_eff gn v_n), the same factor on kt and gt.
struct NormalHertz {
  static constexpr bool needs_radius = true;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, Real overlap, Real mass_eff,
                                   Real radius_eff)
  {
    const Real disc = square_root(overlap * radius_eff);    // radius of the contact disc
    const Real damping = disc * mass_eff;
    return {disc * c.kn, damping * c.gn, disc * c.kt, damping * c.gt};
  }
};

}    // namespace Talus

#endif
