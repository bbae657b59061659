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

 protected:
  /// T_2 - T_1, but 0 of a contact of second order that has just ended.
  template <class Real> TALUS_INLINE static Real difference(const ContactLanes<Real> &s)
  {
    const Real zero = splat<Real>(0.0);
    return select(s.separated > zero, zero, s.temperature_difference);
  }
};

}    // namespace Talus

#endif
