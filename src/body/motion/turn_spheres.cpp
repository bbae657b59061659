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
  const auto place = [=](int k) { return begin + (k < count ? k : 0); };
  const auto turn = [&](int k) { return spheres.orientation + 4L * place(k); };
  const EightRows omega = lanes_of([&](int k) { return spheres.omega.at(place(k)); });
  const EightRows before = lanes_of([&](int k) { return Memory<Vec4>::load_anywhere(turn(k)); });
  const Quaternion<Vec8> turned = extrapolated_turn(
      Quaternion<Vec8>{before.number[0], before.number[1], before.number[2], before.number[3]},
      Vector3<Vec8>{omega.number[0], omega.number[1], omega.number[2]}, dt);
  alignas(32) double after[lanes][4];
  to_rows(EightRows{turned.w, turned.x, turned.y, turned.z}, after);
  for (int k = 0; k < count; k++)
    if (spheres.mask[place(k)] & spheres.group)
      Memory<Vec4>::store_anywhere(turn(k), load4(after[k]));
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
