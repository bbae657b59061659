// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The triangles of a mesh as every rank holds them: vertices that triangles share, and a few
// numbers by triangle. What contacts need to know besides is in MeshDetail.

#ifndef TALUS_BODY_SHAPE_TRIANGLE_MESH_H
#define TALUS_BODY_SHAPE_TRIANGLE_MESH_H

#include "base/linear_algebra.h"
#include "body/shape/large_body_shape.h"
#include "body/shape/mesh_edges.h"
#include "body/shape/mesh_images.h"

#include <utility>
#include <vector>

namespace Talus {

/// What was found wrong with the triangles of a mesh, and what was done about it. Numbers of
/// triangles count from 1 in the order of the file.
struct MeshReport {
  int degenerate = 0, first_degenerate = 0;    ///< without area: left out
  int duplicate = 0, first_duplicate = 0;      ///< with the corners of an earlier one: left out
  int open_edges = 0;                          ///< edges of one triangle only: used
  int nonmanifold_edges = 0, first_nonmanifold = 0;    ///< edges of three or more triangles: used
  int inconsistent_edges = 0,
      first_inconsistent = 0;                    ///< whose two triangles face opposite sides
  int repaired_edges = 0, first_repaired = 0;    ///< did, until triangles were turned
  int joined_corners = 0;      ///< places of corners that were not quite those of vertices
  double largest_gap = 0.0;    ///< (length) between them
  int divided_edges = 0, first_divided = 0;    ///< on which vertices lay: triangles were divided
  bool closed() const { return open_edges + nonmanifold_edges + inconsistent_edges == 0; }
};

class TriangleMesh {
 public:
  /// Joins corners that are not further apart than the tolerance (length), and triangles at edges on
  /// which corners of others lie: these are divided. The angle between the normals of two triangles
  /// below which their common edge counts as part of one smooth patch is smooth_angle. `orient`:
  /// triangles are turned such that connected ones face the same side, as far as that can be; and
  /// the normals of all parts of a closed mesh point out of what it encloses, or all of them into
  /// it. Throws std::runtime_error if no triangle is left.
  TriangleMesh(const std::vector<Triangle> &soup, bool orient, double tolerance);
  /// With usual_tolerance times the size of the mesh.
  explicit TriangleMesh(const std::vector<Triangle> &soup, bool orient = false);

  /// Over the diagonal of the box around all triangles. Files have coordinates of seven digits, at
  /// some distance from the origin.
  static constexpr double usual_tolerance = 1.0e-6;

  static constexpr double smooth_angle = 30.0;          // degrees
  static constexpr double smooth_cosine = 0.8660254;    // its cosine

  /// Where the mesh ends on a face in which the box is periodic it goes on behind it: with images,
  /// whose numbers follow those of the mesh. Before anything refers to its triangles.
  void continue_behind(const PeriodicEdges &edges);

  /// Images included.
  int size() const { return static_cast<int>(triangles.size()); }
  /// Without images.
  int num_own() const { return static_cast<int>(triangles.size() - images.size()); }
  /// The triangle that an image is one of; itself if it is none.
  int own(int t) const { return t < num_own() ? t : images[t - num_own()]; }
  int num_vertices() const { return static_cast<int>(vertices.size()); }
  /// Without those of images alone, which follow.
  int num_own_vertices() const { return num_vertices() - static_cast<int>(vertex_images.size()); }
  /// The vertex that one of an image stands for, itself if it is none; and how far away it is.
  int own_vertex(int v) const
  {
    return v < num_own_vertices() ? v : vertex_images[v - num_own_vertices()].own;
  }
  Vector3<double> shift_of_vertex(int v) const
  {
    return v < num_own_vertices() ? Vector3<double>{0.0, 0.0, 0.0}
                                  : vertex_images[v - num_own_vertices()].shift;
  }
  const MeshReport &report() const { return findings; }
  const Corners &corners(int t) const { return triangles[t]; }
  const Vector3<double> &vertex(int v) const { return vertices[v]; }
  const std::vector<Vector3<double>> &all_vertices() const { return vertices; }
  Triangle triangle(int t) const
  {
    const int *const v = triangles[t].vertex;
    return {{vertices[v[0]], vertices[v[1]], vertices[v[2]]}};
  }
  double area(int t) const;
  /// Of a closed mesh that has been oriented: normals point out of what it encloses.
  bool faces_outward() const { return outward; }
  /// Of the corners as they are; contacts use that of the plane, see plane_of().
  Vector3<double> normal(int t) const;
  /// Number of the triangle in the file, from 0.
  int number_in_file(int t) const { return file_numbers.empty() ? own(t) : file_numbers[own(t)]; }
  /// Triangles that are connected over smooth edges have the same patch.
  int patch(int t) const { return patches[t]; }
  /// Triangles that are connected and lie in one plane but for rounding have the same: the first of
  /// them, whose normal and plane stand for all.
  int plane_of(int t) const { return planes[t]; }

  /// There are facets of one patch that make a hollow on the side to which normals point, or on the
  /// other one: where a sphere goes from one to the next, the normal of its contact jumps.
  bool hollow_in_front() const { return hollow[0]; }
  bool hollow_behind() const { return hollow[1]; }

  /// Volume enclosed (negative if normals point inward) and its center; without enclosed volume the
  /// center of the area.
  double volume() const { return enclosed; }
  const Vector3<double> &center() const { return middle; }
  const Eigen::AlignedBox3d &bounds() const { return extent; }

  // ---- of a mesh whose vertices move, see MovingVertices

  /// Before anything is asked of its planes: each triangle has a plane of its own.
  void separate_planes();
  /// Planes as they are now, all over again.
  void find_planes(const MeshEdges &edges);
  void place(int vertex, const Vector3<double> &x) { vertices[vertex] = x; }
  /// All places that it will have until the next call are in this box.
  void set_bounds(const Eigen::AlignedBox3d &box) { extent = box; }
  void set_patches(std::vector<int> of_triangles) { patches = std::move(of_triangles); }
  const std::vector<Corners> &all_corners() const { return triangles; }

  double memory_usage() const;

 private:
  void join_corners(const std::vector<Triangle> &soup, double tolerance);
  void join_edges(double tolerance);
  void orient(const MeshEdges &edges);
  void orient_along(int first, int number, const MeshEdges &edges, std::vector<int> &part);
  void orient_parts(const std::vector<int> &part, int num_parts);
  void flip(int t) { std::swap(triangles[t].vertex[1], triangles[t].vertex[2]); }
  void look_at_edges(const MeshEdges &edges);
  void find_smooth_parts();
  void find_patches(const MeshEdges &edges);
  void spread_plane(int first, const MeshEdges &edges, std::vector<int> &to_do);
  void find_hollows(const MeshEdges &edges);
  void find_volume();

  std::vector<Vector3<double>> vertices;
  std::vector<Corners> triangles;
  std::vector<int> patches, planes;
  std::vector<int> file_numbers;    // empty: those of the file
  std::vector<int> images;          // of which triangle each image is one
  std::vector<MeshImages::Vertex> vertex_images;
  double joins_within = 0.0;    // the tolerance for corners
  MeshReport findings;
  Eigen::AlignedBox3d extent;
  bool outward = true, hollow[2] = {false, false};
  double enclosed = 0.0;
  Vector3<double> middle{0.0, 0.0, 0.0};
};

/// The box around a triangle.
Eigen::AlignedBox3d bounds_of(const Triangle &t);

}    // namespace Talus

#endif
