// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What laws of heat conduction have in common: one coefficient, of unlike types the geometric mean.

#ifndef TALUS_LAWS_HEAT_COMMON_H
#define TALUS_LAWS_HEAT_COMMON_H

#include "laws/law_definition.h"

namespace Talus {

template <class Real> struct ConductionRow {
  Real heat;
};

struct Conduction : HeatLaw {
  template <class Real> using Row = ConductionRow<Real>;
  static constexpr CoefficientName coefficients[] = {{"heat"}};

  static void read(LawReader &r) { r.set_not_negative("heat"); }
  static ConductionRow<double> mix(const Mixing &m) { return {m.geometric("heat")}; }
};

}    // namespace Talus

#endif
