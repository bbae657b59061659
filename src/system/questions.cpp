// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Answers of GranularSystem for outputs, computes and the exchange.

#include "system/granular_system.h"

#include "system/fix_contact_store.h"
#include "system/private_member.h"

#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "force.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

struct ProxiesOfGroup {
  using Type = int Comm::*;
  friend Type pointer_to(ProxiesOfGroup);
};
template struct PrivateMember<ProxiesOfGroup, &Comm::bordergroup>;

std::string GranularSystem::unsupported_settings() const
{
  if (force->bond && force->bond->partial_flag)
    return "bonds may break, whose particles then touch with the same neighbor lists";
  if (comm->*pointer_to(ProxiesOfGroup{})) return "'comm_modify group' leaves out proxies";
  return "";
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
  if (pipeline->has_pairs()) return pipeline->remembered_of(i, j);
  const FoundHistory found = store->histories().find_of_atoms(i, j);
  if (!found.known) return std::nullopt;
  return remembered_values(found.seen_by_a(), *found.impact);
}

double GranularSystem::share_without_proxies() const
{
  return pipeline->in_two_phases() ? pipeline->early_share() : 0.0;
}

void GranularSystem::drop_observer(const ContactObserver *one)
{
  observers.erase(std::remove(observers.begin(), observers.end(), one), observers.end());
}

bool GranularSystem::accounts_for_work() const
{
  return std::any_of(observers.begin(), observers.end(),
                     [](const ContactObserver *one) { return one->asks_for_work(); });
}

std::vector<double **> GranularSystem::work_lists() const
{
  std::vector<double **> lists;
  for (ContactObserver *one : observers)
    if (double **rows = one->work_by_particle()) lists.push_back(rows);
  return lists;
}

void GranularSystem::for_each_contact(Ask ask, const ContactPipeline::VisitContact &visit)
{
  if (kept) {
    for (const SurveyedContact &one : *kept)
      if (std::max(one.i, one.j) < atom->nlocal + atom->nghost) visit(one);
    return;
  }
  if (pipeline->num_particles() == atom->nlocal + atom->nghost)
    pipeline->for_each_contact(update->dt, ask, visit);
  int number = 0;
  for (const auto &body : large_bodies) {
    body->for_each_contact(ask, [&](SurveyedContact one) {
      one.body = number;
      visit(one);
    });
    number++;
  }
}

/* Memory is given back behind a run, and particles may be deleted. */

void GranularSystem::remember_contacts()
{
  pipeline->remember_contacts();
  if (observers.empty() || kept) return;
  std::vector<SurveyedContact> all;
  for_each_contact(Ask::ALL, [&](const SurveyedContact &one) { all.push_back(one); });
  kept = std::move(all);
}

}    // namespace Talus
