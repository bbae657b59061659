// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "run/overlap_hazards.h"

#include "system/host/fix_list.h"
#include "system/step/granular_system.h"

#include "fix.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "pair.h"
#include "timer.h"

#include <cstring>

using namespace LAMMPS_NS;
using Talus::GranularSystem;

namespace {

// Between the start of the exchange and the pair style the loop calls nothing but fixes before
// forces. Fix OMP only sets up threads there.
bool may_read_proxies(const Fix *fix)
{
  return std::strcmp(fix->style, "OMP") != 0;
}

}    // namespace

std::string Talus::hazard_of_overlap(LAMMPS *lmp, bool pairs_computed)
{
  const auto system = GranularSystem::of(lmp);
  if (!lmp->force->pair) return "there is no pair style";
  if (!system->pair_style().is_alone())
    return std::string("pair style ") + lmp->force->pair_style +
           " does not wait for proxies: only one of Talus on its own does";
  if (!pairs_computed) return "'pair_modify compute no' is set";
  if (!system->exchange().direct())
    return "the exchange is the one of LAMMPS: " + system->exchange().reason_for_stock();
  if (system->law_table().shares_liquid())
    return "bridges have the liquid of particles, which is sent before forces are computed";
  for (Fix *fix : Talus::fix_list(*lmp->modify)) {
    if ((lmp->modify->get_fix_mask(fix) & FixConst::PRE_FORCE) && may_read_proxies(fix))
      return std::string("fix ") + fix->id + " (" + fix->style +
             ") may read proxies before forces are computed";
  }
  if (lmp->timer->has_sync()) return "'timer sync' lets all ranks wait for each other";
  return "";
}
