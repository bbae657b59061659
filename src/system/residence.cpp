// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where the particles are: in the records for the steps that StepsInRecords tells. They come back to
// the arrays of the host for every step with output, a fix of the host at its end or new neighbor
// lists, and at the end of a run, also of one that ends in an error.

#include "system/granular_system.h"

#include "system/fix_contact_store.h"

#include "atom.h"
#include "fix.h"
#include "modify.h"
#include "utils.h"

using namespace LAMMPS_NS;

namespace Talus {

ParticleState GranularSystem::particles()
{
  if (!contact_pipeline->holds_state()) return {atom->nlocal, view(), atom->type};
  return {atom->nlocal, view(), atom->type, &contact_pipeline->records(),
          contact_pipeline->particle_order().slot_of_atom.data()};
}

void GranularSystem::complete_step_of(SystemFix &fix)
{
  if (!contact_pipeline->holds_state()) fix.complete_step();
}

void GranularSystem::start_run(bool pairs_computed)
{
  proxies.forget_plan();
  moved_in_records = farthest.step = -1;    // reset_timestep may bring a step back
  record_steps.start_run(pairs_computed);
  large_bodies.start_run();
}

bool GranularSystem::begin_forces(bigint step, bool tallied)
{
  stays_in_records = record_steps.include(step, tallied);
  return !stays_in_records;
}

void GranularSystem::update_proxies(bool overlap)
{
  proxies.update(overlap, *contact_pipeline, stays_in_records, view().change);
}

/* ---------------------------------------------------------------------- */

void GranularSystem::begin_rebuild()
{
  leave_records(false);
  proxies.forget_plan();
}

bool GranularSystem::return_to_host()
{
  stays_in_records = false;
  if (!contact_pipeline->holds_state()) return false;
  const bool between_steps = !contact_pipeline->is_moving();
  leave_records(true);
  if (between_steps) complete_step();
  return true;
}

void GranularSystem::leave_records(bool with_forces)
{
  if (!contact_pipeline->holds_state()) return;
  const bool any = atom->nlocal > 0;
  contact_pipeline->complete_move();
  movers.leave_records();
  if (contact_pipeline->keeps_changes())
    contact_pipeline->write_changes(contact_store->all_changes());
  contact_pipeline->return_state(
      any ? atom->x[0] : nullptr, any ? atom->v[0] : nullptr, any ? atom->omega[0] : nullptr,
      any && with_forces ? atom->f[0] : nullptr, any && with_forces ? atom->torque[0] : nullptr);
}

/* Fix freeze of LAMMPS does not know of the records. */

void GranularSystem::complete_step()
{
  for (const bool integrating : {false, true})
    for (Fix *fix : modify->get_fix_list()) {
      auto *ours = SystemFix::of(fix);
      if (ours && ours->integrates() == integrating) ours->complete_step();
      if (!ours && !integrating && utils::strmatch(fix->style, "^freeze")) fix->post_force(0);
    }
}

}    // namespace Talus
