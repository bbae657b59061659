// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/snapshot/saved_clock.h"

#include "system/host/fix_list.h"
#include "system/host/private_members.h"

#include "compute.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

SavedClock::SavedClock(LAMMPS *lmp) :
    Pointers(lmp), step(update->ntimestep), step_of_time(update->atimestep), time(update->atime),
    dt(update->dt), lists_ago(neighbor->ago), lists_made(neighbor->lastcall),
    energies_of(update->eflag_global), virial_of(update->vflag_global),
    last_thermo(output->last_thermo),
    last_dump(output->last_dump, output->last_dump + output->ndump)
{
  if (const Pair *pair = force->pair) {
    pair_sums = {pair->eng_vdwl, pair->eng_coul};
    std::copy(pair->virial, pair->virial + 6, pair_sums.begin() + 2);
  }
}

void SavedClock::restore_time() const
{
  update->ntimestep = step;
  update->atime = time;
  update->atimestep = step_of_time;
  if (update->dt == dt) return;
  update->dt = dt;
  if (force->pair) force->pair->reset_dt();
  for (Fix *fix : fix_list(*modify)) fix->reset_dt();
}

void SavedClock::restore_plans() const
{
  neighbor->reset_timestep(step);    // of lists that are made when they are asked for
  neighbor->ago = lists_ago;
  neighbor->lastcall = lists_made;
  update->eflag_global = energies_of;
  update->vflag_global = virial_of;
  update->eflag_atom = update->vflag_atom = -1;
  if (Pair *pair = force->pair) {
    pair->eng_vdwl = pair_sums[0];
    pair->eng_coul = pair_sums[1];
    std::copy(pair_sums.begin() + 2, pair_sums.end(), pair->virial);
  }
  output->last_thermo = last_thermo;
  const std::size_t dumps = std::min<std::size_t>(last_dump.size(), output->ndump);
  std::copy_n(last_dump.begin(), dumps, output->last_dump);
  forget_computes();
  for (Fix *fix : fix_list(*modify)) let_average_again(*fix, step);
}

/* What they know may be of a step with the same number. */

void SavedClock::forget_computes() const
{
  for (Compute *compute : modify->get_compute_list()) {
    compute->invoked_flag = Compute::INVOKED_NONE;
    compute->invoked_scalar = compute->invoked_vector = compute->invoked_array =
        compute->invoked_peratom = compute->invoked_local = -1;
  }
}

}    // namespace Talus
