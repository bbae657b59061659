// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// In proportion to effective mass and contact radius: a m gn, a m gt. gn, gt 1/(time distance).

#ifndef TALUS_LAWS_DAMPING_VISCOELASTIC_H
#define TALUS_LAWS_DAMPING_VISCOELASTIC_H

#include "laws/damping/common.h"

namespace Talus {

struct Viscoelastic : DampingByNumber {
  static constexpr const char *name = "viscoelastic";
  static constexpr bool needs_radius = true;    // for the contact radius of the normal law

  static void read(LawReader & /*r*/) {}
  static double damping_exponent(double /*elastic*/) { return 0.5; }

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real damping = s.contact_radius * s.mass;
    s.gn = damping * c.gn;
    s.gt = damping * c.gt;
    finish_normal_force(c.floor, s);
  }
};

}    // namespace Talus

#endif
