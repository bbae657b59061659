// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The algorithm of Gilbert, Johnson and Keerthi: a simplex of points of the difference of both
// bodies comes nearer to the origin, one support point after the other.

#include "shape/convex/core_pair.h"

#include <algorithm>
#include <limits>

namespace Talus {
namespace {

using Vector = Vector3<double>;

class Simplex {
 public:
  void add(const Vector &w) { corner[count++] = w; }
  bool has(const Vector &w) const
  {
    for (int k = 0; k < count; k++)
      if (corner[k].x == w.x && corner[k].y == w.y && corner[k].z == w.z) return true;
    return false;
  }
  bool encloses_origin() const { return count == 4; }

  /// The point that is nearest to the origin; drops the corners that it does not need.
  Vector nearest()
  {
    switch (count) {
    case 1:
      return corner[0];
    case 2:
      return of_segment(corner[0], corner[1]);
    case 3:
      return of_triangle(corner[0], corner[1], corner[2]);
    default:
      return of_tetrahedron();
    }
  }

 private:
  void keep(const Vector &a)
  {
    corner[0] = a;
    count = 1;
  }
  void keep(const Vector &a, const Vector &b)
  {
    corner[0] = a;
    corner[1] = b;
    count = 2;
  }
  Vector of_segment(Vector a, Vector b)
  {
    const Vector ab = b - a;
    const double t = -dot(a, ab), size = dot(ab, ab);
    if (t <= 0.0) {
      keep(a);
      return a;
    }
    if (t >= size) {
      keep(b);
      return b;
    }
    keep(a, b);
    return a + (t / size) * ab;
  }
  Vector of_triangle(Vector a, Vector b, Vector c);
  Vector of_tetrahedron();

  Vector corner[4];
  int count = 0;
};

/* The regions of the plane in which corners, sides or the inside are nearest: C. Ericson, Real-time
   collision detection (2005), section 5.1.5. */

Vector Simplex::of_triangle(Vector a, Vector b, Vector c)
{
  const Vector ab = b - a, ac = c - a;
  const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b),
               d5 = -dot(ab, c), d6 = -dot(ac, c);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (va > 0.0 && vb > 0.0 && vc > 0.0) {
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    count = 3;
    // along the normal: exact where the triangle is near the origin
    const Vector n = cross(ab, ac);
    const double square = dot(n, n);
    if (square > 0.0) return (dot(n, a) / square) * n;
    return a + (vb / sum) * ab + (vc / sum) * ac;
  }
  // the nearest of the sides
  const Vector ends[3][2] = {{a, b}, {a, c}, {b, c}};
  Simplex best;
  Vector at_best{};
  double least = std::numeric_limits<double>::infinity();
  for (const auto &end : ends) {
    Simplex side;
    const Vector at = side.of_segment(end[0], end[1]);
    if (dot(at, at) >= least) continue;
    least = dot(at, at);
    best = side;
    at_best = at;
  }
  *this = best;
  return at_best;
}

Vector Simplex::of_tetrahedron()
{
  const Vector x[4] = {corner[0], corner[1], corner[2], corner[3]};
  static constexpr int face[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  Simplex best;
  Vector at_best{0.0, 0.0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  bool outside = false;
  for (const auto &f : face) {
    const Vector n = cross(x[f[1]] - x[f[0]], x[f[2]] - x[f[0]]);
    const double of_origin = -dot(n, x[f[0]]), of_fourth = dot(n, x[f[3]] - x[f[0]]);
    if (of_origin * of_fourth > 0.0) continue;    // on the side of the inside
    outside = true;
    Simplex side;
    const Vector at = side.of_triangle(x[f[0]], x[f[1]], x[f[2]]);
    if (dot(at, at) >= least) continue;
    least = dot(at, at);
    best = side;
    at_best = at;
  }
  if (!outside) return {0.0, 0.0, 0.0};    // all four stay
  *this = best;
  return at_best;
}

}    // namespace

Gap find_gap(const CorePair &pair, const Vector &start, double enough, double accuracy)
{
  constexpr int most_steps = 60;
  const double too_near = 1.0e-14 * pair.scale() * pair.scale();
  Simplex simplex;
  Vector v = start;
  Gap best{(1.0 / length(v)) * v, -std::numeric_limits<double>::infinity()};
  double square = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; step++) {
    const Support low = highest_vertex(pair.a, -v);
    const Vector in_b = pair.seen.direction_in_body(v);
    const Support high = highest_vertex(pair.b, in_b);
    const Vector w = pair.a.vertex(low.vertex) - pair.vertex_of_b(high.vertex);
    const double size = length(v), width = dot(v, w) / size;
    if (width > best.width) best = {(1.0 / size) * v, width};
    if (best.width > enough) return best;
    if (step > 0 && size - best.width <= accuracy && best.width > 0.0) return best;
    if (simplex.has(w)) return best;
    simplex.add(w);
    v = simplex.nearest();
    const double now = dot(v, v);
    if (simplex.encloses_origin() || now <= too_near || now >= square) return best;
    square = now;
  }
  return best;
}

}    // namespace Talus
