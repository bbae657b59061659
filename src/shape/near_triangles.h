// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_NEAR_TRIANGLES_H
#define TALUS_SHAPE_NEAR_TRIANGLES_H

#include "body/shape/mesh_shape.h"

#include <vector>

namespace Talus {

/// A triangle near a particle that faces its center.
struct NearTriangle {
  int triangle, part;        ///< of the mesh; of its detail
  double side;               ///< 1: the center is where its normal points to; -1: on the other side
  Vector3<double> normal;    ///< toward the center
  double offset;             ///< of its plane
  double height(const Vector3<double> &x) const { return dot(normal, x) - offset; }
};

/// Fills `parts` with what of the surface is nearer to the center than `reach`, and `near` with the triangles
/// among them that act on the side of the center; returns whether there are such. In the frame of the mesh.
bool find_near_triangles(const MeshShape &mesh, const Vector3<double> &center, double reach,
                         std::vector<NearPart> &parts, std::vector<NearTriangle> &near);

}    // namespace Talus

#endif
