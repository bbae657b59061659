// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A stage at which nothing acts.

#ifndef TALUS_LAWS_NONE_H
#define TALUS_LAWS_NONE_H

#include "laws/law_definition.h"

namespace Talus {

/// Of cohesion, rolling, twisting or heat (the base of their laws in law_definition.h); damping and tangential laws find
/// numbers that others read, and have their own.
template <class Base> struct NoLaw : Base {
  static constexpr const char *name = "none", *label = nullptr;
  static constexpr bool acts = false, needs_radius = false;

  template <bool advance, class Real>
  static void compute(const typename Base::template Row<Real> & /*c*/, ContactLanes<Real> & /*s*/,
                      Real * /*history*/, double /*dt*/)
  {
  }
};

using NoCohesion = NoLaw<CohesionLaw>;
using NoRolling = NoLaw<RollingLaw>;
using NoTwisting = NoLaw<TwistingLaw>;
using NoHeat = NoLaw<HeatLaw>;

}    // namespace Talus

#endif
