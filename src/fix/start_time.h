/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_START_TIME_H
#define LMP_START_TIME_H

#include "pointers.h"

#include <cstdio>
#include <string>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   To which time the velocities of an integrator with one kick in each step belong: the words
   `start plain` and `start half`.

   Plain: every kick is dt. Half: velocities are behind positions by lag(), which is 0 before the
   first step and then dt/2; a kick is lag + dt/2, from the time of v to half way between the times
   of x. Restart files keep both.
------------------------------------------------------------------------- */

class StartTime : protected Pointers {
 public:
  // `command`: for messages, with the first letter in capitals
  StartTime(class LAMMPS *lmp, const char *command) : Pointers(lmp), command(command) {}

  void set_half(bool yes) { half = yes; }
  bool is_half() const { return half; }
  double lag() const { return time_behind; }

  // once in a step: the length of its kick (time)
  double next_kick(double dt);

  // of the fix
  void write_restart(FILE *fp) const;
  void restart(const char *buf);

 private:
  const char *command;
  bool half = false;
  double time_behind = 0.0;
};

}    // namespace LAMMPS_NS

#endif
