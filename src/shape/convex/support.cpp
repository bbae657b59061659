// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/core_pair.h"

#include "base/simd.h"

#include <algorithm>

namespace Talus {
namespace {

struct Eight {
  alignas(64) double lane[lanes];
  explicit Eight(Vec8 v) { store(lane, v); }
  double largest() const
  {
    const double a = std::max(lane[0], lane[1]), b = std::max(lane[2], lane[3]),
                 c = std::max(lane[4], lane[5]), d = std::max(lane[6], lane[7]);
    return std::max(std::max(a, b), std::max(c, d));
  }
};

/// Heights of eight vertices.
class Heights {
 public:
  Heights(const VectorArray &vertices, const Vector3<double> &direction) :
      x(vertices), dx(splat<Vec8>(direction.x)), dy(splat<Vec8>(direction.y)),
      dz(splat<Vec8>(direction.z))
  {
  }
  Vec8 from(int k) const
  {
    return dx * load8(x.of(0) + k) + dy * load8(x.of(1) + k) + dz * load8(x.of(2) + k);
  }

 private:
  const VectorArray &x;
  Vec8 dx, dy, dz;
};

}    // namespace

double largest_height(const ConvexCore &core, const Vector3<double> &direction)
{
  const VectorArray &x = core.all_vertices();
  const Heights height(x, direction);
  Vec8 best = height.from(0);
  for (int k = lanes; k < x.padded_size(); k += lanes) {
    const Vec8 h = height.from(k);
    best = select(best < h, h, best);
  }
  return Eight(best).largest();
}

/* Eight at a time; each lane remembers the block of its highest vertex. Of vertices with the same
   height the first is taken, so that the result does not depend on the width of vectors. */

Support highest_vertex(const ConvexCore &core, const Vector3<double> &direction)
{
  const VectorArray &x = core.all_vertices();
  const Heights height(x, direction);
  Vec8 best = height.from(0), block = splat<Vec8>(0.0);
  for (int k = lanes; k < x.padded_size(); k += lanes) {
    const Vec8 h = height.from(k);
    const auto higher = best < h;
    best = select(higher, h, best);
    block = select(higher, splat<Vec8>(k), block);
  }
  const double highest = Eight(best).largest();
  unsigned bits = ~less_bits(best, splat<Vec8>(highest)) & 0xffU;
  int found = __builtin_ctz(bits);
  if (x.padded_size() > lanes) {
    const Eight blocks(block);
    found += static_cast<int>(blocks.lane[found]);
    while (bits &= bits - 1) {
      const int lane = __builtin_ctz(bits), other = static_cast<int>(blocks.lane[lane]) + lane;
      found = std::min(found, other);
    }
  }
  // padding repeats the last vertex
  return {found < x.size() ? found : x.size() - 1, highest};
}

}    // namespace Talus
