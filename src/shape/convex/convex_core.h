// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A convex polyhedron as the narrow phase reads it: arrays by component, padded to whole vectors of
// eight, and who is next to whom.

#ifndef TALUS_SHAPE_CONVEX_CONVEX_CORE_H
#define TALUS_SHAPE_CONVEX_CONVEX_CORE_H

#include "base/aligned_vector.h"
#include "base/vector3.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// Points or vectors by component. Behind the last one stand copies of it, up to a multiple of
/// eight, so that loops over eight need no remainder.
class VectorArray {
 public:
  int size() const { return count; }
  int padded_size() const { return static_cast<int>(component[0].size()); }
  Vector3<double> operator[](int k) const
  {
    return {component[0][k], component[1][k], component[2][k]};
  }
  const double *of(int axis) const { return component[axis].data(); }
  void assign(const std::vector<Vector3<double>> &values);

 private:
  AlignedVector<double> component[3];
  int count = 0;
};

class ConvexCore {
 public:
  /// Faces left and right of an edge: `face[0]` runs from vertex[0] to vertex[1], counterclockwise
  /// as seen from outside, `face[1]` back.
  struct Edge {
    int vertex[2], face[2];
  };
  /// Bounds of the number of vertices, edges, faces: contacts are named by them (contact_name()).
  static constexpr int most_parts = 32767;

  /// `faces`: vertices counterclockwise as seen from outside, 3 or more, in one plane but for
  /// rounding; each edge belongs to two faces. A flat core, such as a triangle, has two faces.
  /// Throws std::runtime_error for more than most_parts vertices, edges, or faces.
  ConvexCore(const std::vector<Vector3<double>> &vertices,
             const std::vector<std::vector<int>> &faces);

  int num_vertices() const { return vertices.size(); }
  int num_faces() const { return normals.size(); }
  int num_edges() const { return static_cast<int>(edges.size()); }

  Vector3<double> vertex(int v) const { return vertices[v]; }
  const VectorArray &all_vertices() const { return vertices; }
  /// Unit vector that points outward; the plane of a face is normal . x = offset, and no vertex is
  /// above it.
  Vector3<double> normal(int f) const { return normals[f]; }
  const VectorArray &all_normals() const { return normals; }
  double offset(int f) const { return offsets[f]; }
  /// Padded like the normals.
  const double *all_offsets() const { return offsets.data(); }
  const Edge &edge(int e) const { return edges[e]; }

  /// Corners of a face, counterclockwise as seen from outside; edge k runs from corner k to the
  /// next one.
  int num_corners(int f) const { return first_corner[f + 1] - first_corner[f]; }
  const int *corners(int f) const { return &corner[first_corner[f]]; }
  const int *edges_of_face(int f) const { return &edge_of_corner[first_corner[f]]; }
  int num_edges_of_vertex(int v) const { return first_spoke[v + 1] - first_spoke[v]; }
  const int *edges_of_vertex(int v) const { return &spoke[first_spoke[v]]; }

  /// Largest distance of a vertex, smallest of a face, from the origin of the frame; the latter is
  /// negative where the origin is outside.
  double outer_radius() const { return outer; }
  double inner_radius() const { return inner; }

  /// The same polyhedron with other coordinates: those of a triangle that takes turns.
  void move_vertices(const std::vector<Vector3<double>> &vertices);

  double memory_usage() const;

 private:
  void find_edges(int num_points);
  void find_planes();

  VectorArray vertices, normals;
  AlignedVector<double> offsets;
  std::vector<Edge> edges;
  std::vector<int> first_corner, corner, edge_of_corner, first_spoke, spoke;
  double outer = 0.0, inner = 0.0;
};

}    // namespace Talus

#endif
