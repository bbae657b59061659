// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where a triangle is nearest to a point, and whether the surface is there.

#include "body/shape/mesh_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus {
namespace {

// So near to parallel or perpendicular that rounding decides. Contacts that are counted twice
// because of it have the same normal and are merged.
constexpr double tolerance = 1.0e-10;

/// Does a step in the direction `along` from the nearest point come nearer?
bool comes_nearer(const Vector3<double> &away, const Vector3<double> &along)
{
  const double closer = dot(away, along);
  return closer > 0.0 &&
         closer * closer > tolerance * tolerance * dot(away, away) * dot(along, along);
}

/* Corners first, then edges, then the face: regions of the plane around a triangle in which the
   nearest point is of that kind, by the signs of projections (Ericson, Real-Time Collision
   Detection, 2005, section 5.1.5). */

/// `across`: along the normal. find_foot() yields the way from the plane to p, and the normal.
template <class Foot>
NearestPoint nearest_of(const Vector3<double> *corner, const Vector3<double> &across,
                        const Vector3<double> &p, Foot find_foot)
{
  const Vector3<double> from[3] = {p - corner[0], p - corner[1], p - corner[2]};
  const auto result = [](const Vector3<double> &away, NearestPoint::Feature feature, int index) {
    return NearestPoint{away, dot(away, away), feature, index, {0.0, 0.0, 0.0}};
  };

  double ahead[3], behind[3];    // along edge k from its first corner, and back from its second
  for (int k = 0; k < 3; k++) {
    const Vector3<double> edge = corner[(k + 1) % 3] - corner[k];
    ahead[k] = dot(edge, from[k]);
    behind[k] = -dot(edge, from[(k + 1) % 3]);
  }
  for (int k = 0; k < 3; k++)
    if (ahead[k] <= 0.0 && behind[(k + 2) % 3] <= 0.0)
      return result(from[k], NearestPoint::CORNER, k);
  for (int k = 0; k < 3; k++) {
    if (ahead[k] <= 0.0 || behind[k] <= 0.0) continue;
    const Vector3<double> edge = corner[(k + 1) % 3] - corner[k];
    if (dot(cross(edge, from[k]), across) > 0.0) continue;    // inside of it
    return result(from[k] - ahead[k] / (ahead[k] + behind[k]) * edge, NearestPoint::EDGE, k);
  }
  NearestPoint foot = result({0.0, 0.0, 0.0}, NearestPoint::FACE, 0);
  foot.away = find_foot(foot.normal);
  foot.square = dot(foot.away, foot.away);
  return foot;
}

}    // namespace

NearestPoint MeshDetail::nearest(int t, const Vector3<double> &p) const
{
  if (!moves) {
    const Face &face = faces[t];
    return nearest_of(face.corner, face.normal, p, [&](Vector3<double> &n) {
      n = face.normal;
      return (dot(p, n) - face.offset) * n;
    });
  }
  const Triangle now = mesh.triangle(t);
  const Vector3<double> across =
      cross(now.corner[1] - now.corner[0], now.corner[2] - now.corner[0]);
  return nearest_of(now.corner, across, p, [&](Vector3<double> &n) {
    const int plane = mesh.plane_of(t);
    n = plane == t ? 1.0 / length(across) * across : mesh.normal(plane);
    const Vector3<double> &origin =
        plane == t ? now.corner[0] : mesh.vertex(mesh.corners(plane).vertex[0]);
    return (dot(p, n) - dot(origin, n)) * n;
  });
}

/* The foot goes no further than the center. So far from all edges as is taken off, nothing of the same plane that
   is beyond them is as near as the foot, however it is rounded. */

FlatPlace MeshDetail::flat_place(int t, const Vector3<double> &center, double reach) const
{
  constexpr double margin = 1.0e-5;
  if (moves || nearest(t, center).feature != NearestPoint::FACE) return {};
  const Face &face = faces[t];
  double inside = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (int k = 0; k < 3; k++) {
    const Vector3<double> edge = face.corner[(k + 1) % 3] - face.corner[k];
    const double size = length(edge);
    inside = std::min(inside, dot(cross(edge, center - face.corner[k]), face.normal) / size);
    longest = std::max(longest, size);
  }
  const double way = inside - margin * (longest + reach);
  return {face.normal, face.offset, face.number, std::max(way, 0.0)};
}

/* Where the way meets the plane, and whether this is on the inner side of all edges. */

bool MeshDetail::is_between(int t, const Vector3<double> &from, const Vector3<double> &to) const
{
  if (moves) {    // most are on one side, which takes no unit normal
    const Triangle now = mesh.triangle(t);
    const Vector3<double> across =
        cross(now.corner[1] - now.corner[0], now.corner[2] - now.corner[0]);
    if ((dot(from - now.corner[0], across) >= 0.0) == (dot(to - now.corner[0], across) >= 0.0))
      return false;
  }
  Face room;
  const Face &face = this->face(t, room);
  const double before = dot(from, face.normal) - face.offset;
  const double after = dot(to, face.normal) - face.offset;
  if ((before >= 0.0) == (after >= 0.0)) return false;
  const Vector3<double> place = from + before / (before - after) * (to - from);
  for (int k = 0; k < 3; k++) {
    const Vector3<double> edge = face.corner[(k + 1) % 3] - face.corner[k];
    if (dot(cross(edge, place - face.corner[k]), face.normal) < -tolerance * dot(edge, edge))
      return false;
  }
  return true;
}

bool MeshDetail::is_local_minimum(int t, const NearestPoint &nearest, double &height) const
{
  if (nearest.feature == NearestPoint::EDGE) return edge_is_minimum(t, nearest, height);
  if (nearest.feature == NearestPoint::CORNER) return corner_is_minimum(t, nearest, height);
  height = dot(nearest.away, nearest.normal);
  return true;
}

/* A triangle at the edge: false if a step into it comes nearer. */

bool MeshDetail::edge_user(int user, int t, const NearestPoint &nearest,
                           Vector3<double> &outward) const
{
  const int k = nearest.index;
  const int a = corners[t].vertex[k], b = corners[t].vertex[(k + 1) % 3];
  int opposite = 0;
  while (opposite < 2 &&
         (corners[user].vertex[opposite] == a || corners[user].vertex[opposite] == b))
    opposite++;
  const Vector3<double> inward = moves
                                     ? mesh.vertex(corners[user].vertex[opposite]) - mesh.vertex(a)
                                     : faces[user].corner[opposite] - faces[t].corner[k];
  if (comes_nearer(nearest.away, inward)) return false;
  outward = outward + normal(user);
  return true;
}

bool MeshDetail::edge_is_minimum(int t, const NearestPoint &nearest, double &height) const
{
  if (!(reports[t].edge >> nearest.index & 1)) return false;
  if (!moves) {
    const double above = dot(nearest.away, faces[t].normal);
    if (above * above < faces[t].least_square_cosine[nearest.index] * nearest.square) return false;
  }
  Vector3<double> outward{0.0, 0.0, 0.0};
  const int over = neighbors[t].over[nearest.index];
  if (over < none) {
    for (const int user : nonmanifold[-2 - over])
      if (!edge_user(user, t, nearest, outward)) return false;
  } else {
    if (!edge_user(t, t, nearest, outward)) return false;
    if (over != none && !edge_user(over, t, nearest, outward)) return false;
  }
  height = dot(nearest.away, outward);
  return true;
}

bool MeshDetail::corner_is_minimum(int t, const NearestPoint &nearest, double &height) const
{
  if (!(reports[t].corner >> nearest.index & 1)) return false;
  if (!moves) {
    const double above = dot(nearest.away, faces[t].normal);
    if (above * above < faces[t].least_at_corners * nearest.square) return false;
  }
  const int v = corners[t].vertex[nearest.index];
  const Vector3<double> at = mesh.vertex(vertex_numbers[v]);
  for (int k = ring_begin[v]; k < ring_begin[v + 1]; k++)
    if (comes_nearer(nearest.away, mesh.vertex(vertex_numbers[ring[k]]) - at)) return false;
  height = dot(nearest.away, moves ? normal_of_vertex(v) : vertex_normals[v]);
  return true;
}

Vector3<double> MeshDetail::normal_of_vertex(int v) const
{
  Vector3<double> sum{0.0, 0.0, 0.0};
  for (int n = around_begin[v]; n < around_begin[v + 1]; n++) {
    int k = 0;
    while (corners[around[n]].vertex[k] != v) k++;
    sum = sum + weighted_normal(around[n], k);
  }
  return sum;
}

}    // namespace Talus
