// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From the run-time description of a law (ContactLaw) to the type that implements it (Model): the
// one list of all combinations that exist.

#ifndef TALUS_LAWS_MODEL_DISPATCH_H
#define TALUS_LAWS_MODEL_DISPATCH_H

#include "laws/contact_law.h"
#include "laws/contact_model.h"

namespace Talus {

template <class Normal, class Tangential, Resistance resistance, class Visitor>
auto dispatch_adhesion(ContactLaw law, Visitor visitor)
{
  if (law.adheres) return visitor(Model<Normal, Tangential, resistance, true>{});
  return visitor(Model<Normal, Tangential, resistance, false>{});
}

template <class Normal, class Tangential, class Visitor>
auto dispatch_resistance(ContactLaw law, Visitor visitor)
{
  if (!law.resists) return dispatch_adhesion<Normal, Tangential, Resistance::NONE>(law, visitor);
  if (law.delayed) return dispatch_adhesion<Normal, Tangential, Resistance::DELAYED>(law, visitor);
  return dispatch_adhesion<Normal, Tangential, Resistance::AT_ONCE>(law, visitor);
}

template <class Normal, class Visitor> auto dispatch_tangential(ContactLaw law, Visitor visitor)
{
  switch (law.tangential) {
  case TangentialLaw::DASHPOT:
    return dispatch_resistance<Normal, TangentialDashpot>(law, visitor);
  case TangentialLaw::ONESTEP:
    return dispatch_resistance<Normal, TangentialOnestep>(law, visitor);
  case TangentialLaw::MULTISTEP:
    return dispatch_resistance<Normal, TangentialMultistep<false, false>>(law, visitor);
  case TangentialLaw::MIDPOINT:
    return dispatch_resistance<Normal, TangentialMultistep<true, false>>(law, visitor);
  case TangentialLaw::SLIDER:
    return dispatch_resistance<Normal, TangentialMultistep<false, true>>(law, visitor);
  case TangentialLaw::SLIDER_MIDPOINT:
    return dispatch_resistance<Normal, TangentialMultistep<true, true>>(law, visitor);
  default:
    return dispatch_resistance<Normal, TangentialNone>(law, visitor);
  }
}

/// Returns visitor(Model{}) with the type that stands for the law.
template <class Visitor> auto dispatch_model(ContactLaw law, Visitor visitor)
{
  switch (law.normal) {
  case NormalLaw::HERTZ:
    return dispatch_tangential<NormalHertz>(law, visitor);
  case NormalLaw::FLORES:
    return dispatch_tangential<NormalFlores>(law, visitor);
  case NormalLaw::HOOKE_MATERIAL:
    return dispatch_tangential<NormalHookeMaterial>(law, visitor);
  case NormalLaw::HERTZ_MATERIAL:
    return dispatch_tangential<NormalHertzMaterial>(law, visitor);
  case NormalLaw::FLORES_MATERIAL:
    return dispatch_tangential<NormalFloresMaterial>(law, visitor);
  case NormalLaw::PLAINCOULOMB:
    return dispatch_resistance<NormalPlainCoulomb, TangentialTanh>(law, visitor);
  case NormalLaw::PLAINCOULOMB_MATERIAL:
    return dispatch_resistance<NormalPlainCoulombMaterial, TangentialTanh>(law, visitor);
  default:
    return dispatch_tangential<NormalHooke>(law, visitor);
  }
}

}    // namespace Talus

#endif
