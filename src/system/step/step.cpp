// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/step.h"

#include "system/contacts/fix_contact_store.h"
#include "system/contacts/liquid_of_particles.h"
#include "system/exchange/direct_exchange.h"
#include "system/host/bonded_styles.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"
#include "system/step/sphere_kicks.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "force.h"
#include "pair.h"
#include "update.h"

#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

Step::Step(LAMMPS *lmp, GranularSystem &owner, const Parts &of_system) :
    Pointers(lmp), system(owner), parts(of_system), proxies(lmp, owner.exchange()),
    largest_move(lmp)
{
}

void Step::start_run(bool pairs_computed)
{
  proxies.forget_plan();
  largest_move.forget();    // reset_timestep may bring a step back
  shown = -1;
  system.steps_in_records().start_run(pairs_computed);
  system.bodies().start_run();
}

void Step::advance(const Fix *integrator, const RecordStep &step, int frozen_groups)
{
  if (!contacts().motion().holds_state()) {
    const SystemFix &talus_fix = *SystemFix::of(integrator);
    ChangeRecord *const changes = talus_fix.keeps_changes() ? particles().changes() : nullptr;
    if (!talus_fix.places_particles())
      kick_spheres(lmp, integrator->igroup, step, frozen_groups, true, changes);
    talus_fix.turn_particles();
    return;
  }
  if (!parts.movers.give(step)) return;
  if (!contacts().motion().is_prepared()) {
    contacts().motion().prepare(
        [this](int begin, int end, signed char *mover) {
          parts.movers.find_movers(begin, end, mover);
        },
        proxies.sent());
  }
  system.weights().begin_step(contacts());
  contacts().motion().advance(parts.movers.steps());
  largest_move.moves_in_records();
  parts.movers.turn_particles();
}

bool Step::begin_forces(bigint step, bool tallied)
{
  stays_in_records = system.steps_in_records().include(step, tallied);
  return !stays_in_records;
}

void Step::update_proxies(bool overlap)
{
  proxies.update(overlap, contacts(), view(), stays_in_records);
}

/* As after `run pre no`. */

void Step::make_pairs_known()
{
  if (contacts().has_pairs() && contacts().num_particles() == atom->nlocal + atom->nghost) return;
  proxies.finish();
  system.rebuild().renumber_pairs();
}

void Step::compute_contacts(const std::function<void(const TalliedContact &)> *tally,
                            VirialSums *virial)
{
  make_pairs_known();
  // a set-up is a step of no duration, or none
  const bool setting_up = update->setupflag != 0;
  const bool limits =
      system.pair_style().traits().limits_at_setup && !contacts().law_table().second_order();
  ContactStep step{setting_up && limits ? 0.0 : update->dt, !setting_up || limits, tally, virial,
                   system.account().begin_step(setting_up)};
  parts.for_outputs.forget();
  const bool alone = system.pair_style().is_alone();
  const int order =
      system.store()->order_of_histories();    // that of the run, since pairs were numbered
  step.lag = order == 2 ? parts.movers.lag() : 0.0;
  step.read = !contacts().motion().holds_state();
  const bool ghosts_in_arrays = !proxies.take_arrived_in_records();
  step.read_ghosts = std::exchange(brought, false) || ghosts_in_arrays;
  step.deliver = !stays_in_records;
  step.add_to_arrays = stays_in_records && !alone;
  find_changes(step, order, ghosts_in_arrays);
  if (contacts().conducts_heat()) step.temperature = atom->temperature;
  if (contacts().shares_liquid()) {    // changed by the last step
    comm->forward_comm(system.pair_style().get());
    step.liquid = liquid_of_particles(*atom);
  }

  system.weights().begin_step(contacts());
  const std::function<void(int, int, int)> add_bodies = [this](int thread, int begin, int end) {
    system.bodies().add_to_slots(thread, begin, end);
  };
  // contacts of shapes come before those of bodies, and after those of spheres; so do other pairs and bonds
  if (!system.shapes() && alone && !computes_bonds(*force) && !step.read && !step.deliver &&
      system.bodies().join_step())
    step.add_other_forces = &add_bodies;

  compute_around_proxies(step);
  if (step.deliver && contacts().motion().keeps_changes())
    system.store()->store_velocities(parts.movers.groups_with_changes());
  if (ShapedParticles *shapes = system.shapes()) shapes->compute_contacts(step);
  system.store()->pairs_are_current();
  if (!setting_up) return;
  parts.time_step.judge_start(system.laws(), contacts());
  system.run_monitor().look(RunMonitor::Moment::SETUP);
}

bool Step::needs_changes(int order) const
{
  return order == 2 || system.account().is_asked() || system.bodies().account();
}

/* In the arrays of LAMMPS, of particles that are moved by fixes that do not keep them. */

void Step::find_changes(ContactStep &step, int order, bool ghosts_in_arrays)
{
  if (const bool needed = needs_changes(order); needed != contacts().motion().keeps_changes()) {
    contacts().motion().keep_changes(needed);
    system.store()->keep_changes(needed);
  }
  if (!contacts().motion().keeps_changes()) return;
  const bool moved_in_arrays = step.read && !largest_move.was_in_records();
  if (moved_in_arrays && !update->setupflag)
    system.store()->follow_velocities(parts.movers.groups_with_changes(), system.shapes());
  step.weight_of_changes = weight_of_changes(update->setupflag != 0);
  if (ghosts_in_arrays && step.weight_of_changes != 0.0F) comm->forward_comm(system.store());
}

/* The same steps on all ranks, and after a restart. */

float Step::weight_of_changes(bool setting_up) const
{
  constexpr int every = 4;
  if (!contacts().motion().keeps_changes()) return 0.0F;
  if (setting_up || contacts().law_table().second_order()) return 1.0F;
  return system.account().is_asked() && update->ntimestep % every == 0 ? every : 0.0F;
}

/* In two phases pairs without proxies are computed while these are under way. */

void Step::compute_around_proxies(ContactStep &step)
{
  if (!contacts().in_two_phases()) {
    proxies.finish();
    contacts().compute(view(), step);
    return;
  }
  DirectExchange *direct = system.exchange().direct();
  const std::function<void()> progress = [direct] { direct->progress(); };
  if (direct && direct->pending() && direct->may_progress_beside(comm->nthreads))
    step.progress = &progress;
  contacts().compute_early(view(), step);
  step.progress = nullptr;
  proxies.finish();
  contacts().compute_late(view(), step);
}

}    // namespace Talus
