// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// No heat is conducted.

#ifndef TALUS_LAWS_HEAT_NONE_H
#define TALUS_LAWS_HEAT_NONE_H

#include "laws/law_definition.h"

namespace Talus {

struct HeatNone : HeatLaw {
  static constexpr const char *name = "none", *label = nullptr;
  static constexpr bool acts = false, needs_radius = false;

  template <bool advance, class Real>
  static void compute(const Row<Real> & /*c*/, ContactLanes<Real> & /*s*/, Real * /*history*/,
                      double /*dt*/)
  {
  }
};

}    // namespace Talus

#endif
