// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_FIX_WALL_WALL_PLANES_H
#define TALUS_FIX_WALL_WALL_PLANES_H

#include "body/shape/large_body_shape.h"

namespace Talus {

/// The planes of a fix wall/gran: one or two, across an axis. A sphere touches the nearer one.
class WallPlanes : public LargeBodyShape {
 public:
  /// In each step: 0 ... 2; where the planes are, and their velocity.
  void place(int across, double lower, double upper, const Vector3<double> &v);
  /// 0: the lower one, 1: the upper one.
  double place_of(int side) const { return side ? high : low; }

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  unsigned touches_eight(const EightSpheres &spheres, int count,
                         EightContacts &contacts) const override;
  unsigned may_touch_eight(const EightSpheres &spheres) const override;
  double distance_bound(const Vector3<double> &center) const override;
  bool describes_surface() const override { return true; }
  Vector3<double> reference_point() const override { return {0.0, 0.0, 0.0}; }

 private:
  double along(const Vector3<double> &x) const { return axis == 0 ? x.x : axis == 1 ? x.y : x.z; }
  /// From the nearer plane to x along the axis.
  double nearer(double x) const;

  int axis = 0;
  double low = 0.0, high = 0.0;
  Vector3<double> velocity{0.0, 0.0, 0.0};
};

}    // namespace Talus

#endif
