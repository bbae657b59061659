// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace Talus {
namespace {

// So near to parallel or perpendicular that rounding decides. Contacts that are counted twice
// because of it have the same normal and are merged.
constexpr double tolerance = 1.0e-10;

double length(const Vector3<double> &v)
{
  return std::sqrt(dot(v, v));
}

/// Does a step in the direction `along` from the nearest point come nearer?
bool comes_nearer(const Vector3<double> &away, const Vector3<double> &along)
{
  return dot(away, along) > tolerance * length(away) * length(along);
}

void note(int &count, int &first, int number)
{
  if (count++ == 0) first = number + 1;
}

struct CoordinateHash {
  std::size_t operator()(const std::array<double, 3> &x) const
  {
    std::size_t h = 0;
    for (const double c : x) h = 1000003 * h + std::hash<double>{}(c);
    return h;
  }
};

}    // namespace

TriangleMesh::TriangleMesh(const std::vector<Triangle> &soup)
{
  join_corners(soup);
  if (triangles.empty()) throw std::runtime_error("all its triangles are without area");
  vertices.shrink_to_fit();
  find_edges();
  edges.shrink_to_fit();
  edge_users.shrink_to_fit();
  find_patches();
  find_rings();
  prepare_faces();
  find_volume();
}

void TriangleMesh::join_corners(const std::vector<Triangle> &soup)
{
  std::unordered_map<std::array<double, 3>, int, CoordinateHash> known;
  std::set<std::array<int, 3>> seen;
  const auto vertex_at = [&](const Vector3<double> &p) {
    const std::array<double, 3> key{p.x + 0.0, p.y + 0.0, p.z + 0.0};    // -0 is 0
    const auto [place, is_new] = known.try_emplace(key, static_cast<int>(vertices.size()));
    if (is_new) vertices.push_back(p);
    return place->second;
  };
  triangles.reserve(soup.size());
  faces.reserve(soup.size());
  areas.reserve(soup.size());
  file_numbers.reserve(soup.size());
  for (std::size_t n = 0; n < soup.size(); n++) {
    const int number = static_cast<int>(n);
    const Vector3<double> *p = soup[n].corner;
    const Vector3<double> a = p[1] - p[0], b = p[2] - p[0], c = p[2] - p[1];
    const Vector3<double> twice = cross(a, b);
    const double longest = std::max({length(a), length(b), length(c)});
    // thinner than rounding leaves a direction to the normal
    if (!(length(twice) > 1.0e-12 * longest * longest)) {
      note(findings.degenerate, findings.first_degenerate, number);
      continue;
    }
    const Corners corners{{vertex_at(p[0]), vertex_at(p[1]), vertex_at(p[2])}};
    std::array<int, 3> sorted{corners.vertex[0], corners.vertex[1], corners.vertex[2]};
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second) {
      note(findings.duplicate, findings.first_duplicate, number);
      continue;
    }
    triangles.push_back(corners);
    file_numbers.push_back(number);
    faces.push_back({soup[n], 1.0 / length(twice) * twice, {0.0F, 0.0F, 0.0F}, 0, 0});
    areas.push_back(0.5 * length(twice));
  }
}

bool TriangleMesh::runs_along(int t, int from, int to) const
{
  for (int k = 0; k < 3; k++)
    if (triangles[t].vertex[k] == from && triangles[t].vertex[(k + 1) % 3] == to) return true;
  return false;
}

void TriangleMesh::find_edges()
{
  struct Side {
    int low, high, triangle, index;
  };
  std::vector<Side> sides;
  for (int t = 0; t < size(); t++)
    for (int k = 0; k < 3; k++) {
      const int a = triangles[t].vertex[k], b = triangles[t].vertex[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
    return std::tie(a.low, a.high, a.triangle, a.index) <
           std::tie(b.low, b.high, b.triangle, b.index);
  });

  edges_of.resize(triangles.size());
  for (std::size_t n = 0; n < sides.size(); n++) {
    const Side &s = sides[n];
    const bool is_new = n == 0 || s.low != sides[n - 1].low || s.high != sides[n - 1].high;
    if (is_new) edges.push_back({{s.low, s.high}, static_cast<int>(edge_users.size()), 0});
    edges.back().num_users++;
    edge_users.push_back(s.triangle);
    edges_of[s.triangle].vertex[s.index] = static_cast<int>(edges.size()) - 1;
  }

  for (const Edge &e : edges) {
    const int *user = &edge_users[e.first_user];
    if (e.num_users == 1) findings.open_edges++;
    if (e.num_users > 2)
      note(findings.crowded_edges, findings.first_crowded, file_numbers[user[2]]);
    if (e.num_users == 2 && runs_along(user[0], e.vertex[0], e.vertex[1]) ==
                                runs_along(user[1], e.vertex[0], e.vertex[1]))
      note(findings.turned_edges, findings.first_turned, file_numbers[user[1]]);
  }
}

void TriangleMesh::find_patches()
{
  patches.resize(triangles.size());
  std::iota(patches.begin(), patches.end(), 0);
  const auto root = [this](int t) {
    while (patches[t] != t) t = patches[t] = patches[patches[t]];
    return t;
  };
  for (const Edge &e : edges)
    for (int k = 1; k < e.num_users; k++) {
      const int a = edge_users[e.first_user], b = edge_users[e.first_user + k];
      if (std::fabs(dot(faces[a].normal, faces[b].normal)) < smooth_cosine) continue;
      const int low = std::min(root(a), root(b)), high = std::max(root(a), root(b));
      patches[high] = low;
    }
  for (int t = 0; t < size(); t++) patches[t] = root(t);
}

void TriangleMesh::find_rings()
{
  const std::size_t n = vertices.size();
  ring_begin.assign(n + 1, 0);
  for (const Edge &e : edges)
    for (const int v : e.vertex) ring_begin[v + 1]++;
  std::partial_sum(ring_begin.begin(), ring_begin.end(), ring_begin.begin());
  ring.resize(ring_begin[n]);
  std::vector<int> next(ring_begin.begin(), ring_begin.end() - 1);
  for (const Edge &e : edges) {
    ring[next[e.vertex[0]]++] = e.vertex[1];
    ring[next[e.vertex[1]]++] = e.vertex[0];
  }

  first_user.assign(n, -1);
  vertex_normals.assign(n, {0.0, 0.0, 0.0});
  for (int t = 0; t < size(); t++)
    for (int k = 0; k < 3; k++) {
      const int *v = triangles[t].vertex;
      const Vector3<double> a = vertices[v[(k + 1) % 3]] - vertices[v[k]],
                            b = vertices[v[(k + 2) % 3]] - vertices[v[k]];
      const double angle = std::atan2(length(cross(a, b)), dot(a, b));
      vertex_normals[v[k]] = vertex_normals[v[k]] + angle * faces[t].normal;
      if (first_user[v[k]] < 0) first_user[v[k]] = t;
    }
}

/* Over an edge of two triangles the direction to a point that is nearest to the edge lies between
   both normals (or their opposites). */

void TriangleMesh::prepare_faces()
{
  for (int t = 0; t < size(); t++)
    for (int k = 0; k < 3; k++) {
      Face &face = faces[t];
      const Edge &edge = edges[edges_of[t].vertex[k]];
      const int *user = &edge_users[edge.first_user];
      if (user[0] == t) face.reports_edge |= static_cast<unsigned char>(1U << k);
      if (first_user[triangles[t].vertex[k]] == t)
        face.reports_corner |= static_cast<unsigned char>(1U << k);
      if (edge.num_users != 2) continue;
      const double cosine = dot(faces[user[0]].normal, faces[user[1]].normal);
      // less by far more than rounding
      if (cosine > 0.0)
        face.least_square_cosine[k] = static_cast<float>(std::max(cosine * cosine - 1.0e-5, 0.0));
    }
}

void TriangleMesh::find_volume()
{
  const Vector3<double> origin = vertices[0];
  Vector3<double> by_volume{0.0, 0.0, 0.0}, by_area{0.0, 0.0, 0.0};
  double area = 0.0, volume = 0.0;
  for (int t = 0; t < size(); t++) {
    const Triangle &tri = triangle(t);
    const Vector3<double> a = tri.corner[0] - origin, b = tri.corner[1] - origin,
                          c = tri.corner[2] - origin;
    const double v = dot(a, cross(b, c)) / 6.0;
    volume += v;
    by_volume = by_volume + 0.25 * v * (a + b + c);
    area += areas[t];
    by_area = by_area + (areas[t] / 3.0) * (a + b + c);
  }
  const bool has_volume = findings.closed() && std::fabs(volume) > 1.0e-12 * std::pow(area, 1.5);
  enclosed = has_volume ? volume : 0.0;
  middle = origin + (has_volume ? 1.0 / volume * by_volume : 1.0 / area * by_area);
}

/* Corners first, then edges, then the face: regions of the plane around a triangle in which the
   nearest point is of that kind, by the signs of projections (Ericson, Real-Time Collision
   Detection, 2005, section 5.1.5). */

NearestPoint TriangleMesh::nearest(int t, const Vector3<double> &p) const
{
  const Vector3<double> *const corner = faces[t].corners.corner;
  const Vector3<double> &n = faces[t].normal;
  const Vector3<double> from[3] = {p - corner[0], p - corner[1], p - corner[2]};
  const auto result = [](const Vector3<double> &away, NearestPoint::Feature feature, int index) {
    return NearestPoint{away, dot(away, away), feature, index};
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
    if (dot(cross(edge, from[k]), n) > 0.0) continue;    // inside of it
    return result(from[k] - ahead[k] / (ahead[k] + behind[k]) * edge, NearestPoint::EDGE, k);
  }
  return result(dot(from[0], n) * n, NearestPoint::FACE, 0);
}

bool TriangleMesh::is_local_minimum(int t, const NearestPoint &nearest, double &height) const
{
  if (nearest.feature == NearestPoint::EDGE) return edge_is_minimum(t, nearest, height);
  if (nearest.feature == NearestPoint::CORNER) return corner_is_minimum(t, nearest, height);
  height = dot(nearest.away, faces[t].normal);
  return true;
}

int TriangleMesh::opposite(int t, const Edge &edge) const
{
  for (const int v : triangles[t].vertex)
    if (v != edge.vertex[0] && v != edge.vertex[1]) return v;
  return triangles[t].vertex[0];
}

bool TriangleMesh::edge_is_minimum(int t, const NearestPoint &nearest, double &height) const
{
  const Face &face = faces[t];
  if (!(face.reports_edge >> nearest.index & 1)) return false;
  const double above = dot(nearest.away, face.normal);
  if (above * above < face.least_square_cosine[nearest.index] * nearest.square) return false;
  const Edge &edge = edges[edges_of[t].vertex[nearest.index]];
  const int *user = &edge_users[edge.first_user];
  Vector3<double> outward{0.0, 0.0, 0.0};
  for (int k = 0; k < edge.num_users; k++) {
    const int other = opposite(user[k], edge);
    if (comes_nearer(nearest.away, vertices[other] - vertices[edge.vertex[0]])) return false;
    outward = outward + faces[user[k]].normal;
  }
  height = dot(nearest.away, outward);
  return true;
}

bool TriangleMesh::corner_is_minimum(int t, const NearestPoint &nearest, double &height) const
{
  if (!(faces[t].reports_corner >> nearest.index & 1)) return false;
  const int v = triangles[t].vertex[nearest.index];
  for (int k = ring_begin[v]; k < ring_begin[v + 1]; k++)
    if (comes_nearer(nearest.away, vertices[ring[k]] - vertices[v])) return false;
  height = dot(nearest.away, vertex_normals[v]);
  return true;
}

double TriangleMesh::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  return bytes(vertices) + bytes(faces) + bytes(triangles) + bytes(edges_of) + bytes(areas) +
         bytes(patches) + bytes(file_numbers) + bytes(edges) + bytes(edge_users) +
         bytes(ring_begin) + bytes(ring) + bytes(first_user) + bytes(vertex_normals);
}

}    // namespace Talus
