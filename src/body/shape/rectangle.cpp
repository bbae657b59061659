// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/rectangle.h"

#include "body/shape/mesh_shape.h"
#include "body/shape/surface_visitor.h"

#include <algorithm>
#include <cmath>

namespace Talus {

Rectangle::Rectangle(const Vector3<double> &center, const Vector3<double> &n,
                     const Vector3<double> &first_edge, double first_length, double second_length,
                     bool both) :
    middle(center),
    normal(n), first(first_edge), second(cross(n, first_edge)), first_half(0.5 * first_length),
    second_half(0.5 * second_length), two_sided(both)
{
}

Vector3<double> Rectangle::from_nearest(const Vector3<double> &center, double &height,
                                        bool &above) const
{
  const Vector3<double> d = center - middle;
  const double a = dot(d, first), b = dot(d, second);
  const double outside_a = a - std::clamp(a, -first_half, first_half);
  const double outside_b = b - std::clamp(b, -second_half, second_half);
  height = dot(d, normal);
  above = outside_a == 0.0 && outside_b == 0.0;
  return outside_a * first + outside_b * second + height * normal;
}

bool Rectangle::touches(const Vector3<double> &center, double radius, SurfaceContact &contact) const
{
  double height;
  bool above;
  const Vector3<double> away = from_nearest(center, height, above);
  if (height < 0.0 && !two_sided) return false;
  const double distance = std::sqrt(dot(away, away));
  if (distance >= radius) return false;
  contact.overlap = radius - distance;
  if (above)
    contact.normal = height < 0.0 ? -normal : normal;    // exact, also for a center in the plane
  else
    contact.normal = 1.0 / distance * away;
  return true;
}

double Rectangle::distance_bound(const Vector3<double> &center) const
{
  double height;
  bool above;
  const Vector3<double> away = from_nearest(center, height, above);
  return std::sqrt(dot(away, away));
}

double Rectangle::extent_from(const Vector3<double> &point) const
{
  return length(point - middle) + std::hypot(first_half, second_half);
}

void Rectangle::tessellate(const Eigen::AlignedBox3d & /*visible*/,
                           std::vector<Triangle> &triangles) const
{
  const Vector3<double> u = first_half * first, v = second_half * second;
  triangles.push_back({{middle - u - v, middle + u - v, middle + u + v}});
  triangles.push_back({{middle - u - v, middle + u + v, middle - u + v}});
}

/* As a mesh of two triangles. */

void Rectangle::visit_surfaces(SurfaceVisitor &visitor) const
{
  std::vector<Triangle> triangles;
  tessellate({}, triangles);
  visitor.mesh(std::make_shared<const MeshShape>(TriangleMesh(triangles),
                                                 two_sided ? MeshSide::BOTH : MeshSide::NORMALS));
}

}    // namespace Talus
