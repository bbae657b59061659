// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_detail.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Talus {
namespace {

// So near to parallel or perpendicular that rounding decides. Contacts that are counted twice
// because of it have the same normal and are merged.
constexpr double tolerance = 1.0e-10;
// Limits of cosines are lowered by far more than rounding.
constexpr double slack = 1.0e-5;

/// Does a step in the direction `along` from the nearest point come nearer?
bool comes_nearer(const Vector3<double> &away, const Vector3<double> &along)
{
  return dot(away, along) > tolerance * length(away) * length(along);
}

}    // namespace

MeshDetail::MeshDetail(const TriangleMesh &triangle_mesh, const Eigen::AlignedBox3d &cover) :
    mesh(triangle_mesh)
{
  const std::vector<int> numbers = members(cover);
  if (numbers.empty()) return;
  make_faces(numbers);
  find_vertices(numbers);
  const MeshEdges edges(corners);
  find_neighbors(edges);
  find_rings(edges);
  look_at_corners();
  grow_tree();
}

/* Limits of cosines, which save time, and normals of vertices are those of a mesh at rest: here the limits
   stay at 0, and normals are found when they are asked for. */

MeshDetail::MeshDetail(const TriangleMesh &triangle_mesh) : mesh(triangle_mesh), moves(true)
{
  std::vector<int> numbers(mesh.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  near = numbers;
  make_faces(numbers);
  corners = mesh.all_corners();
  vertex_numbers.resize(mesh.num_vertices());
  std::iota(vertex_numbers.begin(), vertex_numbers.end(), 0);
  const MeshEdges edges(corners);
  find_neighbors(edges);
  find_rings(edges);
  find_around();
  look_at_corners();
  grow_tree();
}

/* Numbers in the mesh of the triangles within the cover, and of those that share a vertex with
   them. */

std::vector<int> MeshDetail::members(const Eigen::AlignedBox3d &cover)
{
  std::vector<bool> within(mesh.size()), touched(mesh.num_vertices());
  for (int t = 0; t < mesh.size(); t++) {
    within[t] = cover.intersects(bounds_of(mesh.triangle(t)));
    if (within[t])
      for (const int v : mesh.corners(t).vertex) touched[v] = true;
  }
  std::vector<int> found;
  for (int t = 0; t < mesh.size(); t++) {
    const int *v = mesh.corners(t).vertex;
    if (!touched[v[0]] && !touched[v[1]] && !touched[v[2]]) continue;
    if (within[t]) near.push_back(static_cast<int>(found.size()));
    found.push_back(t);
  }
  near.shrink_to_fit();
  return found;
}

void MeshDetail::make_faces(const std::vector<int> &numbers)
{
  faces.reserve(numbers.size());
  for (const int t : numbers) {
    faces.emplace_back();
    faces.back().number = t;
    set_plane(static_cast<int>(faces.size()) - 1);
  }
}

void MeshDetail::set_plane(int t)
{
  Face &face = faces[t];
  const Triangle triangle = mesh.triangle(face.number);
  std::copy(triangle.corner, triangle.corner + 3, face.corner);
  const int plane = mesh.plane_of(face.number);
  face.normal = mesh.normal(plane);
  face.offset = dot(mesh.vertex(mesh.corners(plane).vertex[0]), face.normal);
}

/* Numbers of vertices in the order in which triangles meet them. */

void MeshDetail::find_vertices(const std::vector<int> &numbers)
{
  std::vector<int> here(mesh.num_vertices(), none);
  corners.reserve(numbers.size());
  for (const int t : numbers) {
    Corners vertices = mesh.corners(t);
    for (int &v : vertices.vertex) {
      if (here[v] == none) {
        here[v] = static_cast<int>(vertex_numbers.size());
        vertex_numbers.push_back(v);
      }
      v = here[v];
    }
    corners.push_back(vertices);
  }
  vertex_numbers.shrink_to_fit();
}

/* Over an edge of two triangles the direction to a point that is nearest to the edge lies between
   both normals (or their opposites). */

void MeshDetail::find_neighbors(const MeshEdges &edges)
{
  neighbors.reserve(faces.size());
  for (std::size_t t = 0; t < faces.size(); t++) {
    Face &face = faces[t];
    Neighbors adjacent{};
    for (int k = 0; k < 3; k++) {
      const MeshEdges::Edge &edge = edges.of(static_cast<int>(t), k);
      const int *user = edges.users(edge);
      const bool is_first = user[0] == static_cast<int>(t);
      if (is_first) face.reports_edge |= static_cast<unsigned char>(1U << k);
      adjacent.over[k] = none;
      if (edge.num_users == 2) {
        adjacent.over[k] = is_first ? user[1] : user[0];
        const double cosine = dot(face.normal, faces[adjacent.over[k]].normal);
        if (cosine > 0.0 && !moves)
          face.least_square_cosine[k] = static_cast<float>(std::max(cosine * cosine - slack, 0.0));
      }
      if (edge.num_users > 2 && is_first) {    // only this one asks
        adjacent.over[k] = -2 - static_cast<int>(nonmanifold.size());
        nonmanifold.emplace_back(user, user + edge.num_users);
      }
    }
    neighbors.push_back(adjacent);
  }
}

void MeshDetail::find_rings(const MeshEdges &edges)
{
  const std::size_t n = vertex_numbers.size();
  ring_begin.assign(n + 1, 0);
  for (const MeshEdges::Edge &e : edges.all())
    for (const int v : e.vertex) ring_begin[v + 1]++;
  std::partial_sum(ring_begin.begin(), ring_begin.end(), ring_begin.begin());
  ring.resize(ring_begin[n]);
  std::vector<int> next(ring_begin.begin(), ring_begin.end() - 1);
  for (const MeshEdges::Edge &e : edges.all()) {
    ring[next[e.vertex[0]]++] = e.vertex[1];
    ring[next[e.vertex[1]]++] = e.vertex[0];
  }
}

void MeshDetail::look_at_corners()
{
  std::vector<bool> reported(vertex_numbers.size());
  if (!moves) vertex_normals.assign(vertex_numbers.size(), {0.0, 0.0, 0.0});
  for (std::size_t t = 0; t < faces.size(); t++) {
    Face &face = faces[t];
    double least = 1.0;
    for (int k = 0; k < 3; k++) {
      const int v = corners[t].vertex[k];
      if (!reported[v]) face.reports_corner |= static_cast<unsigned char>(1U << k);
      if (moves) {
        least = 0.0;
        reported[v] = true;
        continue;
      }
      vertex_normals[v] = vertex_normals[v] + face.weighted_normal(k);
      if (!reported[v]) least = std::min<double>(least, corner_limit(v, face.normal));
      reported[v] = true;
    }
    face.least_at_corners = static_cast<float>(least);
  }
}

/// Of a corner, by its angle.
Vector3<double> MeshDetail::Face::weighted_normal(int k) const
{
  const Vector3<double> a = corner[(k + 1) % 3] - corner[k], b = corner[(k + 2) % 3] - corner[k];
  return std::atan2(length(cross(a, b)), dot(a, b)) * normal;
}

/* Let u be the direction from a corner to a point nearest to it, at the angle a from the normal
   n: u = cos(a) n + sin(a) w. No edge e that leaves the corner makes an acute angle with u. Seen
   along n there is one within half of the widest gap g between edges from w, so that tan(a) <= |n
   e| / (cos(g/2) |e - (n e) n|). Flat surroundings leave u = n. */

float MeshDetail::corner_limit(int v, const Vector3<double> &n) const
{
  const Vector3<double> at = mesh.vertex(vertex_numbers[v]);
  std::vector<double> angles;
  Vector3<double> first{0.0, 0.0, 0.0};
  double steepest = 0.0;
  for (int k = ring_begin[v]; k < ring_begin[v + 1]; k++) {
    const Vector3<double> e = mesh.vertex(vertex_numbers[ring[k]]) - at;
    const double height = dot(e, n);
    const Vector3<double> flat = e - height * n;
    const double width = length(flat);
    if (!(width > 1.0e-3 * length(e))) return 0.0F;
    steepest = std::max(steepest, std::fabs(height) / width);
    if (angles.empty()) first = 1.0 / width * flat;
    angles.push_back(std::atan2(dot(cross(first, flat), n), dot(first, flat)));
  }
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * std::acos(-1.0) - angles.back();
  for (std::size_t k = 1; k < angles.size(); k++) gap = std::max(gap, angles[k] - angles[k - 1]);
  const double narrow = std::cos(0.5 * gap);
  if (!(narrow > 1.0e-3)) return 0.0F;
  const double tangent = steepest / narrow;
  return static_cast<float>(std::max(1.0 / (1.0 + tangent * tangent) - slack, 0.0));
}

void MeshDetail::grow_tree()
{
  tree = std::make_unique<BoxTree>(boxes_of_near());
}

std::vector<Eigen::AlignedBox3d> MeshDetail::boxes_of_near() const
{
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(near.size());
  for (const int t : near)
    boxes.push_back(bounds_of({{faces[t].corner[0], faces[t].corner[1], faces[t].corner[2]}}));
  return boxes;
}

/* Corners first, then edges, then the face: regions of the plane around a triangle in which the
   nearest point is of that kind, by the signs of projections (Ericson, Real-Time Collision
   Detection, 2005, section 5.1.5). */

NearestPoint MeshDetail::nearest(int t, const Vector3<double> &p) const
{
  const Vector3<double> *const corner = faces[t].corner;
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
  return result((dot(p, n) - faces[t].offset) * n, NearestPoint::FACE, 0);
}

/* Where the way meets the plane, and whether this is on the inner side of all edges. */

bool MeshDetail::is_between(int t, const Vector3<double> &from, const Vector3<double> &to) const
{
  const Face &face = faces[t];
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
  height = dot(nearest.away, faces[t].normal);
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
  outward = outward + faces[user].normal;
  return !comes_nearer(nearest.away, faces[user].corner[opposite] - faces[t].corner[k]);
}

bool MeshDetail::edge_is_minimum(int t, const NearestPoint &nearest, double &height) const
{
  const Face &face = faces[t];
  if (!(face.reports_edge >> nearest.index & 1)) return false;
  const double above = dot(nearest.away, face.normal);
  if (above * above < face.least_square_cosine[nearest.index] * nearest.square) return false;
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
  const Face &face = faces[t];
  if (!(face.reports_corner >> nearest.index & 1)) return false;
  const double above = dot(nearest.away, face.normal);
  if (above * above < face.least_at_corners * nearest.square) return false;
  const int v = corners[t].vertex[nearest.index];
  for (int k = ring_begin[v]; k < ring_begin[v + 1]; k++)
    if (comes_nearer(nearest.away,
                     mesh.vertex(vertex_numbers[ring[k]]) - face.corner[nearest.index]))
      return false;
  height = dot(nearest.away, moves ? normal_of_vertex(v) : vertex_normals[v]);
  return true;
}

Vector3<double> MeshDetail::normal_of_vertex(int v) const
{
  Vector3<double> sum{0.0, 0.0, 0.0};
  for (int n = around_begin[v]; n < around_begin[v + 1]; n++) {
    int k = 0;
    while (corners[around[n]].vertex[k] != v) k++;
    sum = sum + faces[around[n]].weighted_normal(k);
  }
  return sum;
}

/* ---- vertices that move -------------------------------------------------------------------------- */

void MeshDetail::find_around()
{
  around_begin.assign(vertex_numbers.size() + 1, 0);
  for (const Corners &triangle : corners)
    for (const int v : triangle.vertex) around_begin[v + 1]++;
  std::partial_sum(around_begin.begin(), around_begin.end(), around_begin.begin());
  around.resize(around_begin.back());
  std::vector<int> next(around_begin.begin(), around_begin.end() - 1);
  for (std::size_t t = 0; t < corners.size(); t++)
    for (const int v : corners[t].vertex) around[next[v]++] = static_cast<int>(t);
}

void MeshDetail::follow_all()
{
  follow(near);
  std::vector<Eigen::AlignedBox3d> boxes = boxes_of_near();
  if (tree->refit(boxes)) tree = std::make_unique<BoxTree>(boxes);
}

void MeshDetail::follow(const std::vector<int> &triangles)
{
  for (const int t : triangles) set_plane(t);
}

std::vector<int> MeshDetail::near_to(const std::vector<int> &triangles) const
{
  std::vector<bool> touched(vertex_numbers.size());
  for (const int t : triangles)
    for (const int v : corners[t].vertex) touched[v] = true;
  std::vector<int> found;
  for (std::size_t t = 0; t < corners.size(); t++) {
    const int *const v = corners[t].vertex;
    if (touched[v[0]] || touched[v[1]] || touched[v[2]]) found.push_back(static_cast<int>(t));
  }
  return found;
}

double MeshDetail::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  double sum = bytes(faces) + bytes(near) + bytes(neighbors) + bytes(nonmanifold) + bytes(corners) +
               bytes(vertex_numbers) + bytes(ring_begin) + bytes(ring) + bytes(vertex_normals) +
               bytes(around_begin) + bytes(around);
  for (const auto &users : nonmanifold) sum += bytes(users);
  return sum + (tree ? tree->memory_usage() : 0.0);
}

}    // namespace Talus
