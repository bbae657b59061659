// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/wall_planes.h"

#include "base/lanes.h"

#include <cmath>

namespace Talus {

void WallPlanes::place(int across, double lower, double upper, const Vector3<double> &v)
{
  axis = across;
  low = lower;
  high = upper;
  velocity = v;
}

double WallPlanes::nearer(double x) const
{
  const double above = x - low, below = high - x;
  return above < below ? above : -below;
}

bool WallPlanes::touches(const Vector3<double> &center, double radius,
                         SurfaceContact &contact) const
{
  const double distance = nearer(along(center)), up = distance < 0.0 ? -1.0 : 1.0;
  if (!(up * distance < radius)) return false;
  contact.normal = {axis == 0 ? up : 0.0, axis == 1 ? up : 0.0, axis == 2 ? up : 0.0};
  contact.overlap = radius - up * distance;
  contact.part = along(center) - low < high - along(center) ? 0 : 1;
  contact.velocity = velocity;
  return true;
}

/* The same operations in the same order as for one. */

unsigned WallPlanes::touches_eight(const EightSpheres &spheres, int count,
                                   EightContacts &contacts) const
{
  const Vec8 x = load8(spheres.center[axis]), radius = load8(spheres.radius), zero{},
             one = splat<Vec8>(1.0);
  const Vec8 above = x - splat<Vec8>(low), below = splat<Vec8>(high) - x;
  const Vec8 distance = select(above < below, above, -below);
  const unsigned touching = less_bits(magnitude(distance), radius) & ((1U << count) - 1U);
  if (!touching) return 0;
  const Vec8 up = select(distance < zero, -one, one);
  for (int d = 0; d < 3; d++) store(contacts.normal[d], d == axis ? up : zero);
  store(contacts.overlap, radius - up * distance);
  store(contacts.velocity[0], splat<Vec8>(velocity.x));
  store(contacts.velocity[1], splat<Vec8>(velocity.y));
  store(contacts.velocity[2], splat<Vec8>(velocity.z));
  store(contacts.curvature, zero);
  const unsigned lower = less_bits(above, below);
  for (int k = 0; k < lanes; k++) contacts.part[k] = lower >> k & 1U ? 0 : 1;
  return touching;
}

/* Rounding must not hide a particle. */

unsigned WallPlanes::may_touch_eight(const EightSpheres &spheres) const
{
  const Vec8 x = load8(spheres.center[axis]), reach = splat<Vec8>(1.000001) * load8(spheres.radius);
  return less_bits(magnitude(x - splat<Vec8>(low)), reach) |
         less_bits(magnitude(splat<Vec8>(high) - x), reach);
}

double WallPlanes::distance_bound(const Vector3<double> &center) const
{
  return std::abs(nearer(along(center)));
}

}    // namespace Talus
