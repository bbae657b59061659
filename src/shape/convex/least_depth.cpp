// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two convex polyhedra overlap by the least of their depths along the normals of faces of both and
// the cross products of an edge of each (theorem of the separating axis). Only those edge pairs
// count whose arcs of normals cross, which is told by four products (D. Gregorius, The separating
// axis test between convex polyhedra, Game Developers Conference 2013); and only edges that reach
// into the slab in which the overlap is.

#include "shape/convex/core_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/* Faces of one core; `other` is the second one as the first sees it. The depth of a face is at
   least that of a ball inside the second core. */

struct FaceDepth {
  int face = -1;
  Vector normal{};
  double depth;
};

FaceDepth least_of_faces(const ConvexCore &core, const ConvexCore &other, const Pose &seen,
                         double upper)
{
  FaceDepth best;
  best.depth = upper;
  for (int f = 0; f < core.num_faces(); f++) {
    const Vector n = core.normal(f);
    const double above = core.offset(f) - dot(n, seen.position);
    if (above + other.inner_radius() >= best.depth) continue;
    const double depth = above + largest_height(other, seen.direction_in_body(-n));
    if (depth >= best.depth) continue;
    best = {f, n, depth};
  }
  return best;
}

/* Parallel faces that lie on each other: rounding would choose one of them. `n`: the normal of that of b, in the frame of
   that of a. */

bool are_same(const FaceDepth &of_a, const FaceDepth &of_b, const Vector &n, double tolerance)
{
  constexpr double parallel = 1.0e-9;
  const Vector sum = of_a.normal + n;
  return std::fabs(of_a.depth - of_b.depth) < tolerance && dot(sum, sum) < parallel * parallel;
}

/// An edge as the search needs it.
struct Arc {
  int edge;
  Vector from, along, normal[2];
};

/* A depth below a limit: balls inside of both cores tell that its direction is within a cone about
   the line of centers. So is a direction across an edge only if the edge is not along that line. */

struct Cone {
  Vector line;       ///< of centers, in the frame of the pair
  double largest;    ///< its square, times that of the sine of the angle of the cone

  Cone(const CorePair &pair, double limit) : line(pair.seen.position), largest(dot(line, line))
  {
    const double inside = pair.a.inner_radius() + pair.b.inner_radius() - limit;
    if (inside > 0.0) largest -= inside * inside;
  }
  /// Both in one frame.
  bool is_across(const Vector &edge, const Vector &line_of_centers) const
  {
    const double along = dot(edge, line_of_centers);
    return along * along <= largest * dot(edge, edge);
  }
};

/* Edges of a core that reach above the height along a direction; both in the frame of the core,
   results in that of the pair. */

void edges_above(const ConvexCore &core, const Pose &frame, const Vector &direction, double height,
                 const Cone &cone, std::vector<double> &heights, std::vector<Arc> &found)
{
  const Vector line = frame.direction_in_body(cone.line);
  heights.resize(core.num_vertices());
  for (int v = 0; v < core.num_vertices(); v++) heights[v] = dot(direction, core.vertex(v));
  found.clear();
  for (int e = 0; e < core.num_edges(); e++) {
    const ConvexCore::Edge &edge = core.edge(e);
    if (std::max(heights[edge.vertex[0]], heights[edge.vertex[1]]) < height) continue;
    const Vector from = core.vertex(edge.vertex[0]), along = core.vertex(edge.vertex[1]) - from;
    if (!cone.is_across(along, line)) continue;
    found.push_back({e,
                     frame.point_in_space(from),
                     frame.direction_in_space(along),
                     {frame.direction_in_space(core.normal(edge.face[0])),
                      frame.direction_in_space(core.normal(edge.face[1]))}});
  }
}

bool arcs_cross(const Arc &a, const Arc &b)
{
  const double b0 = dot(a.along, b.normal[0]), b1 = dot(a.along, b.normal[1]);
  if (b0 * b1 >= 0.0) return false;
  const double a0 = dot(b.along, a.normal[0]), a1 = dot(b.along, a.normal[1]);
  return a0 * a1 < 0.0 && b0 * a1 < 0.0;
}

/* A flat core: its arcs are half circles, which leave open on which side they go. All supports. */

void try_flat(const CorePair &pair, const Arc &a, const Arc &b, double gain, LeastDepth &best)
{
  const Vector axis = cross(a.along, b.along);
  const double size = length(axis);
  if (!(size > 1.0e-6 * length(a.along) * length(b.along))) return;
  for (const double sign : {-1.0, 1.0}) {
    const Vector n = (sign / size) * axis;
    const double depth = largest_height(pair.a, -n) +
                         largest_height(pair.b, pair.seen.direction_in_body(n)) +
                         dot(n, pair.seen.position);
    if (depth < best.depth - gain) best = {LeastDepth::EDGES, a.edge, b.edge, n, depth};
  }
}

void try_edges(const Arc &a, const Arc &b, double gain, LeastDepth &best)
{
  if (!arcs_cross(a, b)) return;
  const Vector axis = cross(a.along, b.along);
  const double size = length(axis);
  if (!(size > 1.0e-6 * length(a.along) * length(b.along))) return;
  const double sign = dot(axis, a.normal[0] + a.normal[1]) > 0.0 ? -1.0 : 1.0;
  const Vector n = (sign / size) * axis;
  const double depth = dot(n, b.from - a.from);
  if (depth < best.depth - gain) best = {LeastDepth::EDGES, a.edge, b.edge, n, depth};
}

}    // namespace

LeastDepth find_least_depth(const CorePair &pair, const Gap &known)
{
  static thread_local std::vector<double> heights;
  static thread_local std::vector<Arc> arcs_of_a, arcs_of_b;
  const Pose &seen = pair.seen;
  Pose back;    // of a in the frame of b
  back.position = seen.point_in_body({0.0, 0.0, 0.0});
  back.rotation = seen.rotation.transpose();

  const double margin = 1.0e-9 * pair.scale();
  LeastDepth best{LeastDepth::EDGES, -1, -1, known.direction, margin - known.width};
  const FaceDepth of_a = least_of_faces(pair.a, pair.b, seen, best.depth);
  if (of_a.face >= 0) best = {LeastDepth::FACE_OF_A, of_a.face, -1, -of_a.normal, of_a.depth};
  const FaceDepth of_b = least_of_faces(pair.b, pair.a, back, best.depth + 0.1 * margin);
  if (of_b.face >= 0) {
    const Vector n = seen.direction_in_space(of_b.normal);
    if (of_a.face >= 0 && are_same(of_a, of_b, n, 0.1 * margin))
      best = {LeastDepth::FACES, of_a.face, of_b.face, -of_a.normal, of_a.depth};
    else if (of_b.depth < best.depth)
      best = {LeastDepth::FACE_OF_B, -1, of_b.face, n, of_b.depth};
  }
  if (best.depth <= 0.0) return best;

  // edges that are pushed apart by less than the depth are, along the direction found so far, not
  // farther than that behind the surface of the other body
  const Vector n = best.direction, in_b = seen.direction_in_body(n);
  const double shift = dot(n, seen.position), slack = best.depth + margin;
  const double top_of_b = largest_height(pair.b, in_b) + shift;
  const double bottom_of_a = -largest_height(pair.a, -n);
  const Cone cone(pair, slack);
  edges_above(pair.a, Pose(), -n, -top_of_b - slack, cone, heights, arcs_of_a);
  edges_above(pair.b, seen, in_b, bottom_of_a - slack - shift, cone, heights, arcs_of_b);
  const bool flat = pair.a.num_faces() == 2 || pair.b.num_faces() == 2;
  for (const Arc &a : arcs_of_a)
    for (const Arc &b : arcs_of_b) {
      // the normal of a face is a cross product of edges as well: not for rounding's sake
      const double gain = best.kind == LeastDepth::EDGES ? 0.0 : 0.1 * margin;
      flat ? try_flat(pair, a, b, gain, best) : try_edges(a, b, gain, best);
    }
  return best;
}

}    // namespace Talus
