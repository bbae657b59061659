// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/steps_in_records.h"

#include "system/contacts/fix_contact_store.h"
#include "system/host/bonded_styles.h"
#include "system/host/fix_list.h"
#include "system/host/system_style.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "integrate.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace Talus {

/* Fix freeze and OMP change nothing that a step in the records needs. */

bool acts_within_steps(const Fix *fix, int mask)
{
  if (std::strcmp(fix->style, "OMP") == 0 || utils::strmatch(fix->style, "^freeze")) return false;
  constexpr int in_every_step =
      INITIAL_INTEGRATE | POST_INTEGRATE | PRE_FORCE | PRE_REVERSE | POST_FORCE | FINAL_INTEGRATE;
  return (mask & in_every_step) != 0;
}

/* What set-up has found out may have changed the report. */

void StepsInRecords::start_run(bool pairs_computed)
{
  reason = find_reason_against(pairs_computed);
  calls.start_run();
  styles.print(system, reason);
}

void StepsInRecords::report(bool pairs_computed)
{
  // laws tell what the fixes are asked; they are known since init(), if there are particles to be
  if (system.pair_style().reason_against().empty()) static_cast<void>(system.law_table());
  styles.print(system, find_reason_against(pairs_computed));
}

bool StepsInRecords::include(bigint step, bool tallied) const
{
  return reason.empty() && !tallied && !is_looked_at(step);
}

bool StepsInRecords::is_looked_at(bigint step) const
{
  if (step >= update->laststep || step >= output->next) return true;
  return std::any_of(at_end_of_step.begin(), at_end_of_step.end(),
                     [step](const Fix *fix) { return step % fix->nevery == 0; });
}

/* ---------------------------------------------------------------------- */

std::string StepsInRecords::reason_of_scene(bool pairs_computed) const
{
  const std::string of_pair_style = system.pair_style().reason_against();
  if (!of_pair_style.empty()) return of_pair_style;
  if (!pairs_computed) return "'pair_modify compute no' is set";
  if (!SystemStyle::of(update->integrate))
    return std::string("run style ") + update->integrate_style;
  if (system.masses().unit() != 1.0)
    return "the unit of force is not that of mass times acceleration";
  if (has_bonded_forces(*force) || force->kspace) return "there are bonds or long-range forces";
  if (const SystemStyle *const bonds = SystemStyle::of(force->bond))
    if (std::string of_bonds = bonds->needs_arrays(); !of_bonds.empty())
      return "bonds: " + of_bonds;
  if (atom->avec->size_forward != 3)
    return std::string("radii or more vary with atom style ") + atom->atom_style;
  if (!system.pair_style().is_alone() && !system.law_table().has_friction())
    return "the pair style is hybrid, and contacts have no torques";
  // proxies in the records have changes of velocities that contain those of the borders, and their rounding
  if (integrators.order() == 2 && domain->deform_vremap)
    return "contacts of order 2 look at changes of velocities, which borders shift ('remap v')";
  if (neighbor->includegroup || atom->firstgroupname)
    return "neighbor lists or particles are restricted to a group";
  const bool periodic = domain->xperiodic || domain->yperiodic || domain->zperiodic;
  if ((comm->nprocs > 1 || periodic) && !system.exchange().direct())
    return "the exchange is the one of LAMMPS: " + system.exchange().reason_for_stock();
  return "";
}

/* A fix of LAMMPS that is called in every step may read or change anything, unless it is known. */

std::string StepsInRecords::find_reason_against(bool pairs_computed)
{
  const std::string of_scene = reason_of_scene(pairs_computed);
  if (!of_scene.empty()) return of_scene;
  at_end_of_step.clear();
  integrators.start_run();
  for (Fix *fix : fix_list(*modify)) {
    const int mask = modify->get_fix_mask(fix);
    auto *talus_fix = SystemFix::of(fix);
    const std::string reason = talus_fix                      ? talus_fix->needs_arrays()
                               : acts_within_steps(fix, mask) ? calls.reason_against(fix)
                                                              : "";
    if (!reason.empty()) return std::string("fix ") + fix->id + " (" + fix->style + "): " + reason;
    if ((mask & END_OF_STEP) == 0 || fix == system.store() || FixCalls::only_reads(fix) ||
        calls.only_moves(fix))
      continue;
    if (fix->nevery <= 1)
      return std::string("fix ") + fix->id + " (" + fix->style +
             "): may change particles at the end of every step: a larger Nevery";
    at_end_of_step.push_back(fix);
  }
  return integrators.reason_against_records(system.shapes() ? system.shapes()->command() : nullptr);
}

}    // namespace Talus
