// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The shape of ellipsoids and superellipsoids: in its frame the points with
//
//   F = (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1,
//
// n1, n2 >= 2: an ellipsoid of both are 2, the nearer to a cylinder the larger n1 is with n2 = 2, and the
// nearer to a box the larger both are; A. H. Barr, IEEE Comput. Graph. Appl. 1, 11 (1981). The surface has a
// normal everywhere and bends outward; where exponents are above 2 it is flat in places.
//
// Immutable; lengths in the units of the script.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_H
#define TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_H

#include "shape/shape.h"
#include "shape/superellipsoid/superellipsoid_surface.h"

#include <vector>

namespace Talus {

/// What contacts tell the laws as the radius of the surface: that of its mean curvature or Gaussian curvature
/// where it is touched, or everywhere that of the sphere of the same volume.
enum class SurfaceRadius { MEAN, GAUSSIAN, VOLUME };

class Superellipsoid final : public Shape {
 public:
  static constexpr double least_exponent = 2.0, largest_exponent = 20.0;

  /// Half axes > 0; exponents from 2 to 20. Throws std::runtime_error with a text that says what is wrong.
  Superellipsoid(const Vector3<double> &half_axes, double n1, double n2,
                 SurfaceRadius surface_radius = SurfaceRadius::MEAN);

  const Vector3<double> &half_axes() const { return formula.half_axes(); }
  double n1() const { return formula.n1(); }
  double n2() const { return formula.n2(); }
  bool is_ellipsoid() const { return formula.is_ellipsoid(); }
  /// For eight points at a time.
  const SuperellipsoidSurface &formulas() const { return formula; }

  using Point = PointWithNormal<double>;
  /// The factor by which the shape must be scaled for x to be on its surface: F^(1/n1), below 1 inside. A norm.
  double gauge(const Vector3<double> &x) const;
  /// Where the normal is this one (a unit vector).
  Point at_normal(const Vector3<double> &normal) const;
  /// Where the straight line from the center through x, which must not be the center, leaves the shape.
  Point on_ray(const Vector3<double> &x) const;
  /// Where it is nearest to the center.
  Point nearest_pole() const;

  /// As laws have it (1/length), see SurfaceRadius. Of flat places it is limited to a radius of ten bounding
  /// radii.
  template <class Real> Real curvature_for_laws(const PointWithNormal<Real> &point) const;

  const char *name() const override { return "superellipsoid"; }
  double bounding_radius() const override { return outer; }
  double inscribed_radius() const override { return inner; }
  /// A. Jaklic, F. Solina, Comput. Vis. Image Underst. 90, 1 (2003): with the function Beta.
  double volume() const override { return volume_; }
  Eigen::Vector3d principal_moments() const override { return moments; }
  double contact_radius() const override { return least_radius; }
  std::vector<HeldFace> held_faces() const override;
  std::vector<Triangle> surface(int pieces) const override;
  double memory_usage() const override { return sizeof(*this); }

 private:
  void find_mass();
  void find_least_radius();

  SuperellipsoidSurface formula;
  SurfaceRadius radius_kind;
  double outer, inner, volume_, least_radius, least_curvature, curvature_by_volume;
  Eigen::Vector3d moments;
};

template <class Real>
Real Superellipsoid::curvature_for_laws(const PointWithNormal<Real> &point) const
{
  if (radius_kind == SurfaceRadius::VOLUME) return splat<Real>(curvature_by_volume);
  const Real zero = splat<Real>(0.0);
  const Vector3<Real> &n = point.normal;
  Vector3<Real> t = select(magnitude(n.x) < splat<Real>(0.6), Vector3<Real>{zero, -n.z, n.y},
                           Vector3<Real>{-n.y, n.x, zero});
  t = (1.0 / size_of(t)) * t;
  const Vector3<Real> u = cross(n, t);
  const Real tt = point.curvature(t, t), uu = point.curvature(u, u), tu = point.curvature(t, u);
  const Real curvature = radius_kind == SurfaceRadius::MEAN
                             ? 0.5 * (tt + uu)
                             : square_root(larger(tt * uu - tu * tu, zero));
  return larger(curvature, splat<Real>(least_curvature));
}

}    // namespace Talus

#endif
