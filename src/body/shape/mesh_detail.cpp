// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/mesh_detail.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Talus {
namespace {

// Limits of cosines are lowered by far more than rounding.
constexpr double slack = 1.0e-5;

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
  make_slabs();
}

/* Limits of cosines, which save time, are those of a mesh at rest. */

MeshDetail::MeshDetail(const TriangleMesh &triangle_mesh) : mesh(triangle_mesh), moves(true)
{
  std::vector<int> numbers(mesh.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  near = numbers;
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
    set_geometry(t, faces.back());
  }
}

void MeshDetail::set_geometry(int number, Face &face) const
{
  face.number = number;
  const Triangle triangle = mesh.triangle(number);
  std::copy(triangle.corner, triangle.corner + 3, face.corner);
  const int plane = mesh.plane_of(number);
  face.normal = mesh.normal(plane);
  face.offset = dot(mesh.vertex(mesh.corners(plane).vertex[0]), face.normal);
}

/// As it is now; in `room` if it moves.
const MeshDetail::Face &MeshDetail::face(int t, Face &room) const
{
  if (!moves) return faces[t];
  set_geometry(t, room);
  return room;
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
  neighbors.reserve(corners.size());
  reports.assign(corners.size(), {0, 0});
  for (std::size_t t = 0; t < corners.size(); t++) {
    Neighbors adjacent{};
    for (int k = 0; k < 3; k++) {
      const MeshEdges::Edge &edge = edges.of(static_cast<int>(t), k);
      const int *user = edges.users(edge);
      const bool is_first = user[0] == static_cast<int>(t);
      if (is_first) reports[t].edge |= static_cast<unsigned char>(1U << k);
      adjacent.over[k] = none;
      if (edge.num_users == 2) {
        adjacent.over[k] = is_first ? user[1] : user[0];
        const double cosine = moves ? 0.0 : dot(faces[t].normal, faces[adjacent.over[k]].normal);
        if (cosine > 0.0)
          faces[t].least_square_cosine[k] =
              static_cast<float>(std::max(cosine * cosine - slack, 0.0));
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
  for (std::size_t t = 0; t < corners.size(); t++) {
    double least = 1.0;
    for (int k = 0; k < 3; k++) {
      const int v = corners[t].vertex[k];
      if (!moves) {
        vertex_normals[v] = vertex_normals[v] + weighted_normal(static_cast<int>(t), k);
        if (!reported[v]) least = std::min<double>(least, corner_limit(v, faces[t].normal));
      }
      if (!reported[v]) reports[t].corner |= static_cast<unsigned char>(1U << k);
      reported[v] = true;
    }
    if (!moves) faces[t].least_at_corners = static_cast<float>(least);
  }
}

/// Normal of a triangle by its angle at a corner.
Vector3<double> MeshDetail::weighted_normal(int t, int k) const
{
  Face room;
  const Face &at = face(t, room);
  const Vector3<double> a = at.corner[(k + 1) % 3] - at.corner[k],
                        b = at.corner[(k + 2) % 3] - at.corner[k];
  return std::atan2(length(cross(a, b)), dot(a, b)) * at.normal;
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
  for (const int t : near) boxes.push_back(bounds_of(mesh.triangle(number(t))));
  return boxes;
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

void MeshDetail::refit()
{
  const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_near();
  if (tree->refit(boxes)) tree = std::make_unique<BoxTree>(boxes);
}

double MeshDetail::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  double sum = bytes(faces) + bytes(reports) + bytes(near) + bytes(neighbors) + bytes(nonmanifold) +
               bytes(corners) + bytes(vertex_numbers) + bytes(ring_begin) + bytes(ring) +
               bytes(vertex_normals) + bytes(slabs) + bytes(around_begin) + bytes(around);
  for (const auto &users : nonmanifold) sum += bytes(users);
  return sum + (tree ? tree->memory_usage() : 0.0);
}

}    // namespace Talus
