// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Answers of GranularSystem for outputs, computes and the exchange.

#include "system/granular_system.h"

#include "system/fix_contact_store.h"
#include "system/private_member.h"

#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
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

int GranularSystem::order() const
{
  int highest = 1;
  for (const auto &fix : modify->get_fix_list())
    if (const auto *ours = dynamic_cast<const SystemFix *>(fix))
      highest = std::max(highest, ours->order());
  return highest;
}

double GranularSystem::lag() const
{
  for (const auto &fix : modify->get_fix_list()) {
    const auto *ours = dynamic_cast<const SystemFix *>(fix);
    if (ours && ours->order() == 2) return ours->lag();
  }
  return 0.0;
}

double *GranularSystem::velocity_changes()
{
  return store ? store->all_changes() : nullptr;
}

std::string GranularSystem::reason_against_second_order() const
{
  if (!pair_style_is_alone() || style.name != "gran/penalty")
    return "contacts of particles are not those of 'pair_style gran/penalty': use it, alone";
  for (int i = 1; i <= book.num_types(); i++)
    for (int j = i; j <= book.num_types(); j++) {
      if (!book.known(i, j)) continue;
      const std::string its = book.reason_against_second_order(i, j);
      if (!its.empty()) return fmt::format("the contact of types {} and {} {}", i, j, its);
    }
  for (LargeBody *body : bodies()) {
    const std::string its = body->reason_against_second_order();
    if (!its.empty()) return body->name() + " " + its;
  }
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

void GranularSystem::keep_account()
{
  keeps_account = true;
}

void GranularSystem::velocities_have_moved()
{
  if (account.waits_for_move())
    pipeline->account_for_move(atom->v[0], atom->omega[0], update->dt, account);
}

}    // namespace Talus
