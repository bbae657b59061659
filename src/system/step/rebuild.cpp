// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From old neighbor lists to new ones. FixContactStore calls these at LAMMPS' hooks:
//
//   pre_exchange     look_at_contacts(), keep_history(), release_*()
//                    LAMMPS migrates particles, which carry their slots or their histories
//   post_neighbor    renumber_pairs()

#include "system/step/granular_system.h"

#include "base/state_exchange.h"
#include "system/contacts/fix_contact_store.h"
#include "system/shapes/shaped_particles.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "pair.h"
#include "timer.h"

#include <array>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace LAMMPS_NS;

namespace Talus {

void GranularSystem::keep_history(HistoryStore &to, HistoryStore::Scope scope, bool pairs_stay)
{
  if (!pairs_stay) contact_pipeline->release_records();
  contact_pipeline->keep_history(to, scope, pairs_stay);
  if (shaped) shaped->keep_histories();
}

/* Pairs and states stay until the next set-up. */

void GranularSystem::end_contacts_of_run()
{
  contact_pipeline->leave_records();
  run_contacts.end_run();
}

/* The timer of LAMMPS stands at the fixes; the work is that of neighbor lists. */

void GranularSystem::renumber_pairs()
{
  if (!pair->list)
    error->all(FLERR,
               "Pair style {}: 'run ... pre no' cannot follow a new pair style: leave 'pre no' out",
               style.name);
  prepare_laws();
  timer->stamp(Timer::MODIFY);
  contact_pipeline->release();
  const DirectExchange *direct = exchange_switch.direct();
  contact_pipeline->set_work(comm->nthreads, direct && direct->overlaps());
  try {
    if (given_pairs)
      contact_pipeline->set_lists(given_pairs, atom->type);
    else
      find_pairs();
    contact_pipeline->start_pairs(contact_store->histories());
    change_order_of_histories();
  } catch (const std::length_error &problem) {
    error->one(FLERR, "Pair style {}: {}: use more ranks", style.name, problem.what());
  } catch (const std::bad_alloc &) {
    error->one(FLERR,
               "Pair style {}: not enough memory for the pairs of {} particles and {} ghosts of a "
               "rank: use more machines",
               style.name, atom->nlocal, atom->nghost);
  }
  lists.are_new();
  gravity.find_weightless(*contact_pipeline);
  contact_store->pairs_are_numbered(contact_pipeline->particle_order());
  timer->stamp(Timer::NEIGH);
  contact_pipeline->set_own_masses(effective_masses.bodies_are_rigid() ? atom->rmass : nullptr);
  effective_masses.update();
  if (effective_masses.needed()) comm->forward_comm(pair);
}

void GranularSystem::find_pairs()
{
  const int nall = atom->nlocal + atom->nghost;
  const std::vector<std::int64_t> tags(atom->tag, atom->tag + nall);
  NeighborView found = neighbor_source.find(pair->list, contact_range.largest_pulloff_distance());
  if (shaped) found = without_shapes(found);
  contact_pipeline->set_pairs({atom->nlocal, contact_store->all_keys(), tags, atom->type}, found);
  neighbor_source.release();
}

/* What is made of all pairs, such as masses, depends on particles and lists alone. */

void GranularSystem::exchange_state(StateExchange &x)
{
  energies.exchange_state(x);
  if (x.restores()) {
    monitors.forget_step();
    if (contact_store && contact_pipeline->has_pairs())
      contact_pipeline->take_back_histories(contact_store->histories());
  }
  run_contacts.exchange_state(x);
}

/* Where a run goes on with the other order. */

void GranularSystem::change_order_of_histories()
{
  const int before = contact_store->order_of_histories(), now = movers.order();
  contact_store->set_order_of_histories(now);
  if (before == 0 || before == now) return;
  contact_pipeline->change_order(
      now, [this](int i, int j) -> const ContactLaw & { return pair_coeffs.law(i, j); });
  contact_store->keep_histories(contact_pipeline->law_table().history_records(), now);
}

/* What LAMMPS has found cannot be changed; shapes refuse it in init(). */

NeighborView GranularSystem::without_shapes(const NeighborView &all)
{
  if (!neighbor_source.reason_for_lammps_lists().empty()) return all;
  std::vector<std::array<int, 2>> pairs;
  const int *type = atom->type;
  const NeighborView rest = neighbor_source.take_out([&](int i, int j) {
    const bool with_shape = shaped->is_shaped(type[i]) || shaped->is_shaped(type[j]);
    if (with_shape) pairs.push_back({i, j});
    return with_shape;
  });
  shaped->set_pairs(pairs);
  return rest;
}

}    // namespace Talus
