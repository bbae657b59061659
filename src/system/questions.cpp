// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Answers of GranularSystem for outputs, computes and the exchange.

#include "system/granular_system.h"

#include "base/state_digest.h"
#include "system/fix_contact_store.h"
#include "system/private_members.h"
#include "system/system_shapes.h"

#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

std::string GranularSystem::unsupported_settings() const
{
  if (force->bond && force->bond->partial_flag)
    return "bonds may break, whose particles then touch with the same neighbor lists";
  if (sends_one_group(*comm)) return "'comm_modify group' leaves out proxies";
  return "";
}

ChangeRecord *GranularSystem::velocity_changes()
{
  return store ? store->all_changes() : nullptr;
}

bool GranularSystem::needs_changes() const
{
  return movers.order() == 2 || energies.is_asked() || large_bodies.account();
}

HistoryStore &GranularSystem::histories()
{
  return store->histories();
}

bool GranularSystem::histories_were_read() const
{
  return store->restart_reset != 0;
}

/* Between two runs histories are with the store. */

std::optional<RememberedValues> GranularSystem::remembered_of(int i, int j)
{
  if (update->whichflag != 0) return pipeline->remembered_of(i, j);
  const FoundHistory found = store->histories().find_of_atoms(i, j);
  if (!found.known) return std::nullopt;
  return remembered_values(found.seen_by_a(), *found.impact);
}

double GranularSystem::count_contacts() const
{
  return pipeline->count_contacts() + (shaped ? shaped->count_contacts() : 0.0);
}

double GranularSystem::count_candidates() const
{
  return pipeline->count_candidates() + (shaped ? shaped->count_candidates() : 0.0);
}

DeepestContact GranularSystem::deepest_contact() const
{
  const DeepestContact spheres = pipeline->deepest_contact();
  return shaped ? std::max(spheres, shaped->deepest_contact()) : spheres;
}

double GranularSystem::share_without_proxies() const
{
  return pipeline->in_two_phases() ? pipeline->early_share() : 0.0;
}

static constexpr const char *kept_are_old =
    "Pair style {}: contacts of the last run cannot be "
    "listed, for particles or bodies have been added, deleted, "
    "changed or sent to other ranks since: use 'run 0' before";

void GranularSystem::for_each_contact(Ask ask, const ContactPipeline::VisitContact &visit)
{
  if (pair && update->whichflag == 0) {
    if (kept) {
      if (atom->natoms != kept_of) error->all(FLERR, kept_are_old, style.name);
      for (const KeptContact &one : *kept) visit(at_present(one));
      return;
    }
    require_contacts_of_last_run();
  }
  visit_contacts(ask, visit);
}

void GranularSystem::visit_contacts(Ask ask, const ContactPipeline::VisitContact &visit)
{
  if (pipeline->num_particles() == atom->nlocal + atom->nghost)
    pipeline->for_each_contact(update->dt, movers.lag(), ask, visit);
  if (shaped) shaped->for_each_contact_of_pairs(ask, visit);
  int number = 0;
  for (const auto &fix : modify->get_fix_list()) {
    auto *ours = SystemFix::of(fix);
    if (!ours || !ours->is_touched()) continue;
    ours->for_each_contact(ask, [&](SurveyedContact one) {
      one.body = number;
      visit(one);
    });
    number++;
  }
}

/* A contact with a ghost is known twice: the owner of the particle with the lower ID has it. */

bool GranularSystem::is_of_this_rank(const SurveyedContact &one) const
{
  if (one.j < 0 || (one.i < atom->nlocal && one.j < atom->nlocal)) return true;
  const auto [owned, ghost] =
      one.i < atom->nlocal ? std::pair(one.i, one.j) : std::pair(one.j, one.i);
  return atom->tag[owned] <= atom->tag[ghost];
}

/* Behind a run indices of particles may have changed. */

bool GranularSystem::knows_contacts() const
{
  return update->whichflag != 0 ? pipeline->has_pairs() : kept || behind_run;
}

/* Between runs particles may be sorted, sent to other ranks or deleted, which may change all IDs. */

int GranularSystem::present_index(const KeptContact &one, int end) const
{
  const int last = end == 0 ? one.contact.i : one.contact.j;
  const auto tag = static_cast<tagint>(one.tag[end]);
  if (last < atom->nlocal + atom->nghost && atom->tag[last] == tag) return last;
  const int found = atom->map_style != Atom::MAP_NONE ? atom->map(tag) : -1;
  if (found < 0) error->one(FLERR, kept_are_old, style.name);
  return found;
}

SurveyedContact GranularSystem::at_present(const KeptContact &one) const
{
  SurveyedContact now = one.contact;
  now.i = present_index(one, 0);
  if (now.j < 0) return now;
  now.j = present_index(one, 1);
  if (now.j != one.contact.j) now.j = domain->closest_image(now.i, now.j);
  return now;
}

/* As far as contacts of the last step depend on it. */

std::uint64_t GranularSystem::digest_of_state() const
{
  StateDigest digest;
  digest.add(static_cast<std::uint64_t>(update->ntimestep));
  digest.add(update->dt);
  const int owned = atom->nlocal, all = owned + atom->nghost;
  for (int i = 0; i < all; i++) digest.add(static_cast<std::uint64_t>(atom->tag[i]));
  for (int i = 0; i < owned; i++) digest.add(static_cast<std::uint64_t>(atom->type[i]));
  for (const double *values : {atom->radius, atom->rmass}) digest.add(values, owned);
  if (owned)
    for (double **rows : {atom->x, atom->v, atom->omega}) digest.add(rows[0], 3L * owned);
  for (const auto &fix : modify->get_fix_list())
    if (const auto *ours = SystemFix::of(fix)) {
      digest.add(static_cast<std::uint64_t>(ours->is_touched()));
      ours->add_to(digest);
    }
  return digest.value();
}

/* Pairs and states stay until the next set-up, and contacts are found when somebody asks. */

void GranularSystem::end_contacts_of_run()
{
  behind_run.reset();
  if (energies.has_observers()) behind_run = digest_of_state();
}

/* What bodies and walls know may be of particles that are gone. */

void GranularSystem::require_contacts_of_last_run() const
{
  if (!behind_run)
    error->all(FLERR,
               "Pair style {}: contacts are known from the first run after the command that asks "
               "for them: use 'run 0' before",
               style.name);
  if (*behind_run != digest_of_state()) error->one(FLERR, kept_are_old, style.name);
}

/* Commands that send particles to other ranks, such as write_restart, initialize LAMMPS first: the
   last moment at which contacts of the last run can be found. */

void GranularSystem::keep_contacts()
{
  if (update->whichflag != 0 || kept || !behind_run) return;
  if (*behind_run != digest_of_state()) return;    // those who ask will be told
  std::vector<KeptContact> all;
  visit_contacts(Ask::ALL, [&](const SurveyedContact &one) {
    all.push_back({one, {atom->tag[one.i], one.j < 0 ? 0 : atom->tag[one.j]}});
  });
  kept = std::move(all);
  kept_of = atom->natoms;
}

}    // namespace Talus
