// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Hertz and Mindlin from material: with the contact radius a = sqrt(R overlap), tangent stiffnesses
// S_n = 2 E_eff a and S_t = 8 G_eff a, kn = 2/3 S_n, kt = S_t.

#ifndef TALUS_LAWS_NORMAL_HERTZ_MATERIAL_H
#define TALUS_LAWS_NORMAL_HERTZ_MATERIAL_H

#include "laws/normal/common.h"

namespace Talus {

struct HertzMaterial : HertzianLaw {
  static constexpr const char *name = "hertz/material", *label = name;
  static constexpr const char *damping = "restitution";
  template <class Real> struct Row {
    Real young, shear;
  };
  static constexpr CoefficientName coefficients[] = {{"E_eff"}, {"G_eff", Shown::WITH_SPRING}};

  static void read(LawReader &r) { read_material(r, Damping::ANY); }
  /// A kt that was given by number stands for 8 G.
  static Row<double> mix(const Mixing &m) { return {mixed_young(m), mixed_shear(m, 1.0 / 8.0)}; }
  static double modulus(const Row<double> &c) { return c.young; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.contact_radius = square_root(s.overlap * s.radius);
    s.tangent_n = 2.0 * c.young * s.contact_radius;
    s.kt = s.tangent_t = 8.0 * c.shear * s.contact_radius;
    s.kn = (2.0 / 3.0) * s.tangent_n;
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
