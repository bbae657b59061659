// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Chrono's PlainCoulomb from material: S_n = 2 E_eff sqrt(overlap), kn = 2/3 S_n, no tangential
// spring but a friction of its own. Dimensionally inconsistent (no radius); kept as it is.

#ifndef TALUS_LAWS_NORMAL_PLAINCOULOMB_MATERIAL_H
#define TALUS_LAWS_NORMAL_PLAINCOULOMB_MATERIAL_H

#include "laws/normal/common.h"

namespace Talus {

struct PlainCoulombMaterial : HertzianLaw {
  static constexpr const char *name = "plaincoulomb/material", *label = name;
  static constexpr const char *damping = "restitution";
  static constexpr bool needs_radius = false;
  template <class Real> struct Row {
    Real young;
  };
  static constexpr CoefficientName coefficients[] = {{"E_eff"}};

  static void read(LawReader &r)
  {
    read_material(r, Damping::OWN);
    r.set_not_negative("mu");
    r.spec.law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, "tanh"));
  }
  static Row<double> mix(const Mixing &m) { return {mixed_young(m)}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.tangent_n = 2.0 * c.young * square_root(s.overlap);
    s.kn = (2.0 / 3.0) * s.tangent_n;
    s.kt = s.tangent_t = splat<Real>(0.0);
    s.contact_radius = square_root(s.overlap * s.radius);
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
