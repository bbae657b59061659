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

TangentialHistory<double> GranularSystem::history_of(int i, int j, ContactImpact<double> &impact)
{
  if (pipeline->has_pairs()) {
    impact = pipeline->impact_of(i, j);
    return pipeline->history_of(i, j);
  }
  const FoundHistory found = store->histories().find_of_atoms(i, j);
  if (!found.known) return {};
  const Record h = found.seen_by_a();
  const auto &o = found.impact->c;
  impact = {o[0], o[1], o[2]};
  return {{h.c[0], h.c[1], h.c[2]}, h.c[3]};
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
