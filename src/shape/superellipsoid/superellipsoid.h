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
// The height of the surface along a direction is known in closed form (its support function: the dual norm,
// with exponents n/(n - 1)), and so is the point at that height, with the normal along the direction.
// Immutable; lengths in the units of the script.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_H
#define TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_H

#include "base/power.h"
#include "shape/shape.h"

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

  const Vector3<double> &half_axes() const { return half; }
  double n1() const { return exponent1; }
  double n2() const { return exponent2; }
  bool is_ellipsoid() const { return exponent1 == 2.0 && exponent2 == 2.0; }

  /// The factor by which the shape must be scaled for x to be on its surface: F^(1/n1), below 1 inside. A norm.
  double gauge(const Vector3<double> &x) const;

  /// A point of the surface, the normal there (outward, a unit vector), and how fast it turns.
  struct Point {
    Vector3<double> place, normal;
    double height;    ///< normal . place: of the tangent plane above the center
    /// For tangents t, u: t . dn = t . B u if the point moves along u; B has but these components.
    double xx, yy, zz, xy;
    double curvature(const Vector3<double> &t, const Vector3<double> &u) const
    {
      return xx * t.x * u.x + yy * t.y * u.y + zz * t.z * u.z + xy * (t.x * u.y + t.y * u.x);
    }
  };
  /// Where the normal is this one (a unit vector).
  Point at_normal(const Vector3<double> &normal) const;
  /// Where the straight line from the center through x, which must not be the center, leaves the shape.
  Point on_ray(const Vector3<double> &x) const;
  /// Where it is nearest to the center.
  Point nearest_pole() const;

  /// As laws have it (1/length), see SurfaceRadius. Of flat places it is limited to a radius of ten bounding
  /// radii.
  double curvature_for_laws(const Point &point) const;

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
  /// A point of the surface in the octant x, y, z >= 0, in units of the half axes; and what its derivatives
  /// consist of: with rho = (x^n2 + y^n2)^(1/n2) the powers (x/rho)^(n2-1), (y/rho)^(n2-1), rho^(n1-1), z^(n1-1).
  struct UnitPoint {
    double x, y, z, rho;
    double x_power, y_power, rho_power, z_power;
  };
  UnitPoint unit_point_at(const Vector3<double> &normal, double &height) const;
  Point point(const UnitPoint &u, const Vector3<double> &signs_from) const;
  Point ellipsoid_point(const Vector3<double> &place, const Vector3<double> &normal,
                        double height) const;
  void find_mass();
  void find_least_radius();

  Vector3<double> half, square{}, inverse_square{};    // the last two of the half axes
  double exponent1, exponent2;
  struct Powers {    // of n: n, n - 1, and their inverse values
    Power whole, less, root, root_of_less;
    explicit Powers(double n) :
        whole(n), less(n - 1.0), root(1.0 / n), root_of_less(1.0 / (n - 1.0))
    {
    }
  };
  Powers powers1, powers2;
  Power ratio;    // n1/n2
  SurfaceRadius radius_kind;
  double outer, inner, volume_, least_radius, least_curvature;
  Eigen::Vector3d moments;
};

}    // namespace Talus

#endif
