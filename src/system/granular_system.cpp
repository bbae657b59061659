// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/granular_system.h"

#include "system/fix_contact_store.h"
#include "system/system_run_style.h"
#include "system/system_shapes.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <map>

using namespace LAMMPS_NS;

namespace Talus {

namespace {

// The same in every process: restart files find fixes by ID.
constexpr const char *store_id = "TALUS_CONTACTS";
// Keeps the place of the store in the list of fixes until the first run: only then read_restart has
// brought what it is to continue with.
constexpr const char *placeholder_id = "TALUS_CONTACTS_LATER";

}    // namespace

std::shared_ptr<GranularSystem> GranularSystem::of(LAMMPS *lmp)
{
  static std::map<const LAMMPS *, std::weak_ptr<GranularSystem>> systems;
  std::shared_ptr<GranularSystem> its = systems[lmp].lock();
  if (!its) {
    its.reset(new GranularSystem(lmp));
    systems[lmp] = its;
  }
  return its;
}

GranularSystem::GranularSystem(LAMMPS *lmp) :
    Pointers(lmp), large_bodies(lmp, *this), neighbors(lmp), masses(lmp), radii(lmp), monitor(lmp), time_step(lmp),
    monitors(lmp), movers(lmp), energies(lmp, movers), exchange_switch(lmp), report(lmp)
{
  pipeline.emplace();
}

GranularSystem::~GranularSystem() = default;

/* ---------------------------------------------------------------------- */

bool GranularSystem::attach(Pair *one, const StyleTraits &traits)
{
  if (pair) return false;
  pair = one;
  style = traits;
  monitors.add(pair,
               {{0.5, [this] { return store ? store->find_no_number() : RunMonitor::Finding{}; },
                 [this](const RunMonitor::Finding &found) {
                   store->say_no_number(found);
                   return true;
                 }}});
  monitors.add(pair, monitor.checks([this] { return deepest_contact(); }));
  monitors.add(pair, {time_step.check(book)});
  modify->add_fix(std::string(placeholder_id) + " all DUMMY");
  make_run_style_the_default(lmp);
  return true;
}

/* A second pair style has never been attached. */

void GranularSystem::detach(const Pair *one)
{
  if (!pair || one != pair) return;
  monitors.remove(pair);
  pair = nullptr;
  store = nullptr;
  book = LawBook{};
  laws_current = false;
  announced.clear();
  energies.clear();
  behind_run.reset();
  kept.reset();
  pipeline.emplace();
  for (const auto *internal : {store_id, placeholder_id})
    if (modify->get_fix_by_id(internal)) modify->delete_fix(internal);
}

bool GranularSystem::pair_style_is_alone() const
{
  return pair && force->pair == pair;
}

std::string GranularSystem::reason_of_pair_style() const
{
  if (accelerates_pairs()) return "";
  return has_pair_style() ? "the pair style is hybrid" : "the pair style is not accelerated";
}

void GranularSystem::init_pair_style()
{
  keep_contacts();
  neighbors.init(pair);
  gravity = nullptr;    // its init() comes later
  masses.find_fixes();
  radii.find(masses.frozen_groups(), shaped);
  require_sizes();
  create_store();
  monitors.start();
  time_step.start();
  laws_current = false;    // init_one() will mix what is not set
}

/* A radius far beyond the box makes ghosts or cells of neighbors without end. A frozen particle may
   touch its image: it does not move. */

void GranularSystem::require_sizes() const
{
  constexpr double far_beyond = 1.0e6;
  const double largest = radii.largest(),
               box = std::max({domain->prd[0], domain->prd[1], domain->prd[2]});
  if (!(largest <= far_beyond * box))
    error->all(
        FLERR,
        "Pair style {}: the largest particle has a radius of {:.4g}, {:.3g} times the longest "
        "side of the box: look for what has set it (set diameter, read_data, fix adapt, fix "
        "pour or deposit), in units of length",
        style.name, largest, largest / box);
  double free = 0.0;
  for (int type = 1; type <= atom->ntypes; type++) free = std::max(free, radii.of_free(type));
  for (int d = 0; d < 3; d++) {
    const bool matters = domain->periodicity[d] && !(domain->dimension == 2 && d == 2);
    if (!matters || domain->prd[d] >= 2.0 * free) continue;
    const std::string problem =
        fmt::format("the box is periodic in {} with a period of {:.4g}, and the largest particle "
                    "has a diameter "
                    "of {:.4g}: it touches its own image: make the box at least {:.4g} wide, or "
                    "use 'boundary f'",
                    std::string(1, "xyz"[d]), domain->prd[d], 2.0 * free, 4.0 * free);
    error->all(FLERR, "Pair style {}: {}", style.name, problem);
  }
}

/* Of the largest particles; the reach grows with both radii. */

double GranularSystem::reach(int i, int j) const
{
  return book.known(i, j) ? book.reach(i, j, radii.largest(i), radii.largest(j)) : 0.0;
}

double GranularSystem::cutoff(int i, int j) const
{
  return radii.cutoff(i, j) + reach(std::min(i, j), std::max(i, j));
}

double GranularSystem::largest_reach() const
{
  double largest = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) largest = std::max(largest, reach(i, j));
  return largest;
}

void GranularSystem::create_store()
{
  const char *expected = store ? store_id : placeholder_id;
  if (!modify->get_fix_by_id(expected))
    error->all(FLERR,
               "Pair style {}: its internal fix {} has been deleted: remove the unfix command",
               style.name, expected);
  if (store) return;
  // well below the smallest particle of usual scenes: tags decide only where keys are equal
  const double cell = radii.largest() > 0.0 ? 0.125 * radii.largest() : 1.0;
  const auto command = fmt::format("{} all CONTACT_STORE {:.17g}", store_id, cell);
  store = dynamic_cast<FixContactStore *>(modify->replace_fix(placeholder_id, command, 1));
  if (!store) error->all(FLERR, "Pair style {}: cannot create fix {}", style.name, store_id);
  store->serve(this);
}

/* ---------------------------------------------------------------------- */

const ContactSpec *GranularSystem::own_law(int type) const
{
  return type <= book.num_types() && book.is_set(type, type) ? &book.spec(type, type) : nullptr;
}

/* Once all pairs of types are known: at the first rebuild of a run, or the first question. */

void GranularSystem::prepare_laws()
{
  const LawTable table = book.table(movers.order());
  store->keep_impacts(table.has_impact());
  pipeline->set_laws(table);
  laws_current = true;

  const std::string description = "Talus " + style.name + ": " + book.describe(table);
  if (comm->me == 0 && description != announced) utils::logmesg(lmp, description);
  announced = description;
  const std::string problem = pipeline->keeps_history() ? small_period() : "";
  if (problem.empty()) return;
  if (!style.allows_small_period) error->all(FLERR, "Pair style {}: {}", style.name, problem);
  if (comm->me == 0) error->warning(FLERR, "Pair style {}: {}", style.name, problem);
}

const LawTable &GranularSystem::law_table()
{
  if (!laws_current) prepare_laws();
  return pipeline->law_table();
}

/* Histories are known by the IDs of the two particles, which two images of one of them share. */

std::string GranularSystem::small_period() const
{
  const double needed = 4.0 * radii.largest();
  for (int d = 0; d < 3; d++) {
    const bool matters = domain->periodicity[d] && !(domain->dimension == 2 && d == 2);
    if (matters && domain->prd[d] < needed)
      return fmt::format(
          "the box is periodic in {} with a period of {:.4g}, below two diameters of the largest "
          "particle: two particles could touch on both sides, and laws with history cannot tell "
          "these contacts apart: make the box at least {:.4g} wide, or use 'boundary f'",
          std::string(1, "xyz"[d]), domain->prd[d], needed);
  }
  return "";
}

std::string GranularSystem::reason_against_history()
{
  masses.find_fixes();
  radii.find(masses.frozen_groups(), shaped);
  return small_period();
}

std::string GranularSystem::take_gravity(SystemGravity *field)
{
  if (!accelerates_pairs()) return reason_of_pair_style();
  if (!pair->compute_flag) return "'pair_modify compute no' is set";
  if (masses.unit() != 1.0) return "the unit of force is not that of mass times acceleration";
  if (neighbor->includegroup || atom->firstgroupname)
    return "neighbor lists or particles are restricted to a group";
  if (gravity && gravity != field) return "another fix gravity comes before it";
  gravity = field;
  return "";
}

bool GranularSystem::take_shapes(SystemShapes *its)
{
  if (shaped) return false;
  shaped = its;
  return true;
}

void GranularSystem::drop_shapes(const SystemShapes *its)
{
  if (shaped == its) shaped = nullptr;
}

void GranularSystem::drop_gravity(const SystemGravity *field)
{
  if (gravity == field) gravity = nullptr;
}

}    // namespace Talus
