// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage twisting.

#include "laws/law_definition.h"
#include "laws/none.h"
#include "laws/stage_lists.h"
#include "laws/twisting/delayed.h"
#include "laws/twisting/marshall.h"
#include "laws/twisting/sds.h"
#include "laws/twisting/stopping.h"
#include "laws/twisting/stopping_order_2.h"

namespace Talus {

const Law *StoppingTwist::order_2(bool /*adhesive*/)
{
  return &law<StoppingOrder2>;
}

std::vector<const Law *> twisting_laws()
{
  return {
      &law<NoTwisting>,    &law<StoppingTwist>, &law<DelayedTwist>,
      &law<MarshallTwist>, &law<SdsTwist>,
  };
}

}    // namespace Talus
