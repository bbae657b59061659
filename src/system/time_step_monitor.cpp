// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/time_step_monitor.h"

#include "comm.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int everyone = 1;    // the bit of the group all

}    // namespace

void TimeStepMonitor::judge_start(const LawBook &laws, const ContactPipeline &contacts)
{
  critical.compute(laws, contacts, everyone);
  said = false;
  judge();
  if (comm->me == 0 && critical.smallest() > 0.0) {
    const double fraction = update->dt / critical.smallest();
    critical.undamped.warn(fraction);
    critical.elastic.warn(fraction);
  }
  critical.compute_from_sizes(laws, everyone);
  limit_at_start = critical.smallest();
}

/* Particles that were added or changed during the run. */

void TimeStepMonitor::look_for_smaller_particles(const LawBook &laws)
{
  if (said) return;
  critical.compute_from_sizes(laws, everyone);
  const double limit = critical.smallest();
  const bool smaller = limit_at_start > 0.0 ? limit < limit_at_start : limit > 0.0;
  if (smaller) judge();
}

void TimeStepMonitor::judge()
{
  const double limit = critical.smallest();
  if (!(limit > 0.0) || update->dt <= advised * limit) return;
  said = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "Pair style gran/penalty: the time step is {:.3g} of the critical one ({:.4g}; "
                   "contact {:.4g}, Rayleigh {:.4g}, Hertz {:.4g}): at most {} of it is advised",
                   update->dt / limit, limit, critical.contact, critical.rayleigh, critical.hertz,
                   advised);
}
