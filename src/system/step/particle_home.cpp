// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where the particles of a step are: in the records, in the arrays of LAMMPS, or shown in these.

#include "system/step/step.h"

#include "system/contacts/fix_contact_store.h"
#include "system/host/fix_list.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "fix.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

using namespace LAMMPS_NS;

namespace Talus {

ParticleState Step::particles()
{
  if (!contacts().motion().holds_state()) return {atom->nlocal, view(), atom->type};
  return {atom->nlocal, view(), atom->type, &contacts().records(),
          contacts().particle_order().slot_of_atom.data()};
}

bool Step::others_look() const
{
  const FixCalls &calls = system.steps_in_records().fix_calls();
  return calls.somebody_looks() || calls.groups_may_ask();
}

ParticleView Step::view() const
{
  const bool any = atom->nlocal + atom->nghost > 0;
  return {any ? atom->x[0] : nullptr,
          any ? atom->v[0] : nullptr,
          any ? atom->omega[0] : nullptr,
          atom->radius,
          atom->rmass,
          system.masses().override_or_null(),
          any ? atom->f[0] : nullptr,
          any ? atom->torque[0] : nullptr,
          contacts().conducts_heat() ? atom->heatflow : nullptr,
          system.store() ? system.store()->all_changes() : nullptr};
}

void Step::complete_step_of(SystemFix &fix)
{
  if (!contacts().motion().holds_state()) fix.complete_step();
}

bool Step::return_to_arrays()
{
  stays_in_records = false;
  if (!contacts().motion().holds_state()) return false;
  const bool between_steps = !contacts().motion().is_moving();
  leave_records(true);
  if (between_steps) complete_step();
  return true;
}

void Step::begin_rebuild()
{
  leave_records(false);
  proxies.forget_plan();
}

void Step::leave_records(bool with_forces)
{
  if (!contacts().motion().holds_state()) return;
  contacts().motion().complete();
  parts.movers.leave_records();
  contacts().motion().return_state(view(), with_forces);
}

bool Step::begin_pair_styles()
{
  if (system.pair_style().is_alone()) return false;
  if (contacts().motion().holds_state()) {
    contacts().motion().complete();
    contacts().motion().show(view(), proxies.have_arrived_in_records(), false);
  }
  return stays_in_records;
}

void Step::end_pair_styles()
{
  contacts().motion().take_forces(view());
}

void Step::show_particles()
{
  contacts().motion().show(view(), true, true);
}

void Step::show(const std::vector<int> &some)
{
  if (contacts().motion().holds_state()) contacts().motion().copy_states(some, view());
}

/* With the states of ghosts, if they have come to the records: others go on there. */

void Step::leave_records_for_pairs()
{
  if (!contacts().motion().holds_state()) return;
  proxies.finish();
  contacts().motion().complete();
  parts.movers.leave_records();
  contacts().motion().show(view(), proxies.have_arrived_in_records(), false);
  contacts().motion().leave();
  proxies.forget_plan();
  brought = true;
}

/* Clumps know themselves whether their step is complete, and so do the spheres that they place; the
   others end it in the arrays alone. */

void Step::show_step()
{
  complete_step_where(true, true);
  show_particles();
  complete_step_where(false, false);
  complete_step_where(true, false);
  shown = update->ntimestep;
}

/* Where a run ends after a step that has been shown, clumps have completed it. */

void Step::complete_step()
{
  complete_step_where(false, false);
  complete_step_where(true, false);
  if (shown != update->ntimestep) complete_step_where(true, true);
}

/* Fix freeze of LAMMPS acts on its arrays only. */

void Step::complete_step_where(bool integrating, bool placing)
{
  for (Fix *fix : fix_list(*modify)) {
    auto *talus_fix = SystemFix::of(fix);
    if (!talus_fix && !integrating && utils::strmatch(fix->style, "^freeze")) fix->post_force(0);
    if (!talus_fix || talus_fix->integrates() != integrating) continue;
    if (talus_fix->places_particles() == placing) talus_fix->complete_step();
  }
}

}    // namespace Talus
