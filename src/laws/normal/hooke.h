// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Linear spring (Cundall and Strack 1979; stock `gran/hooke*`): F_e = kn overlap; with mass
// damping. kn, kt force/distance.

#ifndef TALUS_LAWS_NORMAL_HOOKE_H
#define TALUS_LAWS_NORMAL_HOOKE_H

#include "laws/normal/common.h"

namespace Talus {

struct Hooke : SpringsByNumber<LinearLaw> {
  static constexpr const char *name = "hooke", *label = name;
  static constexpr bool like_stock = true;

  static void read(LawReader &r) { read_numbers(r, Damping::ANY); }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.kn = s.tangent_n = c.kn;
    s.kt = s.tangent_t = c.kt;
    s.contact_radius = square_root(s.overlap * s.radius);
    s.elastic = s.kn * s.overlap;
  }
};

}    // namespace Talus

#endif
