// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contacts need to know about the triangles of a mesh near some place: geometry and neighbors
// of each, and a tree to find them. Made from the mesh that all ranks hold, for that part of it
// which is within reach of the particles of this rank.
//
// Triangles have numbers of their own here, ascending with those of the mesh. Whether a point of
// the surface is nearest to a particle, and which triangle says so, does not depend on the part:
// all neighbors of its triangles are known too.
//
// Of a mesh whose vertices move it is made once, of all triangles, with the same numbers, and knows only what
// does not move: geometry is that of the mesh at the time of the question, and the tree that of the last
// refit().

#ifndef TALUS_BODY_SHAPE_MESH_DETAIL_H
#define TALUS_BODY_SHAPE_MESH_DETAIL_H

#include "body/shape/box_tree.h"
#include "body/shape/triangle_mesh.h"

#include <memory>
#include <vector>

namespace Talus {

/// The nearest point of one triangle to some point.
struct NearestPoint {
  enum Feature : int { FACE, EDGE, CORNER };
  Vector3<double> away;    ///< from the nearest point to the point
  double square;           ///< its length squared
  Feature feature;
  int index;                 ///< which edge (from corner i to i + 1) or corner of the triangle
  Vector3<double> normal;    ///< of the triangle, only of a FACE
};

class MeshDetail {
 public:
  /// Of all triangles whose boxes touch `cover`.
  MeshDetail(const TriangleMesh &mesh, const Eigen::AlignedBox3d &cover);
  /// Of a mesh whose vertices move.
  explicit MeshDetail(const TriangleMesh &mesh);

  /// Calls visit(t) for every triangle that is nearer to the point than `reach`, perhaps for some others.
  template <class Visitor>
  void visit_near(const Vector3<double> &point, double reach, Visitor visit) const
  {
    if (!tree) return;
    tree->visit_leaves_near(point, reach, [&](int leaf, int count) {
      unsigned bits = (1U << count) - 1U;
      if (!slabs.empty()) bits &= near_bits(slabs[leaf], point, reach);
      for (; bits; bits &= bits - 1U) visit(near[tree->thing(leaf, __builtin_ctz(bits))]);
    });
  }

  /// Triangles that visit_near() may find.
  int size() const { return static_cast<int>(near.size()); }
  /// Number in the mesh.
  int number(int t) const { return moves ? t : faces[t].number; }
  Vector3<double> normal(int t) const
  {
    return moves ? mesh.normal(mesh.plane_of(t)) : faces[t].normal;
  }
  NearestPoint nearest(int t, const Vector3<double> &point) const;

  /// The plane of triangle t if the nearest point of it is in its inside, by far more than rounding
  /// over the size of the triangle and `reach` (length).
  FlatPlace flat_place(int t, const Vector3<double> &center, double reach) const;

  /// Does the way between two points lead through triangle t? At its rim, by rounding, perhaps.
  bool is_between(int t, const Vector3<double> &from, const Vector3<double> &to) const;

  /// Whether the nearest point of triangle t is a local minimum of the distance from the whole
  /// surface, and t, of all triangles that share this point, the one that reports it. `height`
  /// receives a number whose sign tells on which side of the surface the point is; of a face the
  /// distance.
  bool is_local_minimum(int t, const NearestPoint &nearest, double &height) const;

  /// Prefetches what nearest() reads.
  void prefetch(int t) const
  {
    if (moves) {
      for (const int v : mesh.corners(t).vertex) __builtin_prefetch(&mesh.vertex(v));
      return;
    }
    const char *const at = reinterpret_cast<const char *>(&faces[t]);
    for (std::size_t byte = 0; byte < sizeof(Face); byte += 64) __builtin_prefetch(at + byte);
  }

  /// Of a mesh whose vertices move: the tree is that of now.
  void refit();

  double memory_usage() const;

 private:
  struct alignas(64) Face {    // what every step looks at, in one place
    Vector3<double> corner[3];
    Vector3<double> normal;    // of its plane,
    double offset;             // whose points have this product with the normal
    // of each edge: an edge is no minimum if the square of the cosine between the normal and the
    // way to the point is less than this
    float least_square_cosine[3];
    float least_at_corners;    // the same for all three corners
    int number;
  };
  /// Of the triangles of a leaf: each is in its plane, the first one, and behind three that stand on its
  /// edges.
  struct alignas(32) Slabs {
    float normal[4][3][BoxTree::leaf_size], offset[4][BoxTree::leaf_size];
    void set_plane(int k, int which, const Vector3<double> &normal, const Vector3<double> &point);
  };
  static unsigned near_bits(const Slabs &slabs, const Vector3<double> &point, double reach);
  void make_slabs();

  struct Reports {    // bits: it is this triangle that reports them
    unsigned char edge, corner;
  };
  struct Neighbors {
    int over[3];    // over each edge: a triangle, `none`, or crowded[-2 - this]
  };
  static constexpr int none = -1;

  std::vector<int> members(const Eigen::AlignedBox3d &cover);
  void make_faces(const std::vector<int> &numbers);
  void find_neighbors(const MeshEdges &edges);
  void find_vertices(const std::vector<int> &numbers);
  void find_rings(const MeshEdges &edges);
  float corner_limit(int vertex, const Vector3<double> &normal) const;
  void look_at_corners();
  void grow_tree();
  std::vector<Eigen::AlignedBox3d> boxes_of_near() const;
  const Face &face(int t, Face &room) const;
  void set_geometry(int number, Face &face) const;
  Vector3<double> weighted_normal(int t, int corner) const;
  void find_around();
  Vector3<double> normal_of_vertex(int vertex) const;
  bool edge_is_minimum(int t, const NearestPoint &nearest, double &height) const;
  bool corner_is_minimum(int t, const NearestPoint &nearest, double &height) const;
  bool edge_user(int user, int t, const NearestPoint &nearest, Vector3<double> &outward) const;

  const TriangleMesh &mesh;
  const bool moves = false;    // its vertices do
  std::vector<Face> faces;     // none if its vertices move
  std::vector<Reports> reports;
  std::vector<int> near;    // faces within the cover; the others are their neighbors
  std::unique_ptr<BoxTree> tree;
  AlignedVector<Slabs> slabs;    // by leaf; none if vertices move
  std::vector<Neighbors> neighbors;
  std::vector<std::vector<int>> nonmanifold;    // all triangles of an edge, ascending
  // vertices: numbers of their own; which of the mesh, those joined to them by an edge, normal
  // weighted by angle
  std::vector<Corners> corners;
  std::vector<int> vertex_numbers, ring_begin, ring;
  std::vector<Vector3<double>> vertex_normals;
  std::vector<int> around_begin, around;    // triangles of each vertex, only if they move
};

}    // namespace Talus

#endif
