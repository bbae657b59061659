// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/plane.h"

#include <cmath>

namespace Talus {

Plane::Plane(const Vector3<double> &p, const Vector3<double> &n, bool both) :
    point(p), normal(n), two_sided(both)
{
}

bool Plane::touches(const Vector3<double> &centre, double radius, SurfaceContact &contact) const
{
  const double height = dot(centre - point, normal);
  if (std::fabs(height) >= radius) return false;
  const bool flip = two_sided && height < 0.0;
  contact.normal = flip ? -normal : normal;
  contact.overlap = radius - (flip ? -height : height);
  return true;
}

double Plane::distance_bound(const Vector3<double> &centre) const
{
  return std::fabs(dot(centre - point, normal));
}

}    // namespace Talus
