// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage rolling.

#include "laws/law_definition.h"
#include "laws/none.h"
#include "laws/rolling/cdt.h"
#include "laws/rolling/delayed.h"
#include "laws/rolling/epsd2.h"
#include "laws/rolling/holding.h"
#include "laws/rolling/holding_order_2.h"
#include "laws/rolling/sds.h"
#include "laws/rolling/sds_order_2.h"
#include "laws/stage_lists.h"

namespace Talus {

const Law *HoldingRolling::order_2(bool /*adhesive*/)
{
  return &law<HoldingOrder2>;
}

const Law *SdsRolling::order_2(bool /*adhesive*/)
{
  return &law<SdsOrder2>;
}

const Law *CdtRolling::capped()
{
  return &law<CappedCdt>;
}

std::vector<const Law *> rolling_laws()
{
  return {
      &law<NoRolling>,       &law<HoldingRolling>, &law<DelayedRolling>, &law<SdsRolling>,
      &law<SynchronizedSds>, &law<CdtRolling>,     &law<CappedCdt>,      &law<Epsd2Rolling>,
  };
}

}    // namespace Talus
