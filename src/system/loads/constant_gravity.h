/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_CONSTANT_GRAVITY_H
#define LMP_CONSTANT_GRAVITY_H

#include "base/words.h"
#include "pointers.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The words `gravity G STYLE args` of a fix: magnitude and styles of fix gravity, numbers only.

     gravity G chute angle
     gravity G spherical phi theta
     gravity G vector x y z

   Called by the constructor of the fix. G in force/mass units, angles in degrees.
------------------------------------------------------------------------- */

class ConstantGravity : protected Pointers {
 public:
  explicit ConstantGravity(class LAMMPS *lmp) : Pointers(lmp) {}

  // reads what follows the word gravity, which has been read
  void parse(Talus::Words &words);

  bool given() const { return is_given; }
  const double *acceleration() const { return g; }

 private:
  bool is_given = false;
  double g[3] = {0.0, 0.0, 0.0};

  void set(double, double, double);
  void set_along(double, Talus::Vector3<double>, Talus::Words &);
};

}    // namespace LAMMPS_NS

#endif
