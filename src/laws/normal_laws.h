// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Normal laws. Every law turns coefficients and the state of a contact into the four numbers of
//
//   F_n = kn overlap - gn v_n ,   F_t = -(kt d_t + gt v_t)
//
// with overlap = r_i + r_j - |x_i - x_j|, v_n = (v_i - v_j) . n (negative when approaching; n
// points from j to i). The laws are those of the penalty solver of Project Chrono (Fleischmann,
// Serban, Negrut, Jayakumar, J. Comput. Nonlinear Dyn. 11, 044502, 2016), hooke and hertz with
// coefficients those of the stock gran/* styles. m and R are the effective mass and radius. All
// functions are pure and free of branches; Real is one contact (double) or eight (Vec8).

#ifndef TALUS_LAWS_NORMAL_LAWS_H
#define TALUS_LAWS_NORMAL_LAWS_H

#include "base/simd.h"
#include "laws/contact_law.h"

namespace Talus {

/// Stiffness (force/distance) and damping (force/velocity) of one contact at one instant.
template <class Real> struct Stiffness {
  Real kn, gn, kt, gt;
};

/// What a normal law may read. `speed`: of impact, at least the characteristic speed.
template <class Real> struct NormalInput {
  Real overlap, mass, radius, speed;
};

/// k and g without their dependence on the overlap, as Chrono's rule for the collision time of
/// delayed resistance takes them.
template <class Real> struct ReducedStiffness {
  Real k, g;
};

/// Linear spring and dashpot (Cundall and Strack 1979; stock `gran/hooke*` with mass damping):
/// F_n = kn overlap - m gn v_n. kn, kt force/distance; gn, gt 1/time.
struct NormalHooke {
  static constexpr bool needs_radius = false;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    return {c.kn, in.mass * c.gn, c.kt, in.mass * c.gt};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real /*overlap*/)
  {
    return {s.kn, s.gn};
  }
};

/// Hertzian contact with coefficients (stock `gran/hertz/history`, Silbert et al. 2001):
/// F_n = sqrt(overlap R) (kn overlap - m gn v_n), the same factor on kt and gt.
/// kn, kt force/distance^2; gn, gt 1/(time distance).
struct NormalHertz {
  static constexpr bool needs_radius = true;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    const Real disc = square_root(in.overlap * in.radius);    // radius of the contact disc
    const Real damping = disc * in.mass;
    return {disc * c.kn, damping * c.gn, disc * c.kt, damping * c.gt};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    const Real root = square_root(overlap);
    return {s.kn / root, s.gn / square_root(root)};
  }
};

/// Flores et al. 2011 with coefficients: as hertz, the normal damping times the overlap.
/// kn, kt force/distance^2; gn 1/(time distance^2); gt 1/(time distance).
struct NormalFlores {
  static constexpr bool needs_radius = true;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    Stiffness<Real> s = NormalHertz::stiffness(c, in);
    s.gn = s.gn * in.overlap;
    return s;
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    const Real root = square_root(overlap);
    return {s.kn / root, s.gn / (root * overlap)};
  }
};

/// Chrono's PlainCoulomb with coefficients: kn sqrt(overlap), gn sqrt(overlap), no tangential
/// spring. Kept as it is, although its coefficients have no consistent meaning for other radii and
/// masses.
struct NormalPlainCoulomb {
  static constexpr bool needs_radius = false;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    const Real root = square_root(in.overlap), zero = splat<Real>(0.0);
    return {c.kn * root, c.gn * root, zero, zero};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    return NormalHertz::reduced(s, overlap);
  }
};

/// Linear spring from material and characteristic speed: K = 16/15 sqrt(R) E, kn = K (m
/// v^2/K)^(1/5), kt = kn, gn = gt = f sqrt(m kn). Coefficients: kn = E (effective Young's modulus,
/// pressure), gn = gt = f = 2 / sqrt(1 + (pi/ln e)^2), see restitution.h.
struct NormalHookeMaterial {
  static constexpr bool needs_radius = true;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    const Real scale = (16.0 / 15.0) * square_root(in.radius) * c.kn;
    const Real kn = scale * fifth_root(in.mass * in.speed * in.speed / scale);
    const Real damping = square_root(in.mass * kn);
    return {kn, c.gn * damping, kn, c.gt * damping};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    return NormalHooke::reduced(s, overlap);
  }
};

/// Hertz and Mindlin from material: S_n = 2 E sqrt(R overlap), S_t = 8 G sqrt(R overlap), kn = 2/3
/// S_n, kt = S_t, gn = f sqrt(S_n m), gt = f sqrt(S_t m). Coefficients: kn = E, kt = G (effective
/// moduli, pressure), gn = gt = f, see restitution.h.
struct NormalHertzMaterial {
  static constexpr bool needs_radius = true;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    const Real disc = square_root(in.overlap * in.radius);
    const Real normal = 2.0 * c.kn * disc, tangential = 8.0 * c.kt * disc;
    return {(2.0 / 3.0) * normal, c.gn * square_root(normal * in.mass), tangential,
            c.gt * square_root(tangential * in.mass)};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    return NormalHertz::reduced(s, overlap);
  }
};

/// Flores et al. 2011 from material: S_n, S_t as hertz/material, kn = 2/3 S_n, kt = 2/3 S_t,
/// gn = f kn overlap / v, gt = h sqrt(S_t m). Coefficients: kn = E, kt = G,
/// gn = f = 8/5 (1-e)/e, gt = h = 2 sqrt(5/6) |beta(e)|, both with e between .01 and 1.
struct NormalFloresMaterial {
  static constexpr bool needs_radius = true;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    const Real disc = square_root(in.overlap * in.radius);
    const Real kn = (4.0 / 3.0) * c.kn * disc, tangential = 8.0 * c.kt * disc;
    return {kn, c.gn * kn * in.overlap / in.speed, (2.0 / 3.0) * tangential,
            c.gt * square_root(tangential * in.mass)};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    return NormalFlores::reduced(s, overlap);
  }
};

/// Chrono's PlainCoulomb from material: S_n = 2 E sqrt(overlap), kn = 2/3 S_n, gn = f sqrt(S_n m).
/// Dimensionally inconsistent (no radius); kept as it is. Coefficients: kn = E, gn = f as
/// hertz/material.
struct NormalPlainCoulombMaterial {
  static constexpr bool needs_radius = false;

  template <class Real>
  static Stiffness<Real> stiffness(const Coefficients<Real> &c, const NormalInput<Real> &in)
  {
    const Real normal = 2.0 * c.kn * square_root(in.overlap), zero = splat<Real>(0.0);
    return {(2.0 / 3.0) * normal, c.gn * square_root(normal * in.mass), zero, zero};
  }

  template <class Real>
  static ReducedStiffness<Real> reduced(const Stiffness<Real> &s, Real overlap)
  {
    return NormalHertz::reduced(s, overlap);
  }
};

}    // namespace Talus

#endif
