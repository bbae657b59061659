// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_seams.h"

#include "base/linear_algebra.h"
#include "body/shape/box_tree.h"

#include <algorithm>
#include <cmath>

namespace Talus {

int MeshVertices::at(const Vector3<double> &p)
{
  const std::array<double, 3> key{p.x + 0.0, p.y + 0.0, p.z + 0.0};    // -0 is 0
  const auto [place, is_new] = places.try_emplace(key, 0);
  if (is_new) place->second = near(p);
  return place->second;
}

MeshVertices::Cell MeshVertices::cell_of(const Vector3<double> &p) const
{
  return {std::llround(p.x / allowed), std::llround(p.y / allowed), std::llround(p.z / allowed)};
}

/* Of several vertices that are near enough, the first: a chain of them does not become one. */

int MeshVertices::near(const Vector3<double> &p)
{
  const int number = static_cast<int>(vertices.size());
  if (!(allowed > 0.0)) {
    vertices.push_back(p);
    return number;
  }
  const Cell cell = cell_of(p);
  int first = number;
  for (int k = 0; k < 27; k++) {
    const auto found =
        cells.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
    if (found == cells.end()) continue;
    for (const int v : found->second)
      if (v < first && length(vertices[v] - p) <= allowed) first = v;
  }
  if (first < number) {
    joined++;
    gap = std::max(gap, length(vertices[first] - p));
    return first;
  }
  vertices.push_back(p);
  cells[cell].push_back(number);
  return number;
}

namespace {

/// Divides triangles at vertices on their edges, one after the other: each vertex is joined with the
/// corner across.
class Divider {
 public:
  /// Of each edge (from corner k to the next) the vertices on it, in this direction.
  using OnEdges = std::array<std::vector<int>, 3>;

  explicit Divider(std::vector<Corners> &parts) : parts(parts) {}

  void divide(const Corners &whole, const OnEdges &on)
  {
    int k = 0;
    while (k < 3 && on[k].empty()) k++;
    if (k == 3) {
      parts.push_back(whole);
      return;
    }
    const int next = (k + 1) % 3, across = (k + 2) % 3;
    const auto middle = on[k].begin() + static_cast<std::ptrdiff_t>(on[k].size() / 2);
    const int v = *middle;
    divide({{whole.vertex[k], v, whole.vertex[across]}},
           {{{on[k].begin(), middle}, {}, on[across]}});
    divide({{v, whole.vertex[next], whole.vertex[across]}},
           {{{middle + 1, on[k].end()}, on[next], {}}});
  }

 private:
  std::vector<Corners> &parts;
};

/// Edges of one triangle only, and the vertices that lie on them.
class OpenEdges {
 public:
  OpenEdges(const std::vector<Corners> &triangles, const std::vector<Vector3<double>> &vertices,
            double tolerance) :
      triangles(triangles),
      vertices(vertices), tolerance(tolerance), edges(triangles)
  {
    std::vector<bool> seen(vertices.size());
    for (const MeshEdges::Edge &edge : edges.all()) {
      if (edge.num_users != 1) continue;
      open.push_back(&edge);
      for (const int v : edge.vertex) seen[v] = true;
    }
    for (std::size_t v = 0; v < seen.size(); v++)
      if (seen[v]) ends.push_back(static_cast<int>(v));
    on.resize(open.size());
    if (!open.empty()) find_vertices();
  }

  /// How many have a vertex on them.
  int num_interrupted() const
  {
    return static_cast<int>(
        std::count_if(on.begin(), on.end(), [](const auto &some) { return !some.empty(); }));
  }
  /// Calls visit(triangle, k, vertices on edge k from its first corner on) for each of them.
  template <class Visit> void each_interrupted(Visit visit) const
  {
    for (std::size_t n = 0; n < open.size(); n++) {
      if (on[n].empty()) continue;
      const int t = *edges.users(*open[n]);
      int k = 0;
      while (&edges.of(t, k) != open[n]) k++;
      std::vector<int> in_order;
      for (const auto &one : on[n]) in_order.push_back(one.second);
      if (triangles[t].vertex[k] != open[n]->vertex[0])
        std::reverse(in_order.begin(), in_order.end());
      visit(t, k, in_order);
    }
  }

 private:
  void find_vertices()
  {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const MeshEdges::Edge *edge : open) {
      Eigen::AlignedBox3d box(to_eigen(vertices[edge->vertex[0]]));
      boxes.push_back(box.extend(to_eigen(vertices[edge->vertex[1]])));
    }
    const BoxTree tree(boxes);
    for (const int v : ends)
      tree.visit_near(vertices[v], 2.0 * tolerance, [&](int n) { add_if_on(n, v); });
    for (auto &some : on) std::sort(some.begin(), some.end());
  }

  void add_if_on(int n, int v)
  {
    const int a = open[n]->vertex[0], b = open[n]->vertex[1];
    const int *const own = triangles[*edges.users(*open[n])].vertex;
    if (std::find(own, own + 3, v) != own + 3) return;
    const Vector3<double> along = vertices[b] - vertices[a], away = vertices[v] - vertices[a];
    const double part = dot(along, away) / dot(along, along);
    if (part > 0.0 && part < 1.0 && length(away - part * along) <= tolerance)
      on[n].emplace_back(part, v);
  }

  const std::vector<Corners> &triangles;
  const std::vector<Vector3<double>> &vertices;
  const double tolerance;
  const MeshEdges edges;
  std::vector<const MeshEdges::Edge *> open;
  std::vector<int> ends;
  std::vector<std::vector<std::pair<double, int>>> on;    // share of the way from the lower end
};

}    // namespace

DividedTriangles divide_at_vertices(const std::vector<Corners> &triangles,
                                    const std::vector<Vector3<double>> &vertices, double tolerance)
{
  const OpenEdges open(triangles, vertices, tolerance);
  DividedTriangles result;
  result.edges = open.num_interrupted();
  std::unordered_map<int, Divider::OnEdges> of_triangle;
  open.each_interrupted([&](int t, int k, const std::vector<int> &on) {
    of_triangle[t][k] = on;
    result.first = result.first < 0 ? t : std::min(result.first, t);
  });
  Divider divider(result.triangles);
  for (std::size_t t = 0; t < triangles.size(); t++) {
    const auto on = of_triangle.find(static_cast<int>(t));
    divider.divide(triangles[t], on == of_triangle.end() ? Divider::OnEdges{} : on->second);
    result.divided.resize(result.triangles.size(), static_cast<int>(t));
  }
  return result;
}

}    // namespace Talus
