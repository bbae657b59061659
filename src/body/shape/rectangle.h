// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_RECTANGLE_H
#define TALUS_BODY_SHAPE_RECTANGLE_H

#include "body/shape/large_body_shape.h"

namespace Talus {

/// A flat rectangle without thickness; particles are where its normal points to. A sphere beside it
/// touches the nearest point of its edges and corners, and the normal of the contact turns
/// continuously. One-sided, only spheres whose center is on the side of the normal are touched:
/// whatever is behind the rectangle does not feel it.
class Rectangle : public LargeBodyShape {
 public:
  /// `normal` and `first_edge` must be perpendicular unit vectors; lengths are those of the edges
  /// along first_edge and along normal x first_edge.
  Rectangle(const Vector3<double> &center, const Vector3<double> &normal,
            const Vector3<double> &first_edge, double first_length, double second_length,
            bool two_sided);

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return middle; }
  double extent_from(const Vector3<double> &point) const override;
  bool is_flat() const override { return true; }    // but for its edges
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;
  void visit_surfaces(SurfaceVisitor &visitor) const override;

 private:
  /// Vector from the nearest point of the rectangle to `center`; `above`: that point is inside it.
  Vector3<double> from_nearest(const Vector3<double> &center, double &height, bool &above) const;

  Vector3<double> middle, normal, first, second;
  double first_half, second_half;
  bool two_sided;
};

}    // namespace Talus

#endif
