// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Derjaguin, Muller and Toporov (1975, J. Colloid Interface Sci. 53, 314), as LAMMPS' pair granular
// has it: with a = sqrt(R overlap), F_e = 4/3 E_eff a overlap - 4 pi gamma R.

#ifndef TALUS_LAWS_NORMAL_DMT_H
#define TALUS_LAWS_NORMAL_DMT_H

#include "laws/normal/adhesive.h"

namespace Talus {

struct Dmt : AdhesiveLaw {
  static constexpr const char *name = "dmt", *label = name;

  static double stored(const ContactLanes<double> &s, const Row<double> &c,
                       const double * /*history*/)
  {
    return (0.4 * s.kn * s.overlap - pulloff_force(4.0, c.gamma, s)) * s.overlap;
  }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.contact_radius = square_root(s.overlap * s.radius);
    s.kn = (4.0 / 3.0) * c.young * s.contact_radius;
    s.tangent_n = 1.5 * s.kn;
    s.kt = s.tangent_t = splat<Real>(0.0);
    s.pulloff_force = pulloff_force(4.0, c.gamma, s);
    s.elastic = s.kn * s.overlap - s.pulloff_force;
  }
};

}    // namespace Talus

#endif
