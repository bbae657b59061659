// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One step, as the run style makes it (the order is that of the Verlet loop of LAMMPS):
//
//   advance()             the integrator moves the particles
//   begin_forces()        may they be in the records after this step?
//   update_proxies()      messages leave; with overlap they are on their way during
//   compute_contacts()    forces between particles, and of bodies that join, in canonical order
//
// In the arrays of LAMMPS particles are moved at once, and proxies are those of LAMMPS. In the
// records steps are made that StepsInRecords tells. The particles come back to the arrays for every
// step with output, a fix of LAMMPS at its end or new neighbor lists, and at the end of a run, also
// of one that ends in an error.

#include "system/step/granular_system.h"

#include "system/contacts/fix_contact_store.h"
#include "system/host/fix_list.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/sphere_kicks.h"

#include "base/in_parallel.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <cmath>

using namespace LAMMPS_NS;

namespace Talus {

void GranularSystem::start_run(bool pairs_computed)
{
  proxies.forget_plan();
  largest_move.forget();    // reset_timestep may bring a step back
  shown = -1;
  record_steps.start_run(pairs_computed);
  large_bodies.start_run();
}

void GranularSystem::advance(const Fix *integrator, const RecordStep &step, int frozen_groups)
{
  if (!contact_pipeline->holds_state()) {
    const SystemFix &talus_fix = *SystemFix::of(integrator);
    ChangeRecord *const changes = talus_fix.keeps_changes() ? particles().changes() : nullptr;
    if (!talus_fix.places_particles())
      kick_spheres(lmp, integrator->igroup, step, frozen_groups, true, changes);
    return;
  }
  if (!movers.give(step)) return;
  if (!contact_pipeline->can_move()) {
    contact_pipeline->prepare_to_move([this](int i) { return movers.mover_of(i); }, proxies.sent());
  }
  gravity.begin_step(*contact_pipeline);
  contact_pipeline->advance(movers.steps());
  largest_move.moves_in_records();
}

bool GranularSystem::begin_forces(bigint step, bool tallied)
{
  stays_in_records = record_steps.include(step, tallied);
  return !stays_in_records;
}

void GranularSystem::update_proxies(bool overlap)
{
  proxies.update(overlap, *contact_pipeline, view(), stays_in_records);
}

void GranularSystem::compute_contacts(const std::function<void(const TalliedContact &)> *tally)
{
  if (!contact_pipeline->has_pairs() ||
      contact_pipeline->num_particles() != atom->nlocal + atom->nghost) {
    proxies.finish();
    renumber_pairs();    // as after `run pre no`
  }

  // a set-up is a step of no duration, or none
  const bool setting_up = update->setupflag != 0;
  const bool limits = style.limits_at_setup && !contact_pipeline->law_table().second_order();
  ContactStep step{setting_up && limits ? 0.0 : update->dt, !setting_up || limits, tally,
                   energies.begin_step(setting_up)};
  run_contacts.forget();
  const bool alone = pair_style_is_alone();
  const int order =
      contact_store->order_of_histories();    // that of the run, since pairs were numbered
  step.lag = order == 2 ? movers.lag() : 0.0;
  step.read = !contact_pipeline->holds_state();
  step.read_ghosts = !proxies.take_arrived_in_records();
  step.deliver = !stays_in_records;
  step.add_to_arrays = stays_in_records && !alone;
  find_changes(step, order);
  if (contact_pipeline->conducts_heat()) step.temperature = atom->temperature;

  gravity.begin_step(*contact_pipeline);
  const std::function<void(int, int, int)> add_bodies = [this](int thread, int begin, int end) {
    large_bodies.add_to_slots(thread, begin, end);
  };
  // contacts of shapes come before those of bodies, and after those of spheres; so do other pairs
  if (!shaped && alone && !step.read && !step.deliver && large_bodies.join_step())
    step.add_other_forces = &add_bodies;

  compute_around_proxies(step);
  if (step.deliver && contact_pipeline->keeps_changes())
    contact_store->store_velocities(movers.groups_with_changes());
  if (shaped) shaped->compute_contacts(step);
  contact_store->pairs_are_current();
  if (!setting_up) return;
  time_step.judge_start(pair_coeffs, *contact_pipeline);
  monitors.look(RunMonitor::Moment::SETUP);
}

bool GranularSystem::needs_changes(int order) const
{
  return order == 2 || energies.is_asked() || large_bodies.account();
}

/* In the arrays of LAMMPS, of particles that are moved by fixes that do not keep them. */

void GranularSystem::find_changes(ContactStep &step, int order)
{
  if (const bool needed = needs_changes(order); needed != contact_pipeline->keeps_changes()) {
    contact_pipeline->keep_changes(needed);
    contact_store->keep_changes(needed);
  }
  if (!contact_pipeline->keeps_changes()) return;
  const bool moved_in_arrays = step.read && !largest_move.was_in_records();
  if (moved_in_arrays && !update->setupflag)
    contact_store->follow_velocities(movers.groups_with_changes(), shaped.get());
  step.weight_of_changes = weight_of_changes(update->setupflag != 0);
  if (step.read_ghosts && step.weight_of_changes != 0.0F) comm->forward_comm(contact_store);
}

/* The same steps on all ranks, and after a restart. */

float GranularSystem::weight_of_changes(bool setting_up) const
{
  constexpr int every = 4;
  if (!contact_pipeline->keeps_changes()) return 0.0F;
  if (setting_up || contact_pipeline->law_table().second_order()) return 1.0F;
  return energies.is_asked() && update->ntimestep % every == 0 ? every : 0.0F;
}

/* In two phases pairs without proxies are computed while these are under way. */

void GranularSystem::compute_around_proxies(ContactStep &step)
{
  if (!contact_pipeline->in_two_phases()) {
    proxies.finish();
    contact_pipeline->compute(view(), step);
    return;
  }
  DirectExchange *direct = exchange_switch.direct();
  const std::function<void()> progress = [direct] { direct->progress(); };
  if (direct && direct->pending() && direct->may_progress_beside(comm->nthreads))
    step.progress = &progress;
  contact_pipeline->compute_early(view(), step);
  step.progress = nullptr;
  proxies.finish();
  contact_pipeline->compute_late(view(), step);
}

/* ----------------------------------------------------------------------
   where the particles are
------------------------------------------------------------------------- */

ParticleState GranularSystem::particles()
{
  if (!contact_pipeline->holds_state()) return {atom->nlocal, view(), atom->type};
  return {atom->nlocal, view(), atom->type, &contact_pipeline->records(),
          contact_pipeline->particle_order().slot_of_atom.data()};
}

ParticleView GranularSystem::view() const
{
  const bool any = atom->nlocal + atom->nghost > 0;
  return {any ? atom->x[0] : nullptr,
          any ? atom->v[0] : nullptr,
          any ? atom->omega[0] : nullptr,
          atom->radius,
          atom->rmass,
          effective_masses.override_or_null(),
          any ? atom->f[0] : nullptr,
          any ? atom->torque[0] : nullptr,
          contact_pipeline->conducts_heat() ? atom->heatflow : nullptr,
          contact_store ? contact_store->all_changes() : nullptr};
}

void GranularSystem::complete_step_of(SystemFix &fix)
{
  if (!contact_pipeline->holds_state()) fix.complete_step();
}

bool GranularSystem::return_to_arrays()
{
  stays_in_records = false;
  if (!contact_pipeline->holds_state()) return false;
  const bool between_steps = !contact_pipeline->is_moving();
  leave_records(true);
  if (between_steps) complete_step();
  return true;
}

void GranularSystem::begin_rebuild()
{
  leave_records(false);
  proxies.forget_plan();
}

void GranularSystem::leave_records(bool with_forces)
{
  if (!contact_pipeline->holds_state()) return;
  contact_pipeline->complete_move();
  movers.leave_records();
  contact_pipeline->return_state(view(), with_forces);
}

bool GranularSystem::begin_pair_styles()
{
  if (pair_style_is_alone()) return false;
  if (contact_pipeline->holds_state()) {
    contact_pipeline->complete_move();
    contact_pipeline->show(view(), proxies.have_arrived_in_records(), false);
  }
  return stays_in_records;
}

void GranularSystem::end_pair_styles()
{
  contact_pipeline->take_forces(view());
}

void GranularSystem::show_particles()
{
  contact_pipeline->show(view(), true, true);
}

/* Clumps know themselves whether their step is complete, and so do the spheres that they place; the
   others end it in the arrays alone. */

void GranularSystem::show_step()
{
  complete_step_where(true, true);
  show_particles();
  complete_step_where(false, false);
  complete_step_where(true, false);
  shown = update->ntimestep;
}

/* Where a run ends after a step that has been shown, clumps have completed it. */

void GranularSystem::complete_step()
{
  complete_step_where(false, false);
  complete_step_where(true, false);
  if (shown != update->ntimestep) complete_step_where(true, true);
}

/* Fix freeze of LAMMPS acts on its arrays only. */

void GranularSystem::complete_step_where(bool integrating, bool placing)
{
  for (Fix *fix : fix_list(*modify)) {
    auto *talus_fix = SystemFix::of(fix);
    if (!talus_fix && !integrating && utils::strmatch(fix->style, "^freeze")) fix->post_force(0);
    if (!talus_fix || talus_fix->integrates() != integrating) continue;
    if (talus_fix->places_particles() == placing) talus_fix->complete_step();
  }
}

}    // namespace Talus
