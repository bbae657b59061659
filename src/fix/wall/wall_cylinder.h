// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_FIX_WALL_WALL_CYLINDER_H
#define TALUS_FIX_WALL_WALL_CYLINDER_H

#include "body/shape/large_body_shape.h"

namespace Talus {

/// The cylinder of a fix wall/gran, which older LAMMPS has: about the z axis, touched from inside and
/// outside.
class WallCylinder : public LargeBodyShape {
 public:
  /// In each step.
  void place(double r, const Vector3<double> &v)
  {
    radius = r;
    velocity = v;
  }

  bool touches(const Vector3<double> &center, double sphere,
               SurfaceContact &contact) const override;
  unsigned may_touch_eight(const EightSpheres &spheres) const override;
  double distance_bound(const Vector3<double> &center) const override;
  bool describes_surface() const override { return true; }
  Vector3<double> reference_point() const override { return {0.0, 0.0, 0.0}; }

 private:
  double radius = 0.0;
  Vector3<double> velocity{0.0, 0.0, 0.0};
};

}    // namespace Talus

#endif
