// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Linear spring from material and impact speed v: K = 16/15 sqrt(R) E_eff, kn = kt = K (m
// v^2/K)^(1/5): an elastic impact at this speed has the largest overlap of a Hertzian one. v:
// impact speed if it is kept, at least the characteristic speed.

#ifndef TALUS_LAWS_NORMAL_HOOKE_MATERIAL_H
#define TALUS_LAWS_NORMAL_HOOKE_MATERIAL_H

#include "laws/normal/common.h"

namespace Talus {

struct HookeMaterial : LinearLaw {
  static constexpr const char *name = "hooke/material", *label = name;
  static constexpr const char *damping = "restitution";
  static constexpr bool needs_radius = true, reads_impact = true;
  static constexpr const char *takes_no_kt = "hooke/material takes kt = kn from the material";
  template <class Real> struct Row {
    Real young, speed;
  };
  static constexpr CoefficientName coefficients[] = {{"E_eff"}, {"vchar", Shown::NEVER}};

  static void read(LawReader &r)
  {
    read_material(r, Damping::ANY);
    r.spec.given["vchar"] = r.words.positive("characteristic speed vchar");
  }
  static Row<double> mix(const Mixing &m) { return {mixed_young(m), m.largest("vchar")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real speed = select(s.impact_speed > c.speed, s.impact_speed, c.speed);
    const Real scale = (16.0 / 15.0) * square_root(s.radius) * c.young;
    s.kn = scale * fifth_root(s.mass * speed * speed / scale);
    s.kt = s.tangent_n = s.tangent_t = s.kn;
    s.contact_radius = square_root(s.overlap * s.radius);
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
