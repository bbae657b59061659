// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_BALL_H
#define TALUS_BODY_SHAPE_BALL_H

#include "body/shape/large_body_shape.h"

namespace Talus {

/// A spherical body; particles are outside or inside. It pushes along the radius every sphere that
/// reaches it, up to a center one radius behind the surface. A sphere whose center is that of the
/// body has no direction to be pushed to and is not touched.
class Ball : public LargeBodyShape {
 public:
  Ball(const Vector3<double> &center, double radius, bool inside);

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return middle; }
  double extent_from(const Vector3<double> &point) const override;
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;
  void visit_surfaces(SurfaceVisitor &visitor) const override;

 private:
  Vector3<double> middle;
  double size;
  bool inside;
};

}    // namespace Talus

#endif
