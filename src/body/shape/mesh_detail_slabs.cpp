// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which triangles of a leaf of the tree may be near a point, all of them at once: boxes around long triangles
// that are aslant are much larger than these.

#include "body/shape/mesh_detail.h"

#include <cmath>

namespace Talus {

void MeshDetail::Slabs::set_plane(int k, int which, const Vector3<double> &n,
                                  const Vector3<double> &point)
{
  const double along[3] = {n.x, n.y, n.z};
  for (int d = 0; d < 3; d++) normal[which][d][k] = static_cast<float>(along[d]);
  offset[which][k] = static_cast<float>(dot(n, point));
}

void MeshDetail::make_slabs()
{
  slabs.assign(tree->num_leaves(), Slabs{});
  for (int leaf = 0; leaf < tree->num_leaves(); leaf++)
    for (int k = 0; k < BoxTree::leaf_size && tree->thing(leaf, k) >= 0; k++) {
      const int t = number(near[tree->thing(leaf, k)]);
      const Triangle triangle = mesh.triangle(t);
      const Vector3<double> n = mesh.normal(t);
      slabs[leaf].set_plane(k, 0, n, triangle.corner[0]);
      for (int edge = 0; edge < 3; edge++) {
        const Vector3<double> out =
            cross(triangle.corner[(edge + 1) % 3] - triangle.corner[edge], n);
        slabs[leaf].set_plane(k, 1 + edge, 1.0 / length(out) * out, triangle.corner[edge]);
      }
    }
}

/* In the numbers of the planes: what is left out is further away by more than their rounding. */

unsigned MeshDetail::near_bits(const Slabs &slabs, const Vector3<double> &point, double reach)
{
  static_assert(BoxTree::leaf_size == width_of<Float8>);
  constexpr double rounding = 2.0e-6;
  const double limit =
      reach + rounding * (reach + std::fabs(point.x) + std::fabs(point.y) + std::fabs(point.z));
  const auto all = [](double x) { return static_cast<float>(x) - Float8{}; };
  const Float8 p[3] = {all(point.x), all(point.y), all(point.z)};
  const auto height = [&](int which) {
    const auto part = [&](int d) { return Memory<Float8>::load(slabs.normal[which][d]) * p[d]; };
    return part(0) + part(1) + part(2) - Memory<Float8>::load(slabs.offset[which]);
  };
  const Float8 above = height(0);
  const Float8 away =
      larger(larger(above, -above), larger(larger(height(1), height(2)), height(3)));
  return less_bits(away, all(limit));
}

}    // namespace Talus
