// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/wall_cylinder.h"

#include "base/lanes.h"

#include <cmath>

namespace Talus {

bool WallCylinder::touches(const Vector3<double> &center, double sphere,
                           SurfaceContact &contact) const
{
  const double r = std::sqrt(center.x * center.x + center.y * center.y), inwards = radius - r;
  if (!(std::abs(inwards) < sphere)) return false;
  const double side = inwards < 0.0 ? 1.0 : -1.0;
  contact.normal = {side / r * center.x, side / r * center.y, 0.0};
  contact.overlap = sphere - std::abs(inwards);
  return true;
}

unsigned WallCylinder::may_touch(const EightSpheres &spheres, bool /*listed*/) const
{
  const Vec8 x = load8(spheres.center[0]), y = load8(spheres.center[1]);
  return less_bits(magnitude(splat<Vec8>(radius) - square_root(x * x + y * y)),
                   load8(spheres.radius));
}

/* LAMMPS takes the diameter for the radius. */

WallSurface::Point WallCylinder::point(const Vector3<double> &center) const
{
  const bool inside = std::sqrt(center.x * center.x + center.y * center.y) < radius;
  return {velocity, (inside ? -0.5 : 0.5) / radius, -1};
}

}    // namespace Talus
