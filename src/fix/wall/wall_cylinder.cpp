// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/wall_cylinder.h"

#include "base/lanes.h"

#include <cmath>

namespace Talus {

/* LAMMPS takes the diameter for the radius. */

bool WallCylinder::touches(const Vector3<double> &center, double sphere,
                           SurfaceContact &contact) const
{
  const double r = std::sqrt(center.x * center.x + center.y * center.y), inwards = radius - r;
  if (!(std::abs(inwards) < sphere)) return false;
  const double side = inwards < 0.0 ? 1.0 : -1.0;
  contact.normal = {side / r * center.x, side / r * center.y, 0.0};
  contact.overlap = sphere - std::abs(inwards);
  contact.part = -1;
  contact.curvature = (r < radius ? -0.5 : 0.5) / radius;
  contact.velocity = velocity;
  return true;
}

/* Rounding must not hide a particle. */

unsigned WallCylinder::may_touch_eight(const EightSpheres &spheres) const
{
  const Vec8 x = load8(spheres.center[0]), y = load8(spheres.center[1]);
  return less_bits(magnitude(splat<Vec8>(radius) - square_root(x * x + y * y)),
                   splat<Vec8>(1.000001) * load8(spheres.radius));
}

double WallCylinder::distance_bound(const Vector3<double> &center) const
{
  return std::abs(radius - std::sqrt(center.x * center.x + center.y * center.y));
}

}    // namespace Talus
