// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What programs that write triangles leave apart where one surface is meant: corners that differ by
// rounding, and edges on which corners of other triangles lie (T-junctions). A sphere on such a seam
// would be pushed by both sides of it.

#ifndef TALUS_BODY_SHAPE_MESH_SEAMS_H
#define TALUS_BODY_SHAPE_MESH_SEAMS_H

#include "base/vector3.h"
#include "body/shape/mesh_edges.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace Talus {

/// Numbers the corners of triangles: one that is not further than the tolerance (length) from a
/// vertex that came before is that vertex.
class MeshVertices {
 public:
  explicit MeshVertices(double tolerance) : allowed(tolerance) {}

  /// Of the vertex at p, a new one if there is none.
  int at(const Vector3<double> &p);

  const std::vector<Vector3<double>> &all() const { return vertices; }
  /// Places that were not those of their vertices, and the largest distance (length) of one.
  int num_joined() const { return joined; }
  double largest_gap() const { return gap; }

 private:
  struct Hash {
    template <class Number> std::size_t operator()(const std::array<Number, 3> &x) const
    {
      std::size_t h = 0;
      for (const Number c : x) h = 1000003 * h + std::hash<Number>{}(c);
      return h;
    }
  };
  using Cell = std::array<long long, 3>;
  Cell cell_of(const Vector3<double> &p) const;
  int near(const Vector3<double> &p);

  const double allowed;
  std::vector<Vector3<double>> vertices;
  std::unordered_map<std::array<double, 3>, int, Hash> places;
  std::unordered_map<Cell, std::vector<int>, Hash> cells;    // with edges of `allowed`
  int joined = 0;
  double gap = 0.0;
};

/// Triangles of a mesh after those were divided on whose edges vertices of others lie.
struct DividedTriangles {
  std::vector<Corners> triangles;
  std::vector<int> divided;     ///< for each of them, the one that it is a part of
  int edges = 0, first = -1;    ///< number of such edges, and a triangle with one; -1: none
};

/// Edges and vertices count that belong to one triangle only; a vertex is on an edge if it is not
/// further from it than the tolerance (length), and no end of it.
DividedTriangles divide_at_vertices(const std::vector<Corners> &triangles,
                                    const std::vector<Vector3<double>> &vertices, double tolerance);

}    // namespace Talus

#endif
