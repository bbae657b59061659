// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/periodic_box.h"

#include <cstdlib>

using namespace Talus;

/* A step along y or z has the tilts of a triclinic box. The zeros are products too, as in the host:
   their signs decide about signed zeros of coordinates. */

std::vector<std::array<double, 3>> PeriodicBox::steps_of(const PeriodicShift &shift) const
{
  std::vector<std::array<double, 3>> steps;
  for (int d = 0; d < 3; d++) {
    const double s = shift[d] > 0 ? 1.0 : -1.0;
    std::array<double, 3> step{0.0, 0.0, 0.0};
    if (d == 0) step[0] = s * x;
    if (d == 1) {
      if (tilted) step[0] = s * xy;
      step[1] = s * y;
    }
    if (d == 2) {
      if (tilted) step[0] = s * xz;
      if (tilted) step[1] = s * yz;
      step[2] = s * z;
    }
    steps.insert(steps.end(), std::abs(shift[d]), step);
  }
  return steps;
}
