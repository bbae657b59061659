// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/granular_system.h"

#include "base/state_exchange.h"
#include "system/contacts/fix_contact_store.h"
#include "system/host/system_style.h"
#include "system/shapes/shaped_particles.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <map>

using namespace LAMMPS_NS;

namespace Talus {

std::shared_ptr<GranularSystem> GranularSystem::of(LAMMPS *lmp)
{
  static std::map<const LAMMPS *, std::weak_ptr<GranularSystem>> systems;
  std::shared_ptr<GranularSystem> system = systems[lmp].lock();
  if (!system) {
    system.reset(new GranularSystem(lmp));
    systems[lmp] = system;
  }
  return system;
}

GranularSystem::GranularSystem(LAMMPS *lmp) :
    Pointers(lmp), attached(lmp), contact_memory(comm->me), store_of_memory(lmp),
    neighbor_source(lmp), effective_masses(lmp), contact_range(lmp, pair_coeffs), monitor(lmp),
    time_step(lmp), monitors(lmp), movers(lmp), energies(lmp, movers), run_contacts(lmp, *this),
    exchange_switch(lmp), gravity(lmp, *this), record_steps(lmp, *this, movers),
    neighbor_lists(lmp), state_at_setup(lmp, *this), loads_of_others(lmp, *this),
    step_of_run(lmp, *this, {contact_pipeline, movers, run_contacts, time_step}),
    rebuild_of_lists(lmp, *this, {contact_pipeline, neighbor_source, run_contacts}),
    large_bodies(lmp, *this)
{
  contact_pipeline.emplace();
}

GranularSystem::~GranularSystem() = default;

/* ---------------------------------------------------------------------- */

bool GranularSystem::attach(Pair *pair, const AttachedPair::Traits &traits)
{
  if (attached.is_there()) return false;
  attached.set(pair);
  attached.set_traits(traits);
  monitors.add(
      pair, {{0.5, [this] { return store() ? store()->find_no_number() : RunMonitor::Finding{}; },
              [this](const RunMonitor::Finding &found) {
                store()->report_no_number(found);
                return true;
              }}});
  monitors.add(pair, monitor.checks([this] { return run_contacts.deepest_since_rebuild(); }));
  monitors.add(pair, {time_step.check(pair_coeffs)});
  store_of_memory.keep_place();
  make_run_style_the_default(lmp);
  return true;
}

/* A second pair style has never been attached. */

void GranularSystem::detach(const Pair *pair)
{
  if (!pair || pair != attached.get()) return;
  monitors.remove(pair);
  attached.set(nullptr);
  if (store()) store()->forget_pairs();
  pair_coeffs = PairCoeffs{};
  prepared.reset();
  announced.clear();
  energies.clear();
  run_contacts.forget();
  contact_pipeline.emplace();
  if (!contact_memory.has_others()) store_of_memory.remove();
}

void GranularSystem::init_pair_style()
{
  run_contacts.keep();
  neighbor_source.init(attached.get());
  gravity.forget();
  effective_masses.find_fixes();
  contact_range.find(effective_masses.frozen_groups(), shaped.get());
  contact_range.require_sizes(attached.name());
  store_of_memory.require(std::string("Pair style ") + attached.name());
  store_of_memory.create();
  // well below the smallest particle of usual scenes: tags decide only where keys are equal
  const double largest = contact_range.radii().largest();
  store()->use_cells(largest > 0.0 ? 0.125 * largest : 1.0);
  monitors.start();
  time_step.start();
  prepared.reset();    // init_one() will mix what is not set
}

/* ---------------------------------------------------------------------- */

/* Once all pairs of types are known: at the first rebuild of a run, or the first question. */

void GranularSystem::prepare_laws()
{
  if (prepared == pair_coeffs.revision()) return;
  const LawTable table = pair_coeffs.table(movers.order());
  store()->keep_histories(table.history_records(), movers.order());
  contact_pipeline->set_laws(table);
  prepared = pair_coeffs.revision();

  const std::string description = "Talus " + attached.name() + ": " + pair_coeffs.describe(table);
  if (comm->me == 0 && description != announced) utils::logmesg(lmp, description);
  announced = description;
  const std::string problem = contact_pipeline->keeps_history() ? contact_range.small_period() : "";
  if (problem.empty()) return;
  if (!attached.traits().allows_small_period)
    error->all(FLERR, "Pair style {}: {}", attached.name(), problem);
  if (comm->me == 0) error->warning(FLERR, "Pair style {}: {}", attached.name(), problem);
}

/* What is made of all pairs, such as masses, depends on particles and lists alone. */

void GranularSystem::exchange_state(StateExchange &x)
{
  energies.exchange_state(x);
  if (x.restores()) {
    monitors.forget_step();
    if (store() && contact_pipeline->has_pairs())
      contact_pipeline->take_back_histories(contact_memory.pairs());
  }
  run_contacts.exchange_state(x);
}

const LawTable &GranularSystem::law_table()
{
  prepare_laws();
  return contact_pipeline->law_table();
}

std::string GranularSystem::reason_against_history()
{
  effective_masses.find_fixes();
  contact_range.find(effective_masses.frozen_groups(), shaped.get());
  return contact_range.small_period();
}

ShapedParticles &GranularSystem::define_shapes(Fix *command, ShapeTable table)
{
  shaped = std::make_unique<ShapedParticles>(lmp, *this, command, std::move(table));
  return *shaped;
}

void GranularSystem::drop_shapes()
{
  shaped.reset();
}

}    // namespace Talus
