// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/run_contacts.h"

#include "base/state_digest.h"
#include "base/state_exchange.h"
#include "system/contacts/fix_contact_store.h"
#include "system/host/fix_list.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

void RunContacts::for_each(ContactData requested, const VisitContact &visit) const
{
  const bool after_a_run = system.pair_style().is_there() && update->whichflag == 0;
  std::vector<ContactReport> of_kept;
  if (after_a_run) require_those_of_last_run(known_after_run(of_kept));
  if (after_a_run && kept)
    for (const ContactReport &one : of_kept) visit(one);
  else
    visit_all(requested, visit);
}

void RunContacts::visit_all(ContactData requested, const VisitContact &visit) const
{
  if (system.pipeline().num_particles() == atom->nlocal + atom->nghost)
    ContactSurvey(system.pipeline()).for_each_contact(requested, visit);
  if (const ShapedParticles *shapes = system.shapes())
    shapes->pairs().for_each_contact(system.pipeline().law_table(), visit);
  int number = 0;
  for (const auto &fix : fix_list(*modify)) {
    const auto *talus_fix = SystemFix::of(static_cast<const Fix *>(fix));
    if (!talus_fix || !talus_fix->is_touched()) continue;
    talus_fix->for_each_contact([&](ContactReport one) {
      one.body = number;
      visit(one);
    });
    number++;
  }
}

/* A contact with a ghost is known twice: the owner of the particle with the lower ID has it. */

bool RunContacts::is_of_this_rank(const ContactReport &one) const
{
  if (one.j < 0 || (one.i < atom->nlocal && one.j < atom->nlocal)) return true;
  const auto [owned, ghost] =
      one.i < atom->nlocal ? std::pair(one.i, one.j) : std::pair(one.j, one.i);
  return atom->tag[owned] <= atom->tag[ghost];
}

/* After a run indices of particles may have changed. */

bool RunContacts::are_known() const
{
  return update->whichflag != 0 ? system.pipeline().has_pairs() : kept || digest_after_run;
}

/* Between runs particles may be sorted, sent to other ranks or deleted, which may change all IDs. -1: gone. */

int RunContacts::present_index(const KeptContact &one, int end) const
{
  const int last = end == 0 ? one.contact.i : one.contact.j;
  const auto tag = static_cast<tagint>(one.tag[end]);
  if (last < atom->nlocal + atom->nghost && atom->tag[last] == tag) return last;
  const bool is_in_map = atom->map_style != Atom::MAP_NONE && tag <= atom->map_tag_max;
  return is_in_map ? atom->map(tag) : -1;
}

bool RunContacts::find_kept(std::vector<ContactReport> &all) const
{
  if (atom->natoms != kept_of) return false;
  for (const KeptContact &one : *kept) {
    ContactReport now = one.contact;
    now.i = present_index(one, 0);
    const bool with_particle = now.j >= 0;
    if (with_particle) now.j = present_index(one, 1);
    if (now.i < 0 || (with_particle && now.j < 0)) return false;
    if (with_particle && now.j != one.contact.j) now.j = domain->closest_image(now.i, now.j);
    all.push_back(now);
  }
  return true;
}

/* By the local indices of particles, and the order of bodies. */

std::uint64_t RunContacts::digest_of_owners() const
{
  StateDigest digest;
  const int all = atom->nlocal + atom->nghost;
  digest.add(static_cast<std::uint64_t>(atom->nlocal));
  for (int i = 0; i < all; i++) digest.add(static_cast<std::uint64_t>(atom->tag[i]));
  for (const auto &fix : fix_list(*modify)) {
    const auto *talus_fix = SystemFix::of(fix);
    if (!talus_fix || !talus_fix->is_touched()) continue;
    for (const char *c = fix->id; *c; c++) digest.add(static_cast<std::uint64_t>(*c));
    digest.add(std::uint64_t{0});
  }
  return digest.value();
}

/* Pairs and states stay until the next set-up. */

void RunContacts::end_run()
{
  digest_after_run.reset();
  if (system.account().has_observers()) digest_after_run = digest_of_owners();
}

/* What bodies and walls know may be of particles that are gone. */

RunContacts::Known RunContacts::known_after_run(std::vector<ContactReport> &of_kept) const
{
  if (kept) return find_kept(of_kept) ? Known::ALL : Known::OLD;
  if (!digest_after_run) return Known::NONE;
  return *digest_after_run == digest_of_owners() ? Known::ALL : Known::OLD;
}

/* Ranks may know more or less, and what one says alone may be lost when the others are aborted. */

void RunContacts::require_those_of_last_run(Known here) const
{
  const int mine = static_cast<int>(here);
  int least = 0;
  MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, world);
  if (least == static_cast<int>(Known::NONE))
    error->all(FLERR,
               "Pair style {}: contacts are known from the first run after the command that asks "
               "for them: use 'run 0' before",
               system.pair_style().name());
  if (least == static_cast<int>(Known::OLD))
    error->all(FLERR,
               "Pair style {}: contacts of the last run cannot be listed, for particles or bodies "
               "have been added, deleted or sent to other ranks since, as by displace_atoms and "
               "change_box: use 'run 0' before",
               system.pair_style().name());
}

/* Commands that send particles to other ranks, such as write_restart, initialize LAMMPS first: the
   last moment at which contacts of the last run can be found. */

void RunContacts::keep()
{
  if (update->whichflag != 0 || kept || !digest_after_run) return;
  if (*digest_after_run != digest_of_owners()) return;    // those who ask will be told
  std::vector<KeptContact> all;
  visit_all(ContactData::ALL, [&](const ContactReport &one) {
    all.push_back({one, {atom->tag[one.i], one.j < 0 ? 0 : atom->tag[one.j]}});
  });
  kept = std::move(all);
  kept_of = atom->natoms;
}

/* Those of now, where they were those of the state then. */

void RunContacts::exchange_state(StateExchange &x)
{
  bool known =
      !x.restores() && !kept && digest_after_run && *digest_after_run == digest_of_owners();
  x(known);
  if (x.restores()) forget();
  if (!known) return;
  system.exchange_contacts(x);
  if (x.restores()) digest_after_run = digest_of_owners();
}

void RunContacts::forget()
{
  digest_after_run.reset();
  kept.reset();
}

double RunContacts::count() const
{
  const ShapedParticles *shapes = system.shapes();
  return ContactSurvey(system.pipeline()).count_contacts() +
         (shapes ? shapes->pairs().count().contacts : 0.0);
}

double RunContacts::count_candidates() const
{
  const ShapedParticles *shapes = system.shapes();
  return ContactSurvey(system.pipeline()).count_candidates() +
         (shapes ? shapes->pairs().count().pairs : 0.0);
}

DeepestContact RunContacts::deepest() const
{
  const ShapedParticles *shapes = system.shapes();
  const DeepestContact spheres = ContactSurvey(system.pipeline()).deepest_contact();
  return shapes ? std::max(spheres, shapes->deepest_contact()) : spheres;
}

DeepestContact RunContacts::deepest_since_rebuild() const
{
  const ShapedParticles *shapes = system.shapes();
  const DeepestContact spheres = ContactSurvey(system.pipeline()).deepest_since_rebuild();
  return shapes ? std::max(spheres, shapes->pairs().deepest_since_set()) : spheres;
}

/* Between two runs histories are with the store. */

std::optional<HistoryValues> RunContacts::history_of(int i, int j) const
{
  if (update->whichflag != 0) return ContactSurvey(system.pipeline()).history_of(i, j);
  const FoundHistory found = system.memory().pairs().find_of_atoms(i, j);
  if (!found.known) return std::nullopt;
  return found.seen_by_a();
}

}    // namespace Talus
