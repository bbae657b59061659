// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_check.h"

#include "base/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace Talus {
namespace {

constexpr double no_overlap = 1.0e-10;    // of triangles that touch, over the size of one
constexpr double parallel = 1.0e-16;      // the square of the sine

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

/* Separating axes of two triangles: the normals, and across the edges of both in space, or where these are
   nearly parallel or both triangles nearly in one plane, across those of one in its plane. */

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
    for (const Vector3<double> &of_b : edges[1]) {
      const Vector3<double> axis = cross(of_a, of_b);
      const bool is_direction = dot(axis, axis) > parallel * dot(of_a, of_a) * dot(of_b, of_b);
      if (is_direction && are_apart(axis, a, b, allowed)) return false;
    }
  return true;
}

int num_shared(const Corners &a, const Corners &b)
{
  int count = 0;
  for (const int v : a.vertex)
    for (const int w : b.vertex)
      if (v == w) count++;
  return count;
}

}    // namespace

MeshCheck::MeshCheck(const TriangleMesh &triangle_mesh) :
    mesh(triangle_mesh), all_edges(triangle_mesh.all_corners())
{
  int number = 0;
  for (const MeshEdges::Edge &edge : all_edges.all()) {
    const int *const user = all_edges.users(edge), this_edge = number++;
    for (int k = 1; k < edge.num_users; k++) at_edges.push_back({user[0], user[k]});
    if (edge.num_users != 2 || user[1] >= mesh.num_own()) continue;
    const bool opposed = mesh.corners(user[0]).runs_along(edge.vertex[0], edge.vertex[1]) ==
                         mesh.corners(user[1]).runs_along(edge.vertex[0], edge.vertex[1]);
    neighbors.push_back({user[0], user[1], this_edge, opposed});
  }
  around_begin.assign(mesh.num_vertices() + 1, 0);
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex) around_begin[v + 1]++;
  std::partial_sum(around_begin.begin(), around_begin.end(), around_begin.begin());
  around.resize(around_begin.back());
  std::vector<int> next(around_begin.begin(), around_begin.end() - 1);
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex) around[next[v]++] = t;
}

Triangle MeshCheck::triangle(const Places &places, int t) const
{
  const int *const v = mesh.corners(t).vertex;
  return {{places[v[0]], places[v[1]], places[v[2]]}};
}

std::string MeshCheck::name_of(int t, const Places &places) const
{
  const Vector3<double> &x = places[mesh.corners(t).vertex[0]];
  return "triangle " + std::to_string(t) + " (first corner at " + number_text(x.x) + " " +
         number_text(x.y) + " " + number_text(x.z) + ")";
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

/* Angle by which the second is folded against the first: 0 in one plane, > 0 away from the side of the
   normals; whatever way round the second is. */

double MeshCheck::fold(const Neighbors &pair, const Places &places) const
{
  const MeshEdges::Edge &edge = all_edges.all()[pair.edge];
  int from = edge.vertex[0], to_vertex = edge.vertex[1];
  if (!mesh.corners(pair.first).runs_along(from, to_vertex)) std::swap(from, to_vertex);
  const auto normal = [&](int t) {
    const Triangle at = triangle(places, t);
    const Vector3<double> twice = cross(at.corner[1] - at.corner[0], at.corner[2] - at.corner[0]);
    return 1.0 / length(twice) * twice;
  };
  const Vector3<double> n = normal(pair.first),
                        m = pair.opposed ? -normal(pair.second) : normal(pair.second);
  const Vector3<double> along = places[to_vertex] - places[from];
  return std::atan2(dot(cross(n, m), along) / length(along), dot(n, m));
}

std::string MeshCheck::turned_over(const Places &now) const
{
  const double quarter = 0.5 * std::acos(-1.0);
  for (const Neighbors &pair : neighbors) {
    const int a = pair.first, b = pair.second;
    const double cosine = dot(normals[a], normals[b]);
    if ((pair.opposed ? -cosine : cosine) >= 0.0 || (!moved[a] && !moved[b])) continue;
    if (std::fabs(fold(pair, *to) - fold(pair, now)) <= quarter) continue;
    const auto kept = [&](int t) {    // of its own direction
      const Triangle at = triangle(now, t);
      const Vector3<double> twice = cross(at.corner[1] - at.corner[0], at.corner[2] - at.corner[0]);
      return dot(normals[t], twice) / length(twice);
    };
    const int turned = kept(a) < kept(b) ? a : b, other = turned == a ? b : a;
    return name_of(turned, *to) + " has turned over against its neighbor, triangle " +
           std::to_string(other);
  }
  return "";
}

/* Triangles that share an edge are parts of one patch if it is smooth: see TriangleMesh::patch(). */

bool MeshCheck::patches_change()
{
  bool change = smooth.empty();
  smooth.resize(at_edges.size());
  for (std::size_t n = 0; n < at_edges.size(); n++) {
    const double cosine = dot(normals[at_edges[n][0]], normals[at_edges[n][1]]);
    const char is_smooth = std::fabs(cosine) >= TriangleMesh::smooth_cosine ? 1 : 0;
    change = change || smooth[n] != is_smooth;
    smooth[n] = is_smooth;
  }
  return change;
}

std::vector<int> MeshCheck::patches() const
{
  std::vector<int> patch(mesh.size());
  std::iota(patch.begin(), patch.end(), 0);
  const auto root = [&patch](int t) {
    while (patch[t] != t) t = patch[t] = patch[patch[t]];
    return t;
  };
  for (std::size_t n = 0; n < at_edges.size(); n++) {
    if (!smooth[n]) continue;
    const int a = root(at_edges[n][0]), b = root(at_edges[n][1]);
    patch[std::max(a, b)] = std::min(a, b);
  }
  for (int t = 0; t < mesh.size(); t++) patch[t] = root(t);
  return patch;
}

/* ---- others -------------------------------------------------------------------------------------- */

void MeshCheck::look_at_vertices()
{
  is_fan.assign(mesh.num_vertices(), 0);
  Vector3<double> most{0.0, 0.0, 0.0};
  for (int t = 0; t < mesh.num_own(); t++) most = most + normals[t];
  const bool all_face_it =
      std::all_of(normals.begin(), normals.begin() + mesh.num_own(),
                  [&](const Vector3<double> &n) { return dot(n, most) > 0.0; });
  if (all_face_it) return;
  std::vector<Vector3<double>> mean(mesh.num_vertices(), {0.0, 0.0, 0.0});
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex) mean[v] = mean[v] + normals[t];
  for (int t = 0; t < mesh.num_own(); t++)
    for (const int v : mesh.corners(t).vertex)
      if (!(dot(mean[v], normals[t]) > 0.0)) is_fan[v] = 1;
}

/* Pairs that share one vertex with which not all triangles around it face one half of space. */

template <class Visit> void MeshCheck::visit_fans(Visit visit) const
{
  for (int v = 0; v < mesh.num_vertices(); v++) {
    if (!is_fan[v]) continue;
    for (int k = around_begin[v]; k < around_begin[v + 1]; k++)
      for (int l = k + 1; l < around_begin[v + 1]; l++)
        if (num_shared(mesh.corners(around[k]), mesh.corners(around[l])) == 1)
          visit(around[k], around[l]);
  }
}

bool MeshCheck::cut(int a, int b) const
{
  const Triangle first = triangle(*to, a), second = triangle(*to, b);
  const double size = length(first.corner[1] - first.corner[0]);
  return overlap(first, second, normals[a], normals[b], no_overlap * size);
}

bool MeshCheck::list_holds() const
{
  if (listed_at.empty()) return false;
  Vector3<double> together{0.0, 0.0, 0.0};
  const int count = mesh.num_own_vertices();
  for (int v = 0; v < count; v++) together = together + ((*to)[v] - listed_at[v]);
  together = 1.0 / count * together;
  double square = 0.0;
  for (int v = 0; v < count; v++) {
    const Vector3<double> apart = (*to)[v] - listed_at[v] - together;
    square = std::max(square, dot(apart, apart));
  }
  return 2.0 * std::sqrt(square) < (1.0 - 1.0e-9) * margin;
}

/* The distance is small, so that the list is short, and large beside the way of vertices in an exchange. */

void MeshCheck::list_pairs()
{
  constexpr double over_size = 0.3;
  double area = 0.0;
  for (const Eigen::AlignedBox3d &box : boxes) area += box.sizes().squaredNorm();
  margin = over_size * std::sqrt(0.5 * area / static_cast<double>(boxes.size()));
  std::vector<Eigen::AlignedBox3d> wide = boxes;
  const Eigen::Vector3d around_box = Eigen::Vector3d::Constant(0.5 * margin);
  for (Eigen::AlignedBox3d &box : wide) box = {box.min() - around_box, box.max() + around_box};
  if (!tree || tree->refit(wide)) tree = std::make_unique<BoxTree>(wide);
  pairs.clear();
  tree->visit_overlaps([&](int a, int b) {
    if (wide[a].intersects(wide[b]) && !num_shared(mesh.corners(a), mesh.corners(b)))
      pairs.push_back({std::min(a, b), std::max(a, b)});
  });
  std::sort(pairs.begin(), pairs.end());
  listed_at = *to;
}

/* The pair with the lowest numbers. */

std::string MeshCheck::crossing()
{
  boxes.clear();
  for (int t = 0; t < mesh.num_own(); t++) boxes.push_back(bounds_of(triangle(*to, t)));
  if (!list_holds()) list_pairs();
  look_at_vertices();
  std::array<int, 2> found{mesh.num_own(), mesh.num_own()};
  // triangles whose boxes only touch do not cut each other
  const auto overlap = [this](int a, int b) {
    return (boxes[a].min().array() < boxes[b].max().array()).all() &&
           (boxes[b].min().array() < boxes[a].max().array()).all();
  };
  const auto look = [&](int a, int b) {
    if ((moved[a] || moved[b]) && overlap(a, b) && cut(a, b))
      found = std::min(found, std::array<int, 2>{a, b});
  };
  for (const std::array<int, 2> &pair : pairs) look(pair[0], pair[1]);
  visit_fans(look);
  if (found[0] == mesh.num_own()) return "";
  return name_of(found[0], *to) + " and " + name_of(found[1], *to) + " cut each other";
}

double MeshCheck::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  return bytes(normals) + bytes(neighbors) + bytes(at_edges) + bytes(boxes) + bytes(pairs) +
         bytes(listed_at) + bytes(around) + bytes(around_begin) +
         (tree ? tree->memory_usage() : 0.0) + bytes(all_edges.all()) +
         24.0 * mesh.size();    // the rest of the edges
}

}    // namespace Talus
