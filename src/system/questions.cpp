// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Answers of GranularSystem for outputs, computes and the exchange.

#include "system/granular_system.h"

#include "system/fix_contact_store.h"

#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace Talus {

/* Between two runs histories are with the store. */

TangentialHistory<double> GranularSystem::history_of(int i, int j, ContactImpact<double> &impact)
{
  if (pipeline->has_pairs()) {
    impact = pipeline->impact_of(i, j);
    return pipeline->history_of(i, j);
  }
  const FiledHistories filed = store->histories();
  if (filed.kept.empty()) return {};
  const KeptContacts::Found found =
      filed.kept.find(filed.slot_then(i, i < atom->nlocal), filed.slot_then(j, j < atom->nlocal));
  if (!found.known) return {};
  const Record h = found.by_a ? *found.record : mirrored(*found.record);
  const auto &o = found.impact->c;
  impact = {o[0], o[1], o[2]};
  return {{h.c[0], h.c[1], h.c[2]}, h.c[3]};
}

bool GranularSystem::reads_proxy_omega() const
{
  return !laws_current || pipeline->keeps_spins() || pipeline->law_table().has_resistance();
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
