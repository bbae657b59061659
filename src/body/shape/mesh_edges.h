// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which triangles share an edge. Needed while a mesh is built, and thrown away then.

#ifndef TALUS_BODY_SHAPE_MESH_EDGES_H
#define TALUS_BODY_SHAPE_MESH_EDGES_H

#include <vector>

namespace Talus {

/// Numbers of the three vertices of a triangle.
struct Corners {
  int vertex[3];

  bool runs_along(int from, int to) const
  {
    for (int k = 0; k < 3; k++)
      if (vertex[k] == from && vertex[(k + 1) % 3] == to) return true;
    return false;
  }
};

class MeshEdges {
 public:
  struct Edge {
    int vertex[2];                ///< the lower number first
    int first_user, num_users;    ///< range of users()
  };

  explicit MeshEdges(const std::vector<Corners> &triangles);

  const std::vector<Edge> &all() const { return edges; }
  /// Triangles of an edge, ascending.
  const int *users(const Edge &edge) const { return &edge_users[edge.first_user]; }
  /// Edge k of a triangle goes from its corner k to the next.
  const Edge &of(int triangle, int k) const { return edges[edges_of[3L * triangle + k]]; }

 private:
  std::vector<Edge> edges;
  std::vector<int> edge_users, edges_of;
};

}    // namespace Talus

#endif
