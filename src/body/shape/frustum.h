// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_FRUSTUM_H
#define TALUS_BODY_SHAPE_FRUSTUM_H

#include "body/shape/inward_wall.h"
#include "body/shape/large_body_shape.h"

#include <vector>

namespace Talus {

/// A truncated cone with two flat caps; a cylinder if both radii are equal; an endless cylinder if
/// the length is infinite as well.
///
/// Outside: a sphere touches the nearest point; the normal turns continuously around the rims. A
/// center inside is pushed out through the nearest face, up to one radius deep. Inside: a sphere
/// touches the lateral surface (part 0) and each cap (1 and 2) that it reaches, taken as continued
/// beyond the rims, up to a center one radius behind; it touches the lateral surface at one point
/// only, so that a sphere wider than the cone is not held. A cap of radius 0 is not there. Where
/// the nearest point of the lateral surface is undefined, on the axis, a fixed direction is taken.
///
/// Open: the lateral surface alone, without thickness and caps, touched from inside and outside at
/// its nearest point, which may be on a rim.
class Frustum : public LargeBodyShape {
 public:
  /// `axis`: unit vector; `low`: radius at -length/2 along it, `high` at +length/2. Radii >= 0, one
  /// of them > 0; length > 0; infinite only if the radii are equal.
  Frustum(const Vector3<double> &center, const Vector3<double> &axis, double low, double high,
          double length, bool inside, bool open = false);

  bool is_infinite() const { return infinite; }
  /// The edge of a cap, 0 at the low end, 1 at the high one.
  struct Rim {
    Vector3<double> center;
    Vector3<double> axis;    ///< out of the cap, a unit vector
    Vector3<double> side;    ///< a unit vector normal to it
    double radius;
  };
  Rim rim(int end) const
  {
    const double s = end ? 1.0 : -1.0;
    return {middle + s * half * axis, s * axis, side, end ? high : low};
  }

  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  double distance_bound(const Vector3<double> &center) const override;
  Vector3<double> reference_point() const override { return middle; }
  double extent_from(const Vector3<double> &point) const override;
  int most_contacts() const override { return inside && !infinite && !open ? 3 : 1; }
  int find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                    SurfaceContact *found) const override;
  void tessellate(const Eigen::AlignedBox3d &visible,
                  std::vector<Triangle> &triangles) const override;
  void visit_surfaces(SurfaceVisitor &visitor) const override;

 private:
  /// A point in the plane through the axis: rho from the axis, s along it; and the unit vector away
  /// from the axis.
  struct Meridian {
    double rho, s;
    Vector3<double> away;
  };
  Meridian meridian(const Vector3<double> &center) const;
  /// Heights above lateral surface, low cap and high cap, positive inside.
  void depths(const Meridian &m, double (&depth)[3]) const;
  Vector3<double> inward(const Meridian &m, int face) const;
  /// Vector (rho, s) from the nearest point of the outline, for points outside.
  void from_outline(const Meridian &m, double &rho, double &s) const;

  /// Of the lateral surface alone.
  void from_lateral(const Meridian &m, double &rho, double &s) const;

  std::vector<InwardWall> walls() const;
  bool touches_open(const Vector3<double> &center, double radius, SurfaceContact &contact) const;
  bool touches_from_outside(const Vector3<double> &center, double radius,
                            SurfaceContact &contact) const;
  int touched_from_inside(const Vector3<double> &center, double radius,
                          SurfaceContact *found) const;

  Vector3<double> middle, axis, side;    // side: unit vector normal to the axis
  double low, high, half;
  double normal_rho, normal_s;    // outward normal of the lateral surface
  bool inside, infinite, open;
};

}    // namespace Talus

#endif
