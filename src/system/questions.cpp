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
