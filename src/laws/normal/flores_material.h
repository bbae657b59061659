// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Flores et al. 2011 from material: S_n = 2 E_eff a and S_t = 8 G_eff a as hertz/material, kn = 2/3
// S_n, kt = 2/3 S_t; with damping of its own, which takes the impact speed.

#ifndef TALUS_LAWS_NORMAL_FLORES_MATERIAL_H
#define TALUS_LAWS_NORMAL_FLORES_MATERIAL_H

#include "laws/normal/common.h"
#include "laws/normal/flores.h"

namespace Talus {

struct FloresMaterial : HertzianLaw {
  static constexpr const char *name = "flores/material", *label = name;
  static constexpr const char *damping = "flores/material";
  template <class Real> struct Row {
    Real young, shear;
  };
  static constexpr CoefficientName coefficients[] = {{"E_eff"}, {"G_eff", Shown::WITH_SPRING}};

  static void read(LawReader &r)
  {
    read_material(r, Damping::OWN);
    r.spec.given["vchar"] = r.words.positive("characteristic speed vchar");
  }
  /// A kt that was given by number stands for 16/3 G.
  static Row<double> mix(const Mixing &m) { return {mixed_young(m), mixed_shear(m, 3.0 / 16.0)}; }
  static double modulus(const Row<double> &c) { return c.young; }
  template <class Real> static void reduce(Real overlap, Real &k, Real &g)
  {
    Flores::reduce(overlap, k, g);
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.contact_radius = square_root(s.overlap * s.radius);
    s.kn = (4.0 / 3.0) * c.young * s.contact_radius;
    s.tangent_n = 1.5 * s.kn;
    s.tangent_t = 8.0 * c.shear * s.contact_radius;
    s.kt = (2.0 / 3.0) * s.tangent_t;
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
