/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_START_TIME_H
#define LMP_START_TIME_H

#include "pointers.h"

#include <cstdio>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   To which time the velocities of an integrator with one kick in each step belong: the words
   `start plain` and `start half`.

   Plain: every kick is dt. Half: velocities are behind positions by lag(), which is 0 before the
   first step and then dt/2; a kick is lag + dt/2, from the time of v to half way between the times
   of x. Restart files keep both, and whether velocities of spheres of clumps are those half way
   through the last step, which they are with `order 2` until a step with another order has been made:
   { 1 half + 2 half way; lag, or of plain how far behind the half way is }.
------------------------------------------------------------------------- */

class StartTime : protected Pointers {
 public:
  // `command`: for messages, with the first letter in capitals
  StartTime(class LAMMPS *lmp, const char *command) : Pointers(lmp), command(command) {}

  void set_half(bool yes) { half = yes; }
  bool is_half() const { return half; }
  double lag() const { return time_behind; }
  // of a fix that begins beside others whose velocities are behind already
  void set_lag(double time) { time_behind = time; }

  // once in a step: the length of its kick (time)
  double next_kick(double dt);
  // which that was
  double last_kick() const { return time_of_kick; }
  // which that will be
  double coming_kick(double dt) const { return half ? time_behind + 0.5 * dt : dt; }

  // of the fix. `half_way`: the time by which velocities of spheres are behind those of clumps, or 0;
  // restart() returns that of the file
  void write_restart(FILE *fp, double half_way = 0.0) const;
  double restart(const char *buf);

 private:
  const char *command;
  bool half = false;
  double time_behind = 0.0, time_of_kick = 0.0;
};

}    // namespace LAMMPS_NS

#endif
