// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage cohesion.

#include "laws/cohesion/constant.h"
#include "laws/cohesion/dmt.h"
#include "laws/cohesion/none.h"
#include "laws/cohesion/perko.h"
#include "laws/law_definition.h"
#include "laws/stage_lists.h"

namespace Talus {

std::vector<const Law *> cohesion_laws()
{
  return {
      &law<CohesionNone>,
      &law<ConstantAdhesion>,
      &law<DmtAdhesion>,
      &law<PerkoAdhesion>,
  };
}

}    // namespace Talus
