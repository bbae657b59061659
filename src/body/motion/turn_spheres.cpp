// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/motion/turn_spheres.h"

#include "base/in_parallel.h"
#include "base/lanes.h"
#include "body/motion/extrapolated_turn.h"

#include <algorithm>

namespace Talus {

namespace {

/// Particles begin ... begin+count-1; the lanes of others have those of the first one.
void turn_eight(const TurningSpheres &spheres, int begin, int count, double dt)
{
  alignas(64) double numbers[7][lanes];
  const auto place = [=](int k) { return begin + (k < count ? k : 0L); };
  for (int k = 0; k < lanes; k++) {
    const double *const omega = spheres.omega + 3 * place(k);
    const double *const turn = spheres.orientation + 4 * place(k);
    for (int d = 0; d < 3; d++) numbers[d][k] = omega[d];
    for (int d = 0; d < 4; d++) numbers[3 + d][k] = turn[d];
  }
  const auto lane = [&](int n) { return load8(numbers[n]); };
  const Quaternion<Vec8> turned =
      extrapolated_turn(Quaternion<Vec8>{lane(3), lane(4), lane(5), lane(6)},
                        Vector3<Vec8>{lane(0), lane(1), lane(2)}, dt);
  const Vec8 found[] = {turned.w, turned.x, turned.y, turned.z};
  for (int d = 0; d < 4; d++) store(numbers[d], found[d]);
  for (int k = 0; k < count; k++) {
    if (!(spheres.mask[place(k)] & spheres.group)) continue;
    for (int d = 0; d < 4; d++) spheres.orientation[4 * place(k) + d] = numbers[d][k];
  }
}

}    // namespace

void turn_spheres(const TurningSpheres &spheres, double dt, int threads)
{
  in_ranges(spheres.count, threads, [&](int, int first, int last) {
    for (int begin = first; begin < last; begin += lanes)
      turn_eight(spheres, begin, std::min(lanes, last - begin), dt);
  });
}

}    // namespace Talus
