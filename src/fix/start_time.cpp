/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "start_time.h"

#include "comm.h"
#include "error.h"

#include <cstring>

using namespace LAMMPS_NS;

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
  const int size = sizeof(state);
  if (comm->me == 0) {
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(state, sizeof(double), 2, fp);
  }
}

double StartTime::restart(const char *buf)
{
  double state[2];
  memcpy(state, buf, sizeof(state));
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
