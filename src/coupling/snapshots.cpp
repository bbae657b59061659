// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls that save the state of the simulation in memory and go back to it.

#include "coupling/calls.h"
#include "coupling/partner.h"

#include "system/snapshot/snapshot.h"

#include <memory>
#include <new>

struct talus_snapshot {
  Talus::Snapshot state;
};

namespace Talus {

/* A set-up that is due changes what comes next: it is made before. */

int call_save(talus_partner *partner, talus_snapshot **snapshot)
{
  return partner->collective("talus_save", [&] {
    partner->refuse_if(snapshot ? "" : "snapshot is NULL");
    partner->set_up_if_needed();
    LAMMPS_NS::LAMMPS *const lmp = &partner->instance();
    partner->refuse_if(Snapshot::reason_against(lmp, partner->system()));
    try {
      *snapshot = new talus_snapshot{Snapshot(lmp, partner->system())};
    } catch (const std::bad_alloc &) {
      throw Refusal("some rank has not enough memory for another snapshot: discard others, or use "
                    "more machines");
    }
  });
}

int call_restore(talus_partner *partner, const talus_snapshot *snapshot)
{
  return partner->collective("talus_restore", [&] {
    partner->refuse_if(snapshot ? snapshot->state.reason_against_restoring(partner->system())
                                : "snapshot is NULL");
    partner->set_up_if_lost();    // restoring calls fixes, which look at regions and exchange
    const bool due = partner->needs_set_up || !partner->system().setup_state().change().empty();
    snapshot->state.restore();
    partner->system().setup_state().record();
    partner->needs_set_up = due;
  });
}

int call_discard(talus_snapshot *snapshot)
{
  std::unique_ptr<talus_snapshot> owner(snapshot);
  return TALUS_OK;
}

int64_t call_snapshot_size(const talus_snapshot *snapshot)
{
  return snapshot ? static_cast<int64_t>(snapshot->state.memory_usage()) : 0;
}

}    // namespace Talus
