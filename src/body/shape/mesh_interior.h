// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which points are inside a closed mesh. Made for a few questions, then thrown away.

#ifndef TALUS_BODY_SHAPE_MESH_INTERIOR_H
#define TALUS_BODY_SHAPE_MESH_INTERIOR_H

#include "body/shape/box_tree.h"
#include "body/shape/triangle_mesh.h"

namespace Talus {

class MeshInterior {
 public:
  /// The mesh must be closed, and must live as long as this.
  explicit MeshInterior(const TriangleMesh &mesh);

  /// Whether a ray from the point meets the surface an odd number of times; the orientation of
  /// triangles does not matter. On the surface either answer may be given.
  bool contains(const Vector3<double> &point) const;

 private:
  bool ray_passes(int triangle, const Vector3<double> &point) const;

  const TriangleMesh &mesh;
  BoxTree tree;    // of the triangles seen along the ray
};

}    // namespace Talus

#endif
