// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_PLANE_H
#define TALUS_BODY_SHAPE_PLANE_H

#include "body/shape/large_body_shape.h"

namespace Talus {

/// The infinite plane n . (x - p) = 0; particles are where n points to. One-sided, it pushes along
/// n every sphere that reaches it, up to a center one radius behind the plane: a deep impact is not
/// turned into a push out on the wrong side. Two-sided, it pushes to the side on which the center
/// is.
class Plane : public LargeBodyShape {
 public:
  /// `normal` must be a unit vector.
  Plane(const Vector3<double> &point, const Vector3<double> &normal, bool two_sided);

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  unsigned touches_eight(const EightSpheres &spheres, int count,
                         EightContacts &contacts) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return point; }
  bool has_one_normal() const override { return true; }
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;
  void visit_surfaces(SurfaceVisitor &visitor) const override;

 private:
  Vector3<double> point, normal;
  bool two_sided;
};

}    // namespace Talus

#endif
