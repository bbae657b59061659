// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/rebuild.h"

#include "system/contacts/fix_contact_store.h"
#include "system/exchange/direct_exchange.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

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

void Rebuild::keep_history(HistoryStore::Scope scope, bool pairs_stay)
{
  if (!pairs_stay) contacts().release_records();
  contacts().keep_history(system.memory().pairs(), scope, pairs_stay);
}

/* Pairs and states stay until the next set-up. */

void Rebuild::end_contacts_of_run()
{
  contacts().motion().leave();
  parts.for_outputs.end_run();
}

/* The timer of LAMMPS stands at the fixes; the work is that of neighbor lists. */

void Rebuild::renumber_pairs()
{
  if (!system.pair_style().get()->list)
    error->all(FLERR,
               "Pair style {}: 'run ... pre no' cannot follow a new pair style: leave 'pre no' out",
               system.pair_style().name());
  system.law_table();
  timer->stamp(Timer::MODIFY);
  // the lists have changed, and nothing else: every contact goes on, on each side of a border as it is there
  const bool unmoved =
      contacts().has_pairs() && contacts().num_particles() == atom->nlocal + atom->nghost;
  HistoryStore &histories = system.memory().pairs();
  if (unmoved) contacts().keep_history(histories, {false, false}, false);
  contacts().release();
  const DirectExchange *direct = system.exchange().direct();
  contacts().set_work(comm->nthreads, direct && direct->overlaps());
  try {
    make_pairs();
    if (unmoved) contacts().take_back_histories(histories);
  } catch (const std::length_error &problem) {
    error->one(FLERR, "Pair style {}: {}: use more ranks", system.pair_style().name(),
               problem.what());
  } catch (const std::bad_alloc &) {
    error->one(FLERR,
               "Pair style {}: not enough memory for the pairs of {} particles and {} ghosts of a "
               "rank: use more machines",
               system.pair_style().name(), atom->nlocal, atom->nghost);
  }
  system.lists().are_new();
  system.weights().find_weightless(contacts());
  system.store()->pairs_are_numbered(contacts().particle_order());
  timer->stamp(Timer::NEIGH);
  contacts().set_own_masses(system.masses().bodies_are_rigid() ? atom->rmass : nullptr);
  if (unmoved) return;
  system.masses().update();
  if (system.masses().needed()) comm->forward_comm(system.pair_style().get());
}

void Rebuild::make_pairs()
{
  if (given_pairs)
    contacts().set_lists(given_pairs, atom->type);
  else
    find_pairs();
  contacts().start_pairs(system.memory().pairs());
  change_order_of_histories();
}

void Rebuild::find_pairs()
{
  const int nall = atom->nlocal + atom->nghost;
  const std::vector<std::int64_t> tags(atom->tag, atom->tag + nall);
  NeighborView found = parts.neighbors.find(system.pair_style().get()->list,
                                            system.range().largest_pulloff_distance());
  if (system.shapes()) found = without_shapes(found);
  contacts().set_pairs({atom->nlocal, system.store()->all_keys(), tags, atom->type}, found);
  parts.neighbors.release();
}

/* Where a run goes on with the other order. */

void Rebuild::change_order_of_histories()
{
  const int before = system.store()->order_of_histories(), now = system.integrators().order();
  system.store()->set_order_of_histories(now);
  if (before == 0 || before == now) return;
  contacts().change_order(
      now, [this](int i, int j) -> const ContactLaw & { return system.laws().law(i, j); });
  system.store()->keep_histories(contacts().law_table().history_records(), now);
}

/* What LAMMPS has found cannot be changed; shapes refuse it in init(). */

NeighborView Rebuild::without_shapes(const NeighborView &all)
{
  if (!parts.neighbors.reason_for_lammps_lists().empty()) return all;
  std::vector<std::array<int, 2>> pairs;
  const int *type = atom->type;
  const NeighborView rest = parts.neighbors.take_out([&](int i, int j) {
    const bool with_shape =
        system.shapes()->is_shaped(type[i]) || system.shapes()->is_shaped(type[j]);
    if (with_shape) pairs.push_back({i, j});
    return with_shape;
  });
  system.shapes()->set_pairs(pairs);
  return rest;
}

}    // namespace Talus
