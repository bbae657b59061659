// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Conduction in proportion to the area of contact, as LAMMPS' pair granular has it: with the
// contact radius a the first body receives h pi a^2 (T_2 - T_1). h power/(length^2 temperature).

#ifndef TALUS_LAWS_HEAT_AREA_H
#define TALUS_LAWS_HEAT_AREA_H

#include "laws/heat/common.h"

namespace Talus {

struct HeatArea : Conduction {
  static constexpr const char *name = "area", *label = "heat area";

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> &c, ContactLanes<Real> &s, Real * /*history*/,
                                   double /*dt*/)
  {
    const Real a = radius_of_circle(c, s);
    s.heat_flow = (3.14159265358979323846 * c.heat) * a * a * difference(s);
  }
};

}    // namespace Talus

#endif
