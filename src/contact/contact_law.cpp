// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_law.h"

namespace Talus {

const char *name_of(NormalLaw law)
{
  return law == NormalLaw::HOOKE ? "hooke" : "hertz";
}

const char *name_of(TangentialLaw law)
{
  switch (law) {
    case TangentialLaw::DASHPOT: return "dashpot";
    case TangentialLaw::ONESTEP: return "onestep";
    case TangentialLaw::MULTISTEP: return "multistep";
    default: return "none";
  }
}

}    // namespace Talus
