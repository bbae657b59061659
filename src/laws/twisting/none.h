// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// No spinning resistance.

#ifndef TALUS_LAWS_TWISTING_NONE_H
#define TALUS_LAWS_TWISTING_NONE_H

#include "laws/law_definition.h"

namespace Talus {

struct TwistingNone : TwistingLaw {
  static constexpr const char *name = "none", *label = nullptr;
  static constexpr bool acts = false;

  template <bool advance, class Real>
  static void compute(const Row<Real> & /*c*/, ContactLanes<Real> & /*s*/, Real * /*history*/,
                      double /*dt*/)
  {
  }
};

}    // namespace Talus

#endif
