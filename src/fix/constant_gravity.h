/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_CONSTANT_GRAVITY_H
#define LMP_CONSTANT_GRAVITY_H

#include "pointers.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The words `gravity G STYLE args` of a fix: magnitude and styles of fix gravity, numbers only.

     gravity G chute angle
     gravity G spherical phi theta
     gravity G vector x y z

   Called by the constructor of the fix. G in force/mass units, angles in degrees.
   Errors: error->all at the word of the fix command line, named after `command`.
------------------------------------------------------------------------- */

class ConstantGravity : protected Pointers {
 public:
  ConstantGravity(class LAMMPS *, const char *command);

  // iarg: index of the word gravity; returns the number of words read
  int parse(int narg, char **arg, int iarg);

  bool given() const { return words > 0; }
  const double *acceleration() const { return g; }

 private:
  const char *command;
  int words = 0;
  double g[3] = {0.0, 0.0, 0.0};

  void need(int, char **, int, int, const char *);
  double number(char **, int, const char *);
  void set(double, double, double);
  void set(double, double, double, double);
};

}    // namespace LAMMPS_NS

#endif
