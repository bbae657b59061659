// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

namespace Talus {
namespace {

constexpr double no_overlap = 1.0e-10;    // of triangles that touch, over the size of one

struct Range {
  double low, high;
};

Range seen_along(const Vector3<double> &axis, const Triangle &t)
{
  const double a = dot(axis, t.corner[0]), b = dot(axis, t.corner[1]), c = dot(axis, t.corner[2]);
  return {std::min({a, b, c}), std::max({a, b, c})};
}

/// Seen along the axis they do not overlap.
bool are_apart(const Vector3<double> &axis, const Triangle &a, const Triangle &b, double allowed)
{
  const Range first = seen_along(axis, a), second = seen_along(axis, b);
  const double gap = std::max(second.low - first.high, first.low - second.high);
  return gap >= 0.0 || gap >= -allowed * length(axis);
}

/* Separating axes of two triangles: the normals, and across the edges of both in space, or where both are
   nearly in one plane, across those of one in its plane. */

bool overlap(const Triangle &a, const Triangle &b, const Vector3<double> &normal_a,
             const Vector3<double> &normal_b, double allowed)
{
  if (are_apart(normal_a, a, b, allowed) || are_apart(normal_b, a, b, allowed)) return false;
  Vector3<double> edges[2][3];
  for (int k = 0; k < 3; k++) {
    edges[0][k] = a.corner[(k + 1) % 3] - a.corner[k];
    edges[1][k] = b.corner[(k + 1) % 3] - b.corner[k];
  }
  for (int k = 0; k < 3; k++)
    if (are_apart(cross(normal_a, edges[0][k]), a, b, allowed) ||
        are_apart(cross(normal_b, edges[1][k]), a, b, allowed))
      return false;
  for (const Vector3<double> &of_a : edges[0])
    for (const Vector3<double> &of_b : edges[1])
      if (are_apart(cross(of_a, of_b), a, b, allowed)) return false;
  return true;
}

int num_shared(const Corners &a, const Corners &b, int &shared)
{
  int count = 0;
  for (const int v : a.vertex)
    for (const int w : b.vertex)
      if (v == w) {
        shared = v;
        count++;
      }
  return count;
}

}    // namespace

MeshCheck::MeshCheck(const TriangleMesh &triangle_mesh) :
    mesh(triangle_mesh), all_edges(triangle_mesh.all_corners())
{
}

Triangle MeshCheck::triangle(const Places &places, int t) const
{
  const int *const v = mesh.corners(t).vertex;
  return {{places[v[0]], places[v[1]], places[v[2]]}};
}

std::string MeshCheck::name_of(int t, const Places &places) const
{
  const Vector3<double> &x = places[mesh.corners(t).vertex[0]];
  char text[128];
  std::snprintf(text, sizeof text, "triangle %d (first corner at %.6g %.6g %.6g)", t, x.x, x.y, x.z);
  return text;
}

std::string MeshCheck::problem(const Places &now, const Places &then)
{
  to = &then;
  moved.assign(mesh.num_own(), false);
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex) {
      const Vector3<double> way = then[v] - now[v];
      if (way.x != 0.0 || way.y != 0.0 || way.z != 0.0) moved[t] = true;
    }
  std::string found = find_normals(then);
  if (found.empty()) found = turned_over(now);
  if (found.empty()) found = crossing();
  to = nullptr;
  return found;
}

/* Thinner than rounding leaves a direction to the normal. */

std::string MeshCheck::find_normals(const Places &places)
{
  constexpr double thin = 1.0e-12;
  normals.resize(mesh.size());
  for (int t = 0; t < mesh.size(); t++) {
    const Triangle at = triangle(places, t);
    const Vector3<double> a = at.corner[1] - at.corner[0], b = at.corner[2] - at.corner[1],
                          c = at.corner[0] - at.corner[2], twice = cross(a, b);
    const double area = length(twice), longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
    if (!(area > thin * longest)) return name_of(mesh.own(t), places) + " has no area";
    normals[t] = 1.0 / area * twice;
  }
  return "";
}

/* ---- neighbors ---------------------------------------------------------------------------------- */

/* Angle by which b is folded against a: 0 in one plane, > 0 away from the side of the normals; whatever
   way round b is. */

double MeshCheck::fold(const MeshEdges::Edge &edge, int a, int b, const Places &places) const
{
  int from = edge.vertex[0], to_vertex = edge.vertex[1];
  if (!mesh.corners(a).runs_along(from, to_vertex)) std::swap(from, to_vertex);
  const bool opposed = mesh.corners(b).runs_along(from, to_vertex);
  const auto normal = [&](int t) {
    const Triangle at = triangle(places, t);
    const Vector3<double> twice =
        cross(at.corner[1] - at.corner[0], at.corner[2] - at.corner[0]);
    return 1.0 / length(twice) * twice;
  };
  const Vector3<double> n = normal(a), m = opposed ? -normal(b) : normal(b);
  const Vector3<double> along = places[to_vertex] - places[from];
  return std::atan2(dot(cross(n, m), along) / length(along), dot(n, m));
}

std::string MeshCheck::turned_over(const Places &now) const
{
  const double quarter = 0.5 * std::acos(-1.0);
  for (const MeshEdges::Edge &edge : all_edges.all()) {
    if (edge.num_users != 2) continue;
    const int a = all_edges.users(edge)[0], b = all_edges.users(edge)[1];
    if (b >= mesh.num_own() || (!moved[a] && !moved[b])) continue;
    const double cosine = dot(normals[a], normals[b]);
    const bool opposed = mesh.corners(a).runs_along(edge.vertex[0], edge.vertex[1]) ==
                         mesh.corners(b).runs_along(edge.vertex[0], edge.vertex[1]);
    if ((opposed ? -cosine : cosine) >= 0.0) continue;
    if (std::fabs(fold(edge, a, b, *to) - fold(edge, a, b, now)) <= quarter) continue;
    const auto kept = [&](int t) {    // of its own direction
      const Triangle at = triangle(now, t);
      const Vector3<double> twice =
          cross(at.corner[1] - at.corner[0], at.corner[2] - at.corner[0]);
      return dot(normals[t], twice) / length(twice);
    };
    const int turned = kept(a) < kept(b) ? a : b, other = turned == a ? b : a;
    return name_of(turned, *to) + " has turned over against its neighbor, triangle " +
           std::to_string(other);
  }
  return "";
}

/* Triangles that share an edge are parts of one patch if it is smooth: see TriangleMesh::patch(). */

std::vector<int> MeshCheck::patches() const
{
  std::vector<int> patch(mesh.size());
  std::iota(patch.begin(), patch.end(), 0);
  const auto root = [&patch](int t) {
    while (patch[t] != t) t = patch[t] = patch[patch[t]];
    return t;
  };
  for (const MeshEdges::Edge &edge : all_edges.all()) {
    const int *const user = all_edges.users(edge);
    for (int k = 1; k < edge.num_users; k++) {
      if (std::fabs(dot(normals[user[0]], normals[user[k]])) < TriangleMesh::smooth_cosine) continue;
      const int a = root(user[0]), b = root(user[k]);
      patch[std::max(a, b)] = std::min(a, b);
    }
  }
  for (int t = 0; t < mesh.size(); t++) patch[t] = root(t);
  return patch;
}

/* ---- others -------------------------------------------------------------------------------------- */

void MeshCheck::look_at_vertices()
{
  std::vector<Vector3<double>> mean(mesh.num_vertices(), {0.0, 0.0, 0.0});
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex) mean[v] = mean[v] + normals[t];
  is_fan.assign(mesh.num_vertices(), 0);
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex)
      if (!(dot(mean[v], normals[t]) > 0.0)) is_fan[v] = 1;
}

bool MeshCheck::cut(int a, int b) const
{
  int shared = 0;
  const int common = num_shared(mesh.corners(a), mesh.corners(b), shared);
  if (common > 1 || (common == 1 && !is_fan[shared])) return false;
  const Triangle first = triangle(*to, a), second = triangle(*to, b);
  const double size = length(first.corner[1] - first.corner[0]);
  return overlap(first, second, normals[a], normals[b], no_overlap * size);
}

/* Of all pairs the one with the lowest numbers, so that it does not depend on the tree. */

std::string MeshCheck::crossing()
{
  look_at_vertices();
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(mesh.num_own());
  for (int t = 0; t < mesh.num_own(); t++) boxes.push_back(bounds_of(triangle(*to, t)));
  if (!tree || tree->refit(boxes)) tree = std::make_unique<BoxTree>(boxes);
  std::array<int, 2> found{mesh.num_own(), mesh.num_own()};
  tree->visit_overlaps([&](int a, int b) {
    if ((!moved[a] && !moved[b]) || !boxes[a].intersects(boxes[b])) return;
    const std::array<int, 2> pair{std::min(a, b), std::max(a, b)};
    if (pair < found && cut(pair[0], pair[1])) found = pair;
  });
  if (found[0] == mesh.num_own()) return "";
  return name_of(found[0], *to) + " and " + name_of(found[1], *to) + " cut each other";
}

double MeshCheck::memory_usage() const
{
  return static_cast<double>(normals.capacity() * sizeof normals[0] + is_fan.capacity()) +
         (tree ? tree->memory_usage() : 0.0) +
         static_cast<double>(all_edges.all().size() * sizeof(MeshEdges::Edge)) + 24.0 * mesh.size();
}

}    // namespace Talus
