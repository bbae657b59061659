// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_BOX_H
#define TALUS_BODY_SHAPE_BOX_H

#include "body/shape/large_body_shape.h"

namespace Talus {

/// A box with edges along the axes of its frame.
///
/// Outside: a sphere touches the nearest point of the box; the normal turns continuously around
/// edges and corners. A center inside is pushed out through the nearest face, up to one radius
/// deep. Inside: a sphere touches every face that it reaches, so up to three in a corner and all six
/// of a box that is narrower than it, up to a center one radius behind a face.
class Box : public LargeBodyShape {
 public:
  /// `edges`: the three lengths, > 0.
  Box(const Vector3<double> &center, const Vector3<double> &edges, bool inside);

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return middle; }
  double extent_from(const Vector3<double> &point) const override;
  int most_contacts() const override { return inside ? 6 : 1; }
  int find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                    SurfaceContact *found) const override;
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;
  void visit_surfaces(SurfaceVisitor &visitor) const override;

 private:
  bool touches_from_outside(const Vector3<double> &center, double radius,
                            SurfaceContact &contact) const;
  int touched_from_inside(const Vector3<double> &center, double radius,
                          SurfaceContact *found) const;

  Vector3<double> middle;
  double half[3];
  bool inside;
};

}    // namespace Talus

#endif
