// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage heat.

#include "laws/heat/area.h"
#include "laws/heat/gas.h"
#include "laws/heat/radius.h"
#include "laws/law_definition.h"
#include "laws/none.h"
#include "laws/stage_lists.h"

namespace Talus {

std::vector<const Law *> heat_laws()
{
  return {
      &law<NoHeat>,
      &law<HeatRadius>,
      &law<HeatArea>,
      &law<HeatGas>,
  };
}

}    // namespace Talus
