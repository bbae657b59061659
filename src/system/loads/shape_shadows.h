// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How large particles with a shape are as a fluid sees them: surfaces and cross sections over those of spheres of their
// volume. Of convex shapes a cross section is half the sum of the faces' projections. Round surfaces are triangles with
// corners on them, enlarged to the volume of the shape: within 0.2 %.

#ifndef TALUS_SYSTEM_LOADS_SHAPE_SHADOWS_H
#define TALUS_SYSTEM_LOADS_SHAPE_SHADOWS_H

#include "base/linear_algebra.h"
#include "shape/contact/shape_table.h"

#include <vector>

namespace Talus {

class ShapeShadows {
 public:
  /// Surface of the sphere with the volume of the shape over that of the shape; up to 1.
  double sphericity(int type, const ParticleShape &shape);
  /// Cross section of the sphere with the volume of the shape over that of the shape as it is turned, seen along a
  /// direction (any length but 0).
  double crosswise(int type, const ParticleShape &shape, const double *quaternion,
                   const Vector3<double> &direction);

 private:
  struct Surface {
    std::vector<Vector3<double>>
        faces;    ///< half of their areas along normals, over the cross section of the sphere
    double sphericity = 1.0;
  };
  const Surface &surface_of(int type, const ParticleShape &shape);

  std::vector<Surface> by_type;    // as they are asked for
};

}    // namespace Talus

#endif
