// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One step, as the run style makes it (the order is that of the Verlet loop of LAMMPS):
//
//   advance()             the integrator moves the particles
//   choose_residence()    may they be in the records after this step?
//   update_proxies()      messages leave; with overlap they are on their way during
//   compute_contacts()    forces between particles, and of bodies that join, in canonical order
//
// In the arrays of the host the integrator moves them itself, and proxies are those of the host.

#include "system/granular_system.h"

#include "system/fix_contact_store.h"

#include "atom.h"
#include "comm.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace Talus {

void GranularSystem::advance(const RecordStep &step, int group_bits)
{
  if (!pipeline->can_move()) {
    double **then = neighbor->dist_check ? neighbor->get_xhold() : nullptr;
    const int *mask = atom->mask;
    pipeline->prepare_to_move([=](int i) { return (mask[i] & group_bits) != 0; }, sent,
                              then && atom->nlocal ? then[0] : nullptr);
  }
  pipeline->advance(step);
}

void GranularSystem::compute_contacts(const std::function<void(const ReportedContact &)> *report)
{
  if (!pipeline->has_pairs() || pipeline->num_particles() != atom->nlocal + atom->nghost) {
    finish_proxies();
    renumber_pairs();    // as after `run pre no`
  }

  // a set-up is a step of no duration, or none
  const bool setting_up = update->setupflag != 0;
  ContactStep step{setting_up && style.limits_at_setup ? 0.0 : update->dt,
                   !setting_up || style.limits_at_setup, report,
                   keeps_account ? &account : nullptr};
  step.read = residence() == Residence::HOST;
  step.read_ghosts = !proxies_are_in_records;
  step.deliver = next_residence == Residence::HOST;
  proxies_are_in_records = false;

  const std::size_t joined = bodies_that_join();
  const std::function<void(int, int, int)> add_bodies = [&](int thread, int begin, int end) {
    for (std::size_t n = 0; n < joined; n++) bodies_of_run[n]->add_to_slots(thread, begin, end);
  };
  if (joined) step.add_more = &add_bodies;

  compute_around_proxies(step);
  if (step.deliver && !step.read && atom->nlocal)
    pipeline->write_state(atom->x[0], atom->v[0], atom->omega[0]);
  store->pairs_are_current();
  if (!setting_up) return;
  time_step.judge_start(book, *pipeline);
  monitors.look(RunMonitor::Moment::SETUP);
}

/* In two phases pairs without proxies are computed while these are under way. */

void GranularSystem::compute_around_proxies(ContactStep &step)
{
  if (!pipeline->in_two_phases()) {
    finish_proxies();
    pipeline->compute(view(), step);
    return;
  }
  ProxyUpdates *proxies = proxy_updates();
  const std::function<void()> progress = [proxies] { proxies->progress(); };
  if (proxies && proxies->pending() && proxies->may_progress_beside(comm->nthreads))
    step.meanwhile = &progress;
  pipeline->compute_early(view(), step);
  step.meanwhile = nullptr;
  finish_proxies();
  pipeline->compute_late(view(), step);
}

/* What was done before counts as pair time, the rest as communication. */

void GranularSystem::finish_proxies()
{
  ProxyUpdates *proxies = proxy_updates();
  if (!proxies || !proxies->pending()) return;
  timer->stamp(Timer::PAIR);
  proxies->finish();
  timer->stamp(Timer::COMM);
}

/* Bodies add their forces in the records if the particles are there before and after the step; those
   behind one that does not join act on their own, so that the order of sums stays that of the
   fixes. */

std::size_t GranularSystem::bodies_that_join()
{
  if (next_residence == Residence::HOST || residence() == Residence::HOST) return 0;
  std::size_t joined = 0;
  while (joined < bodies_of_run.size() && bodies_of_run[joined]->join_step()) joined++;
  return joined;
}

ParticleView GranularSystem::view() const
{
  const bool any = atom->nlocal + atom->nghost > 0;
  return {any ? atom->x[0] : nullptr,
          any ? atom->v[0] : nullptr,
          any ? atom->omega[0] : nullptr,
          atom->radius,
          atom->rmass,
          masses.override_or_null(),
          any ? atom->f[0] : nullptr,
          any ? atom->torque[0] : nullptr};
}

}    // namespace Talus
