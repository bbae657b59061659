// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Differences of places in a box that is periodic in some directions.

#ifndef TALUS_PACKING_NEAREST_IMAGE_H
#define TALUS_PACKING_NEAREST_IMAGE_H

#include "packing/sphere_grid.h"

namespace Talus {

class NearestImage {
 public:
  explicit NearestImage(const GridBox &box) :
      period{box.periodic[0] ? box.hi.x - box.lo.x : 0.0,
             box.periodic[1] ? box.hi.y - box.lo.y : 0.0,
             box.periodic[2] ? box.hi.z - box.lo.z : 0.0}
  {
  }
  /// The difference of the nearest images of two points in the box or near it, of their difference.
  Vector3<double> operator()(Vector3<double> d) const
  {
    return {along(d.x, period.x), along(d.y, period.y), along(d.z, period.z)};
  }

 private:
  static double along(double d, double period)
  {
    const double half = 0.5 * period;
    return period == 0.0 ? d : d > half ? d - period : d < -half ? d + period : d;
  }

  Vector3<double> period;    // 0: not periodic
};

}    // namespace Talus

#endif
