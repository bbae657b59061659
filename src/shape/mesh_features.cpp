// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/mesh_features.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace Talus {
namespace {

using Vector = Vector3<double>;

constexpr double straight = 1.0e-6;    // sine of the angle between pieces of one edge

/// Unit vector in triangle t, normal to the edge and away from it.
Vector inward_of(const TriangleMesh &mesh, int t, const Vector &from, const Vector &along)
{
  const Vector n = mesh.normal(t), across = cross(n, along), middle = [&] {
    const Triangle triangle = mesh.triangle(t);
    return (1.0 / 3.0) * (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]);
  }();
  return (dot(across, middle - from) < 0.0 ? -1.0 : 1.0) / length(across) * across;
}

/// Two directions that leave a vertex.
bool is_straight(const Vector &a, const Vector &b)
{
  return length(cross(a, b)) <= straight && dot(a, b) < 0.0;
}

bool same_planes(const MeshFeatures::Ridge &a, const MeshFeatures::Ridge &b)
{
  if (a.edge_kind != b.edge_kind) return false;
  return (a.planes[0] == b.planes[0] && a.planes[1] == b.planes[1]) ||
         (a.planes[0] == b.planes[1] && a.planes[1] == b.planes[0]);
}

/// Are these directions, which leave a vertex, more than the two halves of a straight line?
bool make_a_corner(const std::vector<Vector> &directions)
{
  return directions.size() > 2 ||
         (directions.size() == 2 && !is_straight(directions[0], directions[1]));
}

}    // namespace

MeshFeatures::MeshFeatures(const TriangleMesh &mesh)
{
  std::vector<Corners> triangles;
  triangles.reserve(mesh.size());
  for (int t = 0; t < mesh.size(); t++) triangles.push_back(mesh.corners(t));
  const MeshEdges edges(triangles);
  look_at_edges(mesh, edges);
  find_ridges(mesh, edges);
  find_around(mesh);
  find_corners(mesh);
}

/* Two triangles that face opposite sides have no common front: each ends at the edge. */

void MeshFeatures::look_at_edges(const TriangleMesh &mesh, const MeshEdges &edges)
{
  edge_kinds.assign(3L * mesh.size(), EdgeKind::BOUNDARY);
  neighbors.assign(3L * mesh.size(), -1);
  for (int t = 0; t < mesh.size(); t++)
    for (int k = 0; k < 3; k++) {
      const MeshEdges::Edge &edge = edges.of(t, k);
      if (edge.num_users != 2) continue;
      const int *user = edges.users(edge), other = user[0] == t ? user[1] : user[0];
      const Corners &corners = mesh.corners(t), &others = mesh.corners(other);
      if (others.runs_along(corners.vertex[k], corners.vertex[(k + 1) % 3])) continue;
      neighbors[3L * t + k] = other;
      EdgeKind &edge_kind = edge_kinds[3L * t + k];
      if (mesh.plane_of(t) == mesh.plane_of(other)) {
        edge_kind = EdgeKind::FLAT;
        continue;
      }
      int opposite = 0;
      while (others.vertex[opposite] == edge.vertex[0] || others.vertex[opposite] == edge.vertex[1])
        opposite++;
      const Vector to = mesh.vertex(others.vertex[opposite]) - mesh.vertex(corners.vertex[k]);
      edge_kind = dot(mesh.normal(mesh.plane_of(t)), to) < 0.0 ? EdgeKind::RIDGE : EdgeKind::VALLEY;
    }
}

void MeshFeatures::find_ridges(const TriangleMesh &mesh, const MeshEdges &edges)
{
  first_ridge.assign(1, 0);
  for (int t = 0; t < mesh.size(); t++) {
    for (int k = 0; k < 3; k++) {
      const MeshEdges::Edge &edge = edges.of(t, k);
      const int *user = edges.users(edge), *vertex = mesh.corners(t).vertex;
      if (edge_kind(t, k) == EdgeKind::FLAT || user[0] != t) continue;
      Ridge ridge{};
      ridge.vertex[0] = vertex[k];
      ridge.vertex[1] = vertex[(k + 1) % 3];
      ridge.from = mesh.vertex(ridge.vertex[0]);
      ridge.along = mesh.vertex(ridge.vertex[1]) - ridge.from;
      ridge.edge_kind = edge_kind(t, k);
      if (edge.num_users <= 2)
        for (int u = 0; u < edge.num_users; u++)
          ridge.inward[u] = inward_of(mesh, user[u], ridge.from, ridge.along);
      const int other = over(t, k);
      ridge.planes[0] = mesh.plane_of(t);
      ridge.planes[1] = other < 0 ? -1 : mesh.plane_of(other);
      if (other >= 0) ridge.outward = mesh.normal(ridge.planes[0]) + mesh.normal(ridge.planes[1]);
      ridges.push_back(ridge);
    }
    first_ridge.push_back(static_cast<int>(ridges.size()));
  }
  join_pieces(mesh);
}

/* Of two pieces that meet, the higher number leads to the lower one. */

void MeshFeatures::join_pieces(const TriangleMesh &mesh)
{
  std::vector<std::vector<int>> at(mesh.num_vertices());
  std::vector<int> to(ridges.size());
  const auto name_of = [&to](int r) {
    while (to[r] != r) r = to[r];
    return r;
  };
  const auto away = [](const Ridge &ridge, int vertex) {
    return (ridge.vertex[0] == vertex ? 1.0 : -1.0) / length(ridge.along) * ridge.along;
  };
  for (int r = 0; r < static_cast<int>(ridges.size()); r++) {
    to[r] = r;
    for (const int v : ridges[r].vertex) {
      for (const int before : at[v])
        if (same_planes(ridges[r], ridges[before]) &&
            is_straight(away(ridges[r], v), away(ridges[before], v))) {
          const int a = name_of(r), b = name_of(before);
          to[std::max(a, b)] = std::min(a, b);
        }
      at[v].push_back(r);
    }
  }
  std::map<int, std::map<int, int>> pieces_at;    // by name and vertex
  for (int r = 0; r < static_cast<int>(ridges.size()); r++) {
    ridges[r].name = static_cast<std::uint32_t>(name_of(r));
    for (const int v : ridges[r].vertex) pieces_at[name_of(r)][v]++;
  }
  for (Ridge &ridge : ridges) {
    int count = 0;
    for (const auto &[vertex, pieces] : pieces_at[static_cast<int>(ridge.name)])
      if (pieces == 1 && count < 2) ridge.end[count++] = vertex;
  }
}

void MeshFeatures::find_around(const TriangleMesh &mesh)
{
  std::vector<std::vector<int>> of_vertex(mesh.num_vertices());
  for (int t = 0; t < mesh.size(); t++)
    for (const int v : mesh.corners(t).vertex) of_vertex[v].push_back(t);
  first_around.assign(1, 0);
  for (const auto &list : of_vertex) {
    around.insert(around.end(), list.begin(), list.end());
    first_around.push_back(static_cast<int>(around.size()));
  }
}

void MeshFeatures::find_corners(const TriangleMesh &mesh)
{
  std::vector<std::vector<Vector>> in_front(mesh.num_vertices()), behind(mesh.num_vertices());
  for (const Ridge &ridge : ridges)
    for (int e = 0; e < 2; e++) {
      const Vector d = (e ? -1.0 : 1.0) / length(ridge.along) * ridge.along;
      if (ridge.edge_kind != EdgeKind::VALLEY) in_front[ridge.vertex[e]].push_back(d);
      if (ridge.edge_kind != EdgeKind::RIDGE) behind[ridge.vertex[e]].push_back(d);
    }
  first_corner.assign(1, 0);
  for (int t = 0; t < mesh.size(); t++) {
    for (const int v : mesh.corners(t).vertex) {
      if (around[first_around[v]] != t) continue;
      Corner corner{
          mesh.vertex(v), {0.0, 0.0, 0.0}, v, make_a_corner(in_front[v]), make_a_corner(behind[v])};
      if (!corner.in_front && !corner.behind) continue;
      visit_around(v, [&](int user) {
        const int *c = mesh.corners(user).vertex;
        const int k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
        const Vector a = mesh.vertex(c[(k + 1) % 3]) - corner.place,
                     b = mesh.vertex(c[(k + 2) % 3]) - corner.place;
        const double angle = std::atan2(length(cross(a, b)), dot(a, b));
        corner.outward = corner.outward + angle * mesh.normal(mesh.plane_of(user));
      });
      corners.push_back(corner);
    }
    first_corner.push_back(static_cast<int>(corners.size()));
  }
}

}    // namespace Talus
