// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Triangles that know their neighbours: the topology of a mesh, and the nearest points on it.

#ifndef TALUS_BODY_TRIANGLE_MESH_H
#define TALUS_BODY_TRIANGLE_MESH_H

#include "body/large_body_shape.h"

#include <string>
#include <vector>

namespace Talus {

/// What was found wrong with the triangles of a mesh, and what was done about it. Numbers of
/// triangles count from 1 in the order of the file.
struct MeshReport {
  int degenerate = 0, first_degenerate = 0;    ///< without area: left out
  int duplicate = 0, first_duplicate = 0;      ///< with the corners of an earlier one: left out
  int open_edges = 0;                          ///< edges of one triangle only: used
  int crowded_edges = 0, first_crowded = 0;    ///< edges of three or more triangles: used
  int turned_edges = 0, first_turned = 0;      ///< whose two triangles face opposite sides
  bool closed() const { return open_edges + crowded_edges + turned_edges == 0; }
};

/// The nearest point of one triangle to some point.
struct NearestPoint {
  enum Feature : int { FACE, EDGE, CORNER };
  Vector3<double> away;    ///< from the nearest point to the point
  double square;           ///< its length squared
  Feature feature;
  int index;    ///< which edge (from corner i to i + 1) or corner of the triangle
};

class TriangleMesh {
 public:
  /// Joins corners that have equal coordinates. The angle between the normals of two triangles
  /// below which their common edge counts as part of one smooth patch is smooth_angle. Throws
  /// std::runtime_error if no triangle is left.
  explicit TriangleMesh(const std::vector<Triangle> &soup);

  static constexpr double smooth_angle = 30.0;          // degrees
  static constexpr double smooth_cosine = 0.8660254;    // its cosine

  int size() const { return static_cast<int>(triangles.size()); }
  const MeshReport &report() const { return findings; }
  const Triangle &triangle(int t) const { return faces[t].corners; }
  const Vector3<double> &normal(int t) const { return faces[t].normal; }
  double area(int t) const { return areas[t]; }
  /// Number of the triangle in the file, from 0.
  int number_in_file(int t) const { return file_numbers[t]; }
  /// Triangles that are connected over smooth edges have the same patch.
  int patch(int t) const { return patches[t]; }

  /// Volume enclosed (negative if normals point inward) and its centre; without enclosed volume the
  /// centre of the area.
  double volume() const { return enclosed; }
  const Vector3<double> &centre() const { return middle; }

  /// Starts to load what nearest() reads.
  void call_ahead(int t) const
  {
    const char *const at = reinterpret_cast<const char *>(&faces[t]);
    for (std::size_t byte = 0; byte < sizeof(Face); byte += 64) __builtin_prefetch(at + byte);
  }

  NearestPoint nearest(int t, const Vector3<double> &point) const;

  /// Is the nearest point of triangle t a point of the whole surface from which the distance grows
  /// in all directions, and is t the triangle that reports it, once for all that share it? `height`
  /// receives a number whose sign tells on which side of the surface the point is.
  bool is_local_minimum(int t, const NearestPoint &nearest, double &height) const;

  double memory_usage() const;

 private:
  struct Corners {
    int vertex[3];
  };
  struct alignas(64) Face {    // what every step looks at, in one place
    Triangle corners;
    Vector3<double> normal;
    // of each edge: an edge is no minimum if the square of the cosine between the normal and the
    // way to the point is less than this
    float least_square_cosine[3];
    unsigned char reports_edge, reports_corner;    // bits: it is this triangle that reports them
  };
  struct Edge {
    int vertex[2];
    int first_user, num_users;    // range of edge_users
  };
  void join_corners(const std::vector<Triangle> &soup);
  void find_edges();
  void find_patches();
  void find_rings();
  void find_volume();
  void prepare_faces();
  bool edge_is_minimum(int t, const NearestPoint &nearest, double &height) const;
  bool corner_is_minimum(int t, const NearestPoint &nearest, double &height) const;
  int opposite(int t, const Edge &edge) const;
  bool runs_along(int t, int from, int to) const;

  std::vector<Vector3<double>> vertices;
  std::vector<Face> faces;
  std::vector<Corners> triangles, edges_of;    // by triangle: corners, edges
  std::vector<double> areas;
  std::vector<int> patches, file_numbers;
  std::vector<Edge> edges;
  std::vector<int> edge_users;
  std::vector<int> ring_begin, ring;              // by vertex: vertices joined to it by an edge
  std::vector<int> first_user;                    // by vertex: its triangle with the lowest number
  std::vector<Vector3<double>> vertex_normals;    // weighted by angle
  MeshReport findings;
  double enclosed = 0.0;
  Vector3<double> middle{0.0, 0.0, 0.0};
};

}    // namespace Talus

#endif
