// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Whether a mesh may have its vertices at other places, and what follows from these for its contacts. The
// triangles at the old places are assumed to be right. Refused are
//
//   triangles without area
//   triangles that have turned over against a neighbor: the angle between the two is over 90 degrees and
//     has changed by more than this
//   triangles that cut each other: all pairs of which one has moved. Of those that share one vertex only
//     where not all triangles around it face one half of space, else they cannot.
//
// Pairs that may cut each other are listed, by a tree of boxes, with all that are not much further apart; the
// list holds until vertices have gone further than that, apart from what all have gone together.
//
// Numbers of triangles are those of the mesh, from 0. Images are not looked at: their own ones are.

#ifndef TALUS_BODY_SHAPE_MESH_CHECK_H
#define TALUS_BODY_SHAPE_MESH_CHECK_H

#include "body/shape/box_tree.h"
#include "body/shape/mesh_edges.h"
#include "body/shape/triangle_mesh.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Talus {

class MeshCheck {
 public:
  using Places = std::vector<Vector3<double>>;

  /// Must live as long as this; it is asked for its topology alone.
  explicit MeshCheck(const TriangleMesh &mesh);

  /// "", or for people: what is wrong. Both of all vertices.
  std::string problem(const Places &now, const Places &then);

  /// The same without a check.
  void look_at(const Places &places) { find_normals(places); }
  /// Of all triangles, images included, at the places of the last call of either: see
  /// TriangleMesh::patch(). They are others than those of the call before only if patches_change().
  bool patches_change();
  std::vector<int> patches() const;

  const MeshEdges &edges() const { return all_edges; }
  double memory_usage() const;

 private:
  struct Neighbors {
    int first, second, edge;    ///< own triangles; the second faces the same side as the first, or
    bool opposed;               ///< the other one
  };
  Triangle triangle(const Places &places, int t) const;
  std::string find_normals(const Places &places);
  std::string turned_over(const Places &now) const;
  double fold(const Neighbors &pair, const Places &places) const;
  void look_at_vertices();
  std::string crossing();
  bool list_holds() const;
  void list_pairs();
  template <class Visit> void visit_fans(Visit visit) const;
  bool cut(int a, int b) const;
  std::string name_of(int t, const Places &places) const;

  const TriangleMesh &mesh;
  const MeshEdges all_edges;
  std::vector<Neighbors> neighbors;            // that are alone at their edge
  std::vector<int> around_begin, around;       // own triangles of each vertex
  std::vector<std::array<int, 2>> at_edges;    // pairs that share one, images included
  std::vector<char> smooth;                    // the same: of one patch
  // of the last places
  const Places *to = nullptr;
  std::vector<Vector3<double>> normals;
  std::vector<bool> moved;              // triangles
  std::vector<unsigned char> is_fan;    // vertices: not all around it face one half of space
  std::vector<Eigen::AlignedBox3d> boxes;
  // pairs without a common vertex, and when they were listed: places, and the distance
  std::unique_ptr<BoxTree> tree;    // of the own triangles
  std::vector<std::array<int, 2>> pairs;
  Places listed_at;
  double margin = 0.0;
};

}    // namespace Talus

#endif
