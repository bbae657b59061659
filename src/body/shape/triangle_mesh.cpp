// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/triangle_mesh.h"

#include "body/shape/mesh_interior.h"
#include "body/shape/mesh_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

namespace Talus {
namespace {

// Corners are in one plane if they are as near to it as rounding of the coordinates leaves them;
// over the extent of the mesh.
constexpr double plane_tolerance = 1.0e-12;

void note(int &count, int &first, int number)
{
  if (count++ == 0) first = number + 1;
}

double usual_tolerance_of(const std::vector<Triangle> &soup)
{
  Eigen::AlignedBox3d box;
  for (const Triangle &t : soup) box.extend(bounds_of(t));
  return soup.empty() ? 0.0 : TriangleMesh::usual_tolerance * length(from_eigen(box.sizes()));
}

/// Thinner than rounding leaves a direction to the normal.
bool has_no_area(const Vector3<double> &p, const Vector3<double> &q, const Vector3<double> &r)
{
  const Vector3<double> a = q - p, b = r - p, c = r - q;
  const double longest = std::max({length(a), length(b), length(c)});
  return !(length(cross(a, b)) > 1.0e-12 * longest * longest);
}

}    // namespace

Eigen::AlignedBox3d bounds_of(const Triangle &t)
{
  Eigen::AlignedBox3d box;
  for (const Vector3<double> &p : t.corner) box.extend(to_eigen(p));
  return box;
}

TriangleMesh::TriangleMesh(const std::vector<Triangle> &soup, bool to_orient) :
    TriangleMesh(soup, to_orient, usual_tolerance_of(soup))
{
}

TriangleMesh::TriangleMesh(const std::vector<Triangle> &soup, bool to_orient, double tolerance)
{
  joins_within = tolerance;
  join_corners(soup, tolerance);
  if (triangles.empty()) throw std::runtime_error("all its triangles are without area");
  if (tolerance > 0.0) join_edges(tolerance);
  vertices.shrink_to_fit();
  triangles.shrink_to_fit();
  if (triangles.size() == soup.size() && !findings.divided_edges) file_numbers.clear();
  file_numbers.shrink_to_fit();
  for (const Vector3<double> &p : vertices) extent.extend(to_eigen(p));
  if (to_orient) orient(MeshEdges(triangles));
  look_at_edges(MeshEdges(triangles));
  find_smooth_parts();
  find_volume();
}

void TriangleMesh::find_smooth_parts()
{
  const MeshEdges edges(triangles);
  find_patches(edges);
  find_planes(edges);
  find_hollows(edges);
}

void TriangleMesh::continue_behind(const PeriodicEdges &edges)
{
  const std::array<bool, 3> ended = edges.ended(extent);
  if (!ended[0] && !ended[1] && !ended[2]) return;
  MeshVertices joined(joins_within);
  for (const Vector3<double> &p : vertices) joined.at(p);    // in their order: the same numbers
  const MeshImages behind = images_behind_faces(joined, triangles, edges.box, ended);
  vertices = joined.all();
  triangles.insert(triangles.end(), behind.triangles.begin(), behind.triangles.end());
  images = behind.own;
  vertex_images = behind.vertices;
  for (const Vector3<double> &p : vertices) extent.extend(to_eigen(p));
  find_smooth_parts();
}

void TriangleMesh::join_corners(const std::vector<Triangle> &soup, double tolerance)
{
  MeshVertices joined(tolerance);
  std::set<std::array<int, 3>> seen;
  triangles.reserve(soup.size());
  for (std::size_t n = 0; n < soup.size(); n++) {
    const int number = static_cast<int>(n);
    const Vector3<double> *p = soup[n].corner;
    if (has_no_area(p[0], p[1], p[2])) {
      note(findings.degenerate, findings.first_degenerate, number);
      continue;
    }
    const Corners corners{{joined.at(p[0]), joined.at(p[1]), joined.at(p[2])}};
    const auto place = [&](int k) { return joined.all()[corners.vertex[k]]; };
    if (has_no_area(place(0), place(1), place(2))) {
      note(findings.degenerate, findings.first_degenerate, number);
      continue;
    }
    std::array<int, 3> sorted{corners.vertex[0], corners.vertex[1], corners.vertex[2]};
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second) {
      note(findings.duplicate, findings.first_duplicate, number);
      continue;
    }
    triangles.push_back(corners);
    file_numbers.push_back(number);
  }
  vertices = joined.all();
  findings.joined_corners = joined.num_joined();
  findings.largest_gap = joined.largest_gap();
}

void TriangleMesh::join_edges(double tolerance)
{
  DividedTriangles parts = divide_at_vertices(triangles, vertices, tolerance);
  if (!parts.edges) return;
  findings.divided_edges = parts.edges;
  findings.first_divided = file_numbers[parts.first] + 1;
  std::vector<int> numbers;
  for (const int t : parts.divided) numbers.push_back(file_numbers[t]);
  triangles = std::move(parts.triangles);
  file_numbers = std::move(numbers);
}

Vector3<double> TriangleMesh::normal(int t) const
{
  const Triangle face = triangle(t);
  const Vector3<double> twice =
      cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
  return 1.0 / length(twice) * twice;
}

double TriangleMesh::area(int t) const
{
  const Triangle face = triangle(t);
  return 0.5 * length(cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]));
}

void TriangleMesh::orient(const MeshEdges &edges)
{
  look_at_edges(edges);
  const MeshReport before = findings;
  std::vector<int> part(triangles.size(), -1);
  int num_parts = 0;
  for (int first = 0; first < size(); first++)
    if (part[first] < 0) orient_along(first, num_parts++, edges, part);
  const auto forget = [this] {
    findings.open_edges = findings.nonmanifold_edges = findings.inconsistent_edges = 0;
  };
  forget();
  look_at_edges(MeshEdges(triangles));
  findings.repaired_edges = before.inconsistent_edges - findings.inconsistent_edges;
  findings.first_repaired = before.first_inconsistent;
  if (findings.closed()) orient_parts(part, num_parts);
  forget();
}

/* From a triangle over its edges to all that are connected with it: each is turned if it faces the
   other side. Where edges belong to more than two triangles, parts end. */

void TriangleMesh::orient_along(int first, int number, const MeshEdges &edges,
                                std::vector<int> &part)
{
  std::vector<int> to_do(1, first);
  part[first] = number;
  while (!to_do.empty()) {
    const int t = to_do.back();
    to_do.pop_back();
    for (int k = 0; k < 3; k++) {    // the edges know corners as they were before any turn
      const MeshEdges::Edge &edge = edges.of(t, k);
      if (edge.num_users != 2) continue;
      const int *user = edges.users(edge);
      const int other = user[0] == t ? user[1] : user[0];
      if (part[other] >= 0) continue;
      const int a = edge.vertex[0], b = edge.vertex[1];
      if (triangles[other].runs_along(a, b) == triangles[t].runs_along(a, b)) flip(other);
      part[other] = number;
      to_do.push_back(other);
    }
  }
}

/* Parts of a closed mesh: all as the first. Parts may go through each other, such as a paddle
   through the wall of a drum, so that some of a part is where nothing is: the side is that of most
   of its area, looked at in some 30 points or more. */

void TriangleMesh::orient_parts(const std::vector<int> &part, int num_parts)
{
  constexpr double fineness = 64.0, aside = 1.0e-6;    // over the size of a triangle
  const MeshInterior interior(*this);
  std::vector<double> whole(num_parts), facing_out(num_parts);
  for (int t = 0; t < size(); t++) whole[part[t]] += area(t);
  for (int t = 0; t < size(); t++) {
    const Triangle face = triangle(t);
    const double surface = area(t);
    const Vector3<double> start = face.corner[0] + aside * std::sqrt(surface) * normal(t);
    const Vector3<double> u = face.corner[1] - face.corner[0], v = face.corner[2] - face.corner[0];
    const int cuts = static_cast<int>(std::ceil(std::sqrt(fineness * surface / whole[part[t]])));
    const double share = 2.0 * surface / (cuts * (cuts + 1));
    for (int i = 0; i < cuts; i++)
      for (int j = 0; i + j < cuts; j++) {
        const Vector3<double> x = start + (i + 1.0 / 3.0) / cuts * u + (j + 1.0 / 3.0) / cuts * v;
        facing_out[part[t]] += interior.contains(x) ? -share : share;
      }
  }
  outward = facing_out[0] >= 0.0;
  for (int t = 0; t < size(); t++)
    if ((facing_out[part[t]] >= 0.0) != outward) flip(t);
}

void TriangleMesh::look_at_edges(const MeshEdges &edges)
{
  for (const MeshEdges::Edge &e : edges.all()) {
    const int *user = edges.users(e);
    if (e.num_users == 1) findings.open_edges++;
    if (e.num_users > 2)
      note(findings.nonmanifold_edges, findings.first_nonmanifold, number_in_file(user[2]));
    if (e.num_users == 2 && triangles[user[0]].runs_along(e.vertex[0], e.vertex[1]) ==
                                triangles[user[1]].runs_along(e.vertex[0], e.vertex[1]))
      note(findings.inconsistent_edges, findings.first_inconsistent, number_in_file(user[1]));
  }
}

void TriangleMesh::find_patches(const MeshEdges &edges)
{
  patches.resize(triangles.size());
  std::iota(patches.begin(), patches.end(), 0);
  const auto root = [this](int t) {
    while (patches[t] != t) t = patches[t] = patches[patches[t]];
    return t;
  };
  for (const MeshEdges::Edge &e : edges.all())
    for (int k = 1; k < e.num_users; k++) {
      const int a = edges.users(e)[0], b = edges.users(e)[k];
      if (std::fabs(dot(normal(a), normal(b))) < smooth_cosine) continue;
      const int low = std::min(root(a), root(b)), high = std::max(root(a), root(b));
      patches[high] = low;
    }
  for (int t = 0; t < size(); t++) patches[t] = root(t);
}

void TriangleMesh::find_hollows(const MeshEdges &edges)
{
  for (const MeshEdges::Edge &e : edges.all()) {
    if (e.num_users != 2) continue;
    const int a = edges.users(e)[0], b = edges.users(e)[1];
    if (patches[a] != patches[b] || planes[a] == planes[b]) continue;
    const Vector3<double> n = normal(a), from = vertices[triangles[a].vertex[0]];
    double height = 0.0;    // of the corner of b that is not on the edge
    for (const int v : triangles[b].vertex) {
      const double above = dot(vertices[v] - from, n);
      if (std::fabs(above) > std::fabs(height)) height = above;
    }
    const bool opposed = dot(n, normal(b)) < 0.0;
    if (height > 0.0 || opposed) hollow[0] = true;
    if (height < 0.0 || opposed) hollow[1] = true;
  }
}

/* From each triangle that is in no plane yet over its edges to all that are in its own: the plane
   is always that of the first, so that errors do not add up. */

void TriangleMesh::find_planes(const MeshEdges &edges)
{
  planes.assign(triangles.size(), -1);
  std::vector<int> to_do;
  for (int first = 0; first < size(); first++)
    if (planes[first] < 0) spread_plane(first, edges, to_do);
}

void TriangleMesh::separate_planes()
{
  std::iota(planes.begin(), planes.end(), 0);
}

void TriangleMesh::spread_plane(int first, const MeshEdges &edges, std::vector<int> &to_do)
{
  const double allowed = plane_tolerance * length(from_eigen(extent.sizes()));
  const Vector3<double> n = normal(first), origin = vertices[triangles[first].vertex[0]];
  planes[first] = first;
  to_do.assign(1, first);
  while (!to_do.empty()) {
    const int t = to_do.back();
    to_do.pop_back();
    for (int k = 0; k < 3; k++) {
      const MeshEdges::Edge &edge = edges.of(t, k);
      if (edge.num_users != 2) continue;
      const int *user = edges.users(edge);
      const int other = user[0] == t ? user[1] : user[0];
      if (planes[other] >= 0 || dot(normal(other), n) < 0.999999) continue;
      const int *v = triangles[other].vertex;
      const bool is_flat = std::all_of(v, v + 3, [&](int corner) {
        return std::fabs(dot(vertices[corner] - origin, n)) <= allowed;
      });
      if (!is_flat) continue;
      planes[other] = first;
      to_do.push_back(other);
    }
  }
}

void TriangleMesh::find_volume()
{
  const Vector3<double> origin = vertices[0];
  Vector3<double> by_volume{0.0, 0.0, 0.0}, by_area{0.0, 0.0, 0.0};
  double total = 0.0, volume = 0.0;
  for (int t = 0; t < size(); t++) {
    const Triangle tri = triangle(t);
    const Vector3<double> a = tri.corner[0] - origin, b = tri.corner[1] - origin,
                          c = tri.corner[2] - origin;
    const double v = dot(a, cross(b, c)) / 6.0;
    volume += v;
    by_volume = by_volume + 0.25 * v * (a + b + c);
    const double triangle_area = area(t);
    total += triangle_area;
    by_area = by_area + (triangle_area / 3.0) * (a + b + c);
  }
  const bool has_volume = findings.closed() && std::fabs(volume) > 1.0e-12 * std::pow(total, 1.5);
  enclosed = has_volume ? volume : 0.0;
  middle = origin + (has_volume ? 1.0 / volume * by_volume : 1.0 / total * by_area);
}

double TriangleMesh::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  return bytes(vertices) + bytes(triangles) + bytes(patches) + bytes(planes) + bytes(file_numbers) +
         bytes(images) + bytes(vertex_images);
}

}    // namespace Talus
