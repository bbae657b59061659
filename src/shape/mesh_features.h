// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The edges and corners of a mesh that stand out, so that faces and edges of a particle may touch
// them. How the surface is cut into triangles does not matter: an edge between triangles of one
// plane is none, nor is a corner where two straight pieces of one edge meet. Made once from the
// whole mesh, in scenes with convex particles only.

#ifndef TALUS_SHAPE_MESH_FEATURES_H
#define TALUS_SHAPE_MESH_FEATURES_H

#include "body/shape/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// Kind of an edge, as seen from the side to which normals point: flat, a convex ridge, a concave
/// valley, or a boundary, where the surface ends or more than two triangles meet: a ridge from both
/// sides.
enum class EdgeKind : unsigned char { FLAT, RIDGE, VALLEY, BOUNDARY };

class MeshFeatures {
 public:
  explicit MeshFeatures(const TriangleMesh &mesh);

  /// Edge k of a triangle, from its corner k to the next.
  EdgeKind edge_kind(int triangle, int k) const { return edge_kinds[3L * triangle + k]; }
  /// The triangle on the other side of a flat edge, a ridge, or a valley.
  int over(int triangle, int k) const { return neighbors[3L * triangle + k]; }

  /// An edge that is a ridge from in front, from behind, or both.
  struct Ridge {
    Vector3<double> from, along;    ///< the second end is from + along
    Vector3<double> inward[2];      ///< unit vectors from the edge into its triangles, or zero
    Vector3<double> outward;        ///< sum of the normals of these; zero: touched from all sides
    int vertex[2];                  ///< of the mesh
    int end[2];                     ///< of the whole straight edge of which this is a piece
    std::uint32_t name;             ///< the same for all pieces of a straight edge
    int planes[2];                  ///< see TriangleMesh::plane_of(); or -1
    EdgeKind edge_kind;
  };
  /// A vertex at which ridges meet that are not one straight line, from in front or behind.
  struct Corner {
    Vector3<double> place, outward;    ///< outward: sum of normals, weighted by angles
    int vertex;
    bool in_front, behind;
  };
  /// Each edge and vertex belongs to one triangle, the first of those that share it. Visits those of
  /// a triangle.
  template <class Visit> void visit_ridges(int triangle, Visit visit) const
  {
    for (int r = first_ridge[triangle]; r < first_ridge[triangle + 1]; r++) visit(ridges[r]);
  }
  template <class Visit> void visit_corners(int triangle, Visit visit) const
  {
    for (int c = first_corner[triangle]; c < first_corner[triangle + 1]; c++) visit(corners[c]);
  }
  /// Triangles that share a vertex of the mesh.
  template <class Visit> void visit_around(int vertex, Visit visit) const
  {
    for (int n = first_around[vertex]; n < first_around[vertex + 1]; n++) visit(around[n]);
  }

 private:
  void look_at_edges(const TriangleMesh &mesh, const MeshEdges &edges);
  void find_ridges(const TriangleMesh &mesh, const MeshEdges &edges);
  void join_pieces(const TriangleMesh &mesh);
  void find_around(const TriangleMesh &mesh);
  void find_corners(const TriangleMesh &mesh);

  std::vector<EdgeKind> edge_kinds;
  std::vector<int> neighbors;
  std::vector<Ridge> ridges;
  std::vector<Corner> corners;
  std::vector<int> first_ridge, first_corner, first_around, around;
};

}    // namespace Talus

#endif
