// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/plane.h"

#include "base/lanes.h"
#include "base/linear_algebra.h"
#include "body/shape/surface_visitor.h"

#include <cmath>
#include <limits>

namespace Talus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The part of a convex polygon where inward . x >= least.
std::vector<Vector3<double>> clipped(const std::vector<Vector3<double>> &polygon,
                                     const Vector3<double> &inward, double least)
{
  std::vector<Vector3<double>> kept;
  for (std::size_t k = 0; k < polygon.size(); k++) {
    const Vector3<double> &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double ha = dot(a, inward) - least, hb = dot(b, inward) - least;
    if (ha >= 0.0) kept.push_back(a);
    if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0))
      kept.push_back(a + ha / (ha - hb) * (b - a));
  }
  return kept;
}

}    // namespace

Plane::Plane(const Vector3<double> &p, const Vector3<double> &n, bool both) :
    point(p), normal(n), two_sided(both)
{
}

bool Plane::touches(const Vector3<double> &center, double radius, SurfaceContact &contact) const
{
  const double height = dot(center - point, normal);
  if (std::fabs(height) >= radius) return false;
  const bool flip = two_sided && height < 0.0;
  contact.normal = flip ? -normal : normal;
  contact.overlap = radius - (flip ? -height : height);
  return true;
}

/* The same operations in the same order as for one. */

unsigned Plane::touches_eight(const EightSpheres &spheres, int count, EightContacts &contacts) const
{
  const Vector3<Vec8> center{load8(spheres.center[0]), load8(spheres.center[1]),
                             load8(spheres.center[2])};
  const Vector3<Vec8> n = in_all_lanes<Vec8>(normal);
  const Vec8 height = dot(center - in_all_lanes<Vec8>(point), n), radius = load8(spheres.radius);
  const Vec8 away = magnitude(height);
  const bool_of<Vec8> flip = height < splat<Vec8>(two_sided ? 0.0 : -infinity);
  const Vector3<Vec8> outward = select(flip, -n, n);
  store(contacts.normal[0], outward.x);
  store(contacts.normal[1], outward.y);
  store(contacts.normal[2], outward.z);
  store(contacts.overlap, radius - select(flip, -height, height));
  return less_bits(away, radius) & ((1U << count) - 1U);
}

double Plane::distance_bound(const Vector3<double> &center) const
{
  return std::fabs(dot(center - point, normal));
}

/* A square larger than what is visible, cut off at its sides. */

void Plane::tessellate(const Eigen::AlignedBox3d &visible, std::vector<Triangle> &triangles) const
{
  const Vector3<double> span = from_eigen(visible.sizes());
  const Vector3<double> center = from_eigen(visible.center());
  const Vector3<double> foot = center - dot(center - point, normal) * normal;
  const Vector3<double> axis =
      std::fabs(normal.x) < 0.6 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const double reach = 2.0 * std::sqrt(dot(span, span));
  Vector3<double> u = cross(normal, axis);
  u = reach / std::sqrt(dot(u, u)) * u;
  const Vector3<double> v = cross(normal, u);
  std::vector<Vector3<double>> polygon{foot - u - v, foot + u - v, foot + u + v, foot - u + v};
  const Vector3<double> axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const Vector3<double> &e : axes) {
    polygon = clipped(polygon, e, dot(from_eigen(visible.min()), e));
    polygon = clipped(polygon, -e, -dot(from_eigen(visible.max()), e));
  }
  for (std::size_t k = 1; k + 1 < polygon.size(); k++)
    triangles.push_back({{polygon[0], polygon[k], polygon[k + 1]}});
}

void Plane::visit_surfaces(SurfaceVisitor &visitor) const
{
  visitor.flat(normal, point, two_sided, 0);
}

}    // namespace Talus
