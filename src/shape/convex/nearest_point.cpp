// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/core_pair.h"

#include "base/simd.h"

#include <algorithm>
#include <limits>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/// The face above which x is highest; of several the first.
int highest_face(const ConvexCore &core, const Vector &x, double &height)
{
  const VectorArray &n = core.all_normals();
  alignas(64) double h[8];
  int found = 0;
  height = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < n.padded_size(); k += 8) {
    store(h, splat<Vec8>(x.x) * load8(n.of(0) + k) + splat<Vec8>(x.y) * load8(n.of(1) + k) +
                 splat<Vec8>(x.z) * load8(n.of(2) + k) - load8(core.all_offsets() + k));
    for (int q = 0; q < 8; q++) {
      found = h[q] > height ? k + q : found;
      height = std::max(height, h[q]);
    }
  }
  return std::min(found, core.num_faces() - 1);
}

/* The nearest point of a face. Beyond the sides of a convex polygon, it is the nearest one of the
   sides beyond which x is. */

CorePoint nearest_of_face(const ConvexCore &core, int f, const Vector &x)
{
  const int count = core.num_corners(f), *corner = core.corners(f);
  const Vector n = core.normal(f);
  CorePoint found{CorePoint::FACE, f, {}, n, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count; k++) {
    const int v = corner[k], next = corner[k + 1 < count ? k + 1 : 0];
    const Vector from = core.vertex(v), along = core.vertex(next) - from, d = x - from;
    if (dot(cross(n, along), d) >= 0.0) continue;
    const double t = dot(d, along), size = dot(along, along);
    Vector point = from;
    CorePoint side{CorePoint::VERTEX, v, {}, n, 0.0};
    if (t >= size) {
      point = core.vertex(next);
      side.part = next;
    } else if (t > 0.0) {
      point = from + (t / size) * along;
      side.kind = CorePoint::EDGE;
      side.part = core.edges_of_face(f)[k];
    }
    const Vector away = x - point;
    const double square = dot(away, away);
    if (square >= least) continue;
    least = square;
    found = side;
    found.point = point;
  }
  if (found.kind == CorePoint::FACE) {
    found.distance = dot(n, x) - core.offset(f);
    found.point = x - found.distance * n;
  } else {
    found.distance = std::sqrt(least);
    if (found.distance > 0.0) found.normal = (1.0 / found.distance) * (x - found.point);
  }
  return found;
}

/* A face on which there are points nearer to x than the nearest one of the last face, which is on
   an edge or a vertex of it; -1: none, so that it is the nearest of the whole core. The way beyond
   an edge leads into its other face, and that from a vertex along the edge that leads to x most. */

int face_towards(const ConvexCore &core, const CorePoint &near, int last)
{
  if (near.kind == CorePoint::EDGE) {
    const ConvexCore::Edge &edge = core.edge(near.part);
    const int side = edge.face[0] == last ? 1 : 0;
    const Vector along = core.vertex(edge.vertex[1]) - core.vertex(edge.vertex[0]);
    const Vector inward = cross(core.normal(edge.face[side]), side == 0 ? along : -along);
    return dot(inward, near.normal) > 0.0 ? edge.face[side] : -1;
  }
  int best = -1;
  double steepest = 0.0;
  for (int k = 0; k < core.num_edges_of_vertex(near.part); k++) {
    const ConvexCore::Edge &edge = core.edge(core.edges_of_vertex(near.part)[k]);
    const int other = edge.vertex[edge.vertex[0] == near.part ? 1 : 0];
    const Vector along = core.vertex(other) - near.point;
    const double slope = dot(along, near.normal) / length(along);
    if (slope <= steepest) continue;
    steepest = slope;
    best = edge.face[edge.face[0] == last ? 1 : 0];
  }
  return best;
}

}    // namespace

/* From the face above which x is highest, face by face downhill: the distance from a convex body
   has no other minimum than the least. */

CorePoint nearest_point(const ConvexCore &core, const Vector &x)
{
  double height;
  int face = highest_face(core, x, height);
  if (height <= 0.0) {
    const Vector n = core.normal(face);
    return {CorePoint::FACE, face, x - height * n, n, height};
  }
  CorePoint near = nearest_of_face(core, face, x);
  while (near.kind != CorePoint::FACE) {
    face = face_towards(core, near, face);
    if (face < 0) break;
    const CorePoint next = nearest_of_face(core, face, x);
    if (!(next.distance < near.distance)) break;
    near = next;
  }
  return near;
}

}    // namespace Talus
