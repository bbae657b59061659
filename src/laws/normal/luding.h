// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Elasto-plastic and adhesive, Luding (2008, Granular Matter 10, 235; equations 6 and 7): with the largest overlap m,
//
//   F_e = k1 overlap                       loading, as deep as never before
//   F_e = k (overlap - d_0)                unloading and loading again, d_0 = (1 - k1/k) m
//   F_e = -kc overlap                      where that would attract more
//
// The slope grows with the depth, k = k1 + (k2 - k1) m/m_p, up to k2 at m_p = k2/(k2 - k1) phi 2 R_eff: from there on
// the contact is elastic, F_e = k2 (overlap - phi 2 R_eff). On the last branch m is set back so that the branch of
// loading again begins there. It is less than 0 or 0 when bodies come apart: there is no force beyond touch. Friction is
// limited by mu (F_e + kc overlap), without damping.

#ifndef TALUS_LAWS_NORMAL_LUDING_H
#define TALUS_LAWS_NORMAL_LUDING_H

#include "laws/normal/hysteretic.h"

namespace Talus {

template <class Real> struct LudingRow {
  Real k1, k2, kc, depth, kt;    ///< depth: 2 phi k2/(k2 - k1), m_p over R_eff
};

struct Luding : HystereticLaw {
  static constexpr const char *name = "luding", *label = name;
  static constexpr bool cohesive = true;
  template <class Real> using Row = LudingRow<Real>;
  static constexpr CoefficientName coefficients[] = {
      {"k1"}, {"k2"}, {"kc"}, {"depth"}, {"kt", Shown::WITH_SPRING}};

  static void read(LawReader &r)
  {
    read_stiffnesses(r);
    r.spec.given["kc"] = r.words.not_negative("adhesive stiffness kc");
    r.spec.given["phi"] = r.words.positive("plasticity depth phi");
    read_damping(r, Damping::ANY);
  }
  static Row<double> mix(const Mixing &m)
  {
    const HystereticRow<double> k = mix_stiffnesses(m);
    return {k.k1, k.k2, m.mean("kc"), 2.0 * m.mean("phi") * k.k2 / (k.k2 - k.k1), k.kt};
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real *history,
                                   double /*dt*/)
  {
    const Real most = c.depth * s.radius, growth = (c.k2 - c.k1) / most;
    const Real reached = select(s.overlap < most, s.overlap, most);
    Real deepest = at_least(history[0], reached), slope = c.k1 + growth * deepest;
    Real elastic = slope * s.overlap - growth * deepest * deepest;
    const auto pulls = elastic < -c.kc * s.overlap;
    if (any(pulls)) {    // force of the m that is kept: that of a later set-up
      deepest = select(pulls, set_back(c, s.overlap, growth), deepest);
      slope = c.k1 + growth * deepest;
      elastic = slope * s.overlap - growth * deepest * deepest;
    }
    set(s, slope, elastic, c.k2, c.kt);
    s.pulloff_force = 0.5 * c.kc * s.overlap;    // see finish_normal_force()
    if constexpr (advance) history[0] = deepest;
  }

 private:
  /// The m whose branch meets -kc overlap here.
  template <class Real>
  TALUS_INLINE static Real set_back(const Row<Real> &c, Real overlap, Real growth)
  {
    return 0.5 * (overlap + square_root(overlap * (overlap + 4.0 * (c.k1 + c.kc) / growth)));
  }
};

}    // namespace Talus

#endif
