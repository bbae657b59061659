// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Hertzian contact with coefficients (stock `gran/hertz/history`, Silbert et al. 2001): with the
// contact radius a = sqrt(R overlap), F_e = a kn overlap, tangential stiffness a kt; with damping a
// m gn. kn, kt pressure.

#ifndef TALUS_LAWS_NORMAL_HERTZ_H
#define TALUS_LAWS_NORMAL_HERTZ_H

#include "laws/normal/common.h"

namespace Talus {

struct Hertz : SpringsByNumber<HertzianLaw> {
  static constexpr const char *name = "hertz", *label = name;
  static constexpr const char *damping = "viscoelastic";
  static constexpr bool like_stock = true;

  static void read(LawReader &r)
  {
    read_numbers(r, Damping::ANY);
    r.spec.given["kn"] *= r.pressure_unit;
  }
  static double modulus(const Row<double> &c) { return 0.75 * c.kn; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.contact_radius = square_root(s.overlap * s.radius);
    s.kn = s.contact_radius * c.kn;
    s.kt = s.tangent_t = s.contact_radius * c.kt;
    s.tangent_n = 1.5 * s.kn;
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
