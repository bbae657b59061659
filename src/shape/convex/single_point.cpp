// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where g > 0 ends nowhere but at g = 0, all around one deepest point from which g falls along each
// straight line, the mean of g^4 is depth^4/15 whatever the slopes are, and the mean overlap is the
// depth.

#include "shape/convex/mean_overlap.h"

namespace Talus {
namespace {

using Vector = Vector3<double>;

/* A point is above or below the face: on the inner side of its edges. All in the frame of the
   core. */

bool is_over_face(const ConvexCore &core, int f, const Vector &x)
{
  const int count = core.num_corners(f);
  const int *corner = core.corners(f);
  Vector from = core.vertex(corner[count - 1]);
  for (int k = 0; k < count; k++) {
    const Vector to = core.vertex(corner[k]);
    if (!(dot(cross(core.normal(f), to - from), x - from) > 0.0)) return false;
    from = to;
  }
  return true;
}

/* All edges of a vertex that is behind a face leave through the face: `pose` is that of the core of
   the vertex in the frame of the other one. */

bool is_tip(const ConvexCore &core, int v, const Pose &pose, const ConvexCore &other, int f)
{
  const Vector n = other.normal(f), tip = pose.point_in_space(core.vertex(v));
  const double depth = other.offset(f) - dot(n, tip);
  for (int k = 0; k < core.num_edges_of_vertex(v); k++) {
    const ConvexCore::Edge &edge = core.edge(core.edges_of_vertex(v)[k]);
    const Vector along =
        pose.point_in_space(core.vertex(edge.vertex[edge.vertex[0] == v ? 1 : 0])) - tip;
    const double rise = dot(n, along);
    if (!(rise > depth) || !is_over_face(other, f, tip + (depth / rise) * along)) return false;
  }
  return true;
}

/* An edge enters and leaves through the faces of an edge of the other core; in its frame. */

bool pierces(const Vector &from, const Vector &along, const ConvexCore &other, int e)
{
  for (const int f : other.edge(e).face) {
    const double rise = dot(other.normal(f), along),
                 part = other.offset(f) - dot(other.normal(f), from);
    const double t = rise != 0.0 ? part / rise : -1.0;
    if (!(t > 0.0 && t < 1.0) || !is_over_face(other, f, from + t * along)) return false;
  }
  return true;
}

}    // namespace

bool find_single_point(const CorePair &pair, const LeastDepth &least, Vector &of_a)
{
  const Vector n = least.direction;
  const Pose &seen = pair.seen;
  if (least.kind == LeastDepth::FACES) return false;    // edges lie in the other face
  if (least.kind == LeastDepth::FACE_OF_A) {
    const int v = highest_vertex(pair.b, seen.direction_in_body(n)).vertex;
    of_a = pair.vertex_of_b(v) - least.depth * n;
    return is_tip(pair.b, v, seen, pair.a, least.of_a);
  }
  if (least.kind == LeastDepth::FACE_OF_B) {
    Pose back;    // of a in the frame of b
    back.position = seen.point_in_body({0.0, 0.0, 0.0});
    back.rotation = seen.rotation.transpose();
    const int v = highest_vertex(pair.a, -n).vertex;
    of_a = pair.a.vertex(v);
    return is_tip(pair.a, v, back, pair.b, least.of_b);
  }
  if (least.of_a < 0) return false;
  const ConvexCore::Edge &edge_of_a = pair.a.edge(least.of_a), &edge_of_b = pair.b.edge(least.of_b);
  const Vector p = pair.a.vertex(edge_of_a.vertex[0]), q = pair.vertex_of_b(edge_of_b.vertex[0]),
               a = pair.a.vertex(edge_of_a.vertex[1]) - p,
               b = pair.vertex_of_b(edge_of_b.vertex[1]) - q;
  const Vector across = cross(b, n);
  of_a = p + (dot(across, q - p) / dot(across, a)) * a;
  return pierces(q, b, pair.a, least.of_a) &&
         pierces(seen.point_in_body(p), seen.direction_in_body(a), pair.b, least.of_b);
}

}    // namespace Talus
