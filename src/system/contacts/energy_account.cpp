// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/energy_account.h"

#include "base/in_parallel.h"
#include "system/step/integrators.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {

void EnergyAccount::drop_observer(const ContactObserver *one)
{
  observers.erase(std::remove(observers.begin(), observers.end(), one), observers.end());
}

bool EnergyAccount::is_asked() const
{
  return std::any_of(observers.begin(), observers.end(),
                     [](const ContactObserver *one) { return one->asks_for_work(); });
}

/* The step before has been taken; or its forces are found again. */

WorkAccount *EnergyAccount::begin_step(bool again)
{
  if (!again) settled += of_step.sum;
  of_step = {time_at_setup(), EnergyByCause{}, {}};
  for (ContactObserver *one : observers)
    if (double **rows = one->work_by_particle()) of_step.by_particle.push_back(rows);
  for (double **rows : of_step.by_particle)
    in_ranges(atom->nlocal, comm->nthreads, [rows, again](int, int begin, int end) {
      for (int i = begin; i < end; i++) begin_work(rows[i], again);
    });
  return is_asked() ? &of_step : nullptr;
}

WorkAccount EnergyAccount::part_of_step() const
{
  return {time_at_setup(), EnergyByCause{}, of_step.by_particle};
}

/* See WorkAccount. */

double EnergyAccount::time_at_setup() const
{
  return update->setupflag == 0 ? -1.0 : integrators.next_kick();
}

double EnergyAccount::counted_of_last_step() const
{
  return integrators.kicks().after;
}

}    // namespace Talus
