// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Frictionless: no tangential force, no torque.

#ifndef TALUS_LAWS_TANGENTIAL_NONE_H
#define TALUS_LAWS_TANGENTIAL_NONE_H

#include "laws/law_definition.h"

namespace Talus {

struct TangentialNone : TangentialLaw {
  static constexpr const char *name = "none", *label = name;
  static constexpr bool acts = false;

  static void read(LawReader & /*r*/) {}
  static const Law *order_2(bool adhesive);

  template <bool advance, class Real>
  TALUS_INLINE static void compute(const Row<Real> & /*c*/, ContactLanes<Real> &s,
                                   Real * /*history*/, double /*dt*/)
  {
    const Real zero = splat<Real>(0.0);
    s.tangential = s.torque_per_radius = {zero, zero, zero};
  }
};

}    // namespace Talus

#endif
