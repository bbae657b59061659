// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/core_pair.h"

#include "base/simd.h"

#include <cstdint>

namespace Talus {

/* Eight at a time; each lane remembers the block of its highest vertex. Of vertices with the same
   height the first is taken, so that the result does not depend on the width of vectors. */

Support highest_vertex(const ConvexCore &core, const Vector3<double> &direction)
{
  const VectorArray &x = core.all_vertices();
  const Vec8 dx = splat<Vec8>(direction.x), dy = splat<Vec8>(direction.y),
             dz = splat<Vec8>(direction.z);
  const auto height = [&](int k) {
    return dx * load8(x.of(0) + k) + dy * load8(x.of(1) + k) + dz * load8(x.of(2) + k);
  };
  Vec8 best = height(0), block = splat<Vec8>(0.0);
  for (int k = 8; k < x.padded_size(); k += 8) {
    const Vec8 h = height(k);
    const auto higher = best < h;
    best = select(higher, h, best);
    block = select(higher, splat<Vec8>(k), block);
  }
  alignas(64) double of_lane[8], block_of_lane[8];
  store(of_lane, best);
  store(block_of_lane, block);
  int lane = 0;
  for (int k = 1; k < 8; k++) {
    const bool better = of_lane[k] > of_lane[lane] ||
                        (of_lane[k] == of_lane[lane] && block_of_lane[k] < block_of_lane[lane]);
    lane = better ? k : lane;
  }
  const int found = static_cast<int>(block_of_lane[lane]) + lane;
  // padding repeats the last vertex
  return {found < x.size() ? found : x.size() - 1, of_lane[lane]};
}

}    // namespace Talus
