// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/box_speeds.h"

#include "system/host/fix_list.h"

#include "comm.h"
#include "domain.h"
#include "fix_deform.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

/* Of two rates that are found from lengths one step apart. */

bool is_same(double told, double found, double dt)
{
  constexpr double relative = 1.0e-6, rounding = 4.0 * std::numeric_limits<double>::epsilon();
  return std::abs(told - found) <= relative * std::abs(told) + rounding / dt;
}

}    // namespace

void BoxSpeeds::start()
{
  deform = nullptr;
  if (!lmp->domain->deform_vremap) return;
  for (const Fix *fix : fix_list(*lmp->modify)) {
    const auto *const one = dynamic_cast<const FixDeform *>(fix);
    if (one && one->remapflag == Domain::V_REMAP) deform = one;
  }
  before = lengths();
}

std::array<double, 3> BoxSpeeds::lengths() const
{
  const double *const length = lmp->domain->prd;
  return {length[0], length[1], length[2]};
}

void BoxSpeeds::correct()
{
  if (!deform) return;
  Domain &domain = *lmp->domain;
  const double dt = lmp->update->dt;
  const std::array<double, 3> now = lengths();
  for (int k = 0; k < 3; k++) {
    const double speed = (now[k] - before[k]) / (dt * deform->nevery),
                 strain = (now[k] / before[k] - 1.0) / dt, told = domain.h_rate[k];
    // by its value, not by the release of LAMMPS
    if (now[k] == before[k] || is_same(told, speed, dt) || !is_same(told, strain, dt)) continue;
    domain.h_rate[k] = speed;
    domain.h_ratelo[k] = -0.5 * speed;
    if (!told_user && lmp->comm->me == 0)
      utils::logmesg(lmp,
                     "Talus fix {} {}: this version of LAMMPS tells a rate of strain where "
                     "velocities at borders need the speed of the side (remap v); Talus takes the "
                     "speed\n",
                     deform->id, deform->style);
    told_user = true;
  }
  before = now;
}

}    // namespace Talus
