// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Conduction in proportion to the contact radius a, as LAMMPS' pair granular has it (Vargas and
// McCarthy 2001, AIChE J. 47, 1052): the first body receives 2 conductivity a (T_2 - T_1).
// conductivity power/(length temperature).

#ifndef TALUS_LAWS_HEAT_RADIUS_H
#define TALUS_LAWS_HEAT_RADIUS_H

#include "laws/heat/common.h"

namespace Talus {

struct HeatRadius : Conduction {
  static constexpr const char *name = "radius", *label = "heat radius";

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    s.heat_flow = 2.0 * c.heat * radius_of_circle(c, s) * difference(s);
  }
};

}    // namespace Talus

#endif
