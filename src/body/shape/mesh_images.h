// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A mesh that ends on faces of a periodic box goes on behind them: with images of its triangles, so
// that particles feel no rim where the surface has none. Between two rebuilds of neighbor lists
// particles may be beyond a face, and those near a face reach over it.

#ifndef TALUS_BODY_SHAPE_MESH_IMAGES_H
#define TALUS_BODY_SHAPE_MESH_IMAGES_H

#include "base/linear_algebra.h"
#include "body/shape/mesh_edges.h"
#include "body/shape/mesh_seams.h"

#include <array>
#include <vector>

namespace Talus {

/// The box of a simulation with right angles, and along which edges it is periodic.
struct PeriodicEdges {
  Eigen::AlignedBox3d box;
  std::array<bool, 3> periodic{false, false, false};

  /// Those with a face on which something of this extent ends, without going further, but for
  /// usual_tolerance of the edge.
  std::array<bool, 3> ended(const Eigen::AlignedBox3d &extent) const;
  static constexpr double usual_tolerance = 1.0e-6;
};

struct MeshImages {
  std::vector<Corners> triangles;
  std::vector<int> own;    ///< of which triangle each of them is an image
  /// Of the vertices that are new, in their order: of which vertex, and how far away from it.
  struct Vertex {
    int own;
    Vector3<double> shift;
  };
  std::vector<Vertex> vertices;
};

/// Images, one period away along each of these edges, of all triangles; without those that are there already.
/// So a particle between the faces may reach, and one that is beyond them may be and reach, over them by a period.
/// `vertices` are those of the mesh; new ones are added.
MeshImages images_behind_faces(MeshVertices &vertices, const std::vector<Corners> &triangles,
                               const Eigen::AlignedBox3d &box, const std::array<bool, 3> &edges);

}    // namespace Talus

#endif
