/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_SECOND_ORDER_CHECK_H
#define LMP_SECOND_ORDER_CHECK_H

#include "pointers.h"
#include "system/step/granular_system.h"

#include <string>

namespace LAMMPS_NS {

class StartTime;

/* ----------------------------------------------------------------------
   `order 2` of a fix that moves particles: what it implies, and what of a scene it cannot have.

   Proxies find the changes of velocities from those that they receive: all particles must be moved
   by fixes of order 2, with the same lag.

   Errors: by error->all on every rank, they name the fix and the cure.
------------------------------------------------------------------------- */

class SecondOrderCheck : protected Pointers {
 public:
  // `title`: of the command, for messages, with the first letter in capitals
  SecondOrderCheck(const class Fix *fix, class LAMMPS *lmp, const char *title) :
      Pointers(lmp), fix(fix), title(title)
  {
  }

  // order 2 is `start half`; constructor
  static void set_half(class LAMMPS *, const char *title, StartTime &, bool says_start);
  // init(), collective; the log says what is of second order once, for the first fix. A fix that has not made
  // a step gets the lag of those that have
  void check(Talus::GranularSystem &, StartTime &);

 private:
  const class Fix *fix;
  const char *title;
  bool announced = false;

  void announce(Talus::GranularSystem &);
};

}    // namespace LAMMPS_NS

#endif
