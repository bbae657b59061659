// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The virial of the contacts of a rank: r_a f_b summed, f the force on the first particle, r from the second to the first,
// in the order of LAMMPS: xx, yy, zz, xy, xz, yz. A contact with a ghost counts half, for another rank has it as well.

#ifndef TALUS_CONTACT_VIRIAL_SUMS_H
#define TALUS_CONTACT_VIRIAL_SUMS_H

#include "base/lanes.h"
#include "base/twofold_sum.h"
#include "base/vector3.h"

namespace Talus {

class VirialSums {
 public:
  static constexpr int size = 6;

  /// Of eight contacts.
  TALUS_INLINE void add(const Vector3<Vec8> &force, const Vector3<Vec8> &separation)
  {
    of_lanes[0].add(force.x * separation.x);
    of_lanes[1].add(force.y * separation.y);
    of_lanes[2].add(force.z * separation.z);
    of_lanes[3].add(separation.x * force.y);
    of_lanes[4].add(separation.x * force.z);
    of_lanes[5].add(separation.y * force.z);
  }
  void add(const VirialSums &other)
  {
    for (int n = 0; n < size; n++) of_lanes[n].add(other.of_lanes[n]);
  }
  double value(int n) const
  {
    TwofoldSum<double> total;
    for (int k = 0; k < lanes; k++) total.add(of_lanes[n].lane(k));
    return total.value();
  }

 private:
  TwofoldSum<Vec8> of_lanes[size];
};

}    // namespace Talus

#endif
