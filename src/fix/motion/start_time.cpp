/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/start_time.h"

#include "system/host/restart_data.h"

#include "comm.h"
#include "error.h"

#include <vector>

using namespace LAMMPS_NS;

static constexpr int restart_format = 2;

double StartTime::next_kick(double dt)
{
  time_of_kick = coming_kick(dt);
  if (half) time_behind = 0.5 * dt;
  return time_of_kick;
}

void StartTime::write_restart(FILE *fp, double half_way) const
{
  const double state[2] = {(half ? 1.0 : 0.0) + (half_way > 0.0 ? 2.0 : 0.0),
                           half ? time_behind : half_way};
  if (comm->me == 0) Talus::write_restart_data_of_fix(fp, restart_format, state, sizeof(state));
}

double StartTime::restart(const char *buf)
{
  const std::vector<double> state = Talus::restart_data_of_fix(lmp, command, restart_format, buf);
  const bool is_half_way = state[0] >= 2.0, was_half = state[0] - (is_half_way ? 2.0 : 0.0) > 0.0;

  if (was_half == half) {
    if (half) time_behind = state[1];
  } else if (comm->me == 0) {
    error->warning(FLERR, "{} start {}: the restart file was written with start {}: {}", command,
                   half ? "half" : "plain", was_half ? "half" : "plain",
                   was_half ? "velocities stay behind positions by half a time step"
                            : "velocities count as those of the present step");
  }
  return is_half_way ? state[1] : 0.0;
}
