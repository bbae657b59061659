// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Shapes and poses for tests of convex particles.

#ifndef TALUS_TESTS_CONVEX_BODIES_H
#define TALUS_TESTS_CONVEX_BODIES_H

#include "random_source.h"
#include "shape/convex/convex_shape.h"
#include "shape/shape_contact.h"

#include <array>
#include <cmath>
#include <vector>

namespace Talus {

using Points = std::vector<Vector3<double>>;

/// The corners of a regular dodecahedron with edges of length 1.
inline Points dodecahedron_corners()
{
  const double phi = 0.5 * (1.0 + std::sqrt(5.0)), s = 0.5 * phi;
  Points corners;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) corners.push_back({s * a, s * b, s * c});
      corners.push_back({0.0, s * a / phi, s * b * phi});
      corners.push_back({s * a / phi, s * b * phi, 0.0});
      corners.push_back({s * a * phi, 0.0, s * b / phi});
    }
  return corners;
}

inline Eigen::Quaterniond turned(double angle, double x, double y, double z)
{
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d(x, y, z).normalized()));
}
inline const Eigen::Quaterniond straight = Eigen::Quaterniond::Identity();

/// Force and torque about the origin on the first shape, with springs of stiffness 1.
struct Load {
  Vector3<double> force{0.0, 0.0, 0.0}, torque{0.0, 0.0, 0.0};
};
inline Load load_of(const ShapeContacts &contacts)
{
  Load load;
  for (const ShapeContact &c : contacts.points) {
    const Vector3<double> f = (c.weight * c.overlap) * c.normal;
    load.force = load.force + f;
    load.torque = load.torque + cross(c.position, f);
  }
  return load;
}

class RandomBodies : public RandomSource {
 public:
  using RandomSource::RandomSource;

  Vector3<double> direction()
  {
    const std::array<double, 3> d = unit_vector();
    return {d[0], d[1], d[2]};
  }
  Eigen::Quaterniond orientation()
  {
    for (;;) {
      double part[4];    // one after the other: the order of arguments is the compiler's
      for (int k = 3; k >= 0; k--) part[k] = uniform(-1.0, 1.0);
      const Eigen::Quaterniond q(part[0], part[1], part[2], part[3]);
      if (q.norm() > 0.1 && q.norm() < 1.0) return q.normalized();
    }
  }
  /// Corners on a sphere that is stretched along the axes.
  Points corners(int count, const Vector3<double> &half)
  {
    Points points;
    for (int k = 0; k < count; k++) {
      const Vector3<double> d = direction();
      points.push_back({half.x * d.x, half.y * d.y, half.z * d.z});
    }
    return points;
  }
};

}    // namespace Talus

#endif
