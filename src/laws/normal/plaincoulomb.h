// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Chrono's PlainCoulomb with coefficients: F_e = kn sqrt(overlap) overlap, no tangential spring but
// a friction of its own. Kept as it is, although kn has no consistent meaning for other radii.
// kn force/distance^(3/2).

#ifndef TALUS_LAWS_NORMAL_PLAINCOULOMB_H
#define TALUS_LAWS_NORMAL_PLAINCOULOMB_H

#include "laws/normal/common.h"

namespace Talus {

struct PlainCoulomb : HertzianLaw {
  static constexpr const char *name = "plaincoulomb", *label = name;
  static constexpr const char *damping = "plaincoulomb";
  static constexpr bool needs_radius = false;
  template <class Real> struct Row {
    Real kn;
  };
  static constexpr CoefficientName coefficients[] = {{"kn"}};

  static void read(LawReader &r)
  {
    read_numbers(r, Damping::OWN);
    r.spec.given["kn"] *= r.pressure_unit;
    r.set_not_negative("mu");
    r.spec.law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, "tanh"));
  }
  static Row<double> mix(const Mixing &m) { return {m.mean("kn")}; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.kn = c.kn * square_root(s.overlap);
    s.tangent_n = 1.5 * s.kn;
    s.kt = s.tangent_t = splat<Real>(0.0);
    s.contact_radius = square_root(s.overlap * s.radius);
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
