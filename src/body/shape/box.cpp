// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/box.h"

#include "body/shape/surface_visitor.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

Vector3<double> unit(int axis, double sign)
{
  return {axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0};
}

}    // namespace

Box::Box(const Vector3<double> &center, const Vector3<double> &edges, bool in) :
    middle(center), half{0.5 * edges.x, 0.5 * edges.y, 0.5 * edges.z}, inside(in)
{
}

bool Box::touches(const Vector3<double> &center, double radius, SurfaceContact &contact) const
{
  if (!inside) return touches_from_outside(center, radius, contact);
  SurfaceContact found[6];
  const int count = touched_from_inside(center, radius, found);
  if (count) contact = found[0];
  return count > 0;
}

int Box::find_contacts(const Vector3<double> &center, double radius, NearParts /*parts*/,
                       SurfaceContact *found) const
{
  if (inside) return touched_from_inside(center, radius, found);
  return touches_from_outside(center, radius, *found) ? 1 : 0;
}

bool Box::touches_from_outside(const Vector3<double> &center, double radius,
                               SurfaceContact &contact) const
{
  const Vector3<double> d = center - middle;
  const double at[3] = {d.x, d.y, d.z};
  double beyond[3], square = 0.0;
  int outside = 0, nearest = 0;
  for (int k = 0; k < 3; k++) {
    beyond[k] = std::fabs(at[k]) - half[k];
    if (beyond[k] > beyond[nearest]) nearest = k;
    if (beyond[k] <= 0.0) continue;
    square += beyond[k] * beyond[k];
    outside++;
  }
  contact.part = 0;
  if (outside <= 1) {    // above a face, or inside
    if (std::fabs(beyond[nearest]) >= radius) return false;
    contact.normal = unit(nearest, std::copysign(1.0, at[nearest]));
    contact.overlap = radius - beyond[nearest];
    return true;
  }
  const double distance = std::sqrt(square);
  if (distance >= radius) return false;
  double n[3];
  for (int k = 0; k < 3; k++)
    n[k] = beyond[k] > 0.0 ? std::copysign(beyond[k], at[k]) / distance : 0.0;
  contact.normal = {n[0], n[1], n[2]};
  contact.overlap = radius - distance;
  return true;
}

int Box::touched_from_inside(const Vector3<double> &center, double radius,
                             SurfaceContact *found) const
{
  const Vector3<double> d = center - middle;
  const double at[3] = {d.x, d.y, d.z};
  int count = 0;
  for (int face = 0; face < 6; face++) {
    const int axis = face / 2;
    const double side = face % 2 ? 1.0 : -1.0;
    const double height = half[axis] - side * at[axis];
    if (height <= -radius) return 0;
    if (height < radius) found[count++] = {unit(axis, -side), radius - height, face};
  }
  sort_contacts(found, count);
  return count;
}

double Box::distance_bound(const Vector3<double> &center) const
{
  const Vector3<double> d = center - middle;
  const double x = std::fabs(d.x) - half[0], y = std::fabs(d.y) - half[1],
               z = std::fabs(d.z) - half[2];
  const double deepest = std::max({x, y, z});
  if (deepest <= 0.0) return -deepest;
  const double a = std::max(x, 0.0), b = std::max(y, 0.0), c = std::max(z, 0.0);
  // a particle outside a box that holds particles is that far behind a face
  return inside ? deepest : std::sqrt(a * a + b * b + c * c);
}

/* Inside, faces go on beyond the edges. */

double Box::extent_from(const Vector3<double> &point) const
{
  if (inside) return LargeBodyShape::extent_from(point);
  return length(point - middle) + length(Vector3<double>{half[0], half[1], half[2]});
}

void Box::tessellate(const Eigen::AlignedBox3d & /*visible*/,
                     std::vector<Triangle> &triangles) const
{
  for (int axis = 0; axis < 3; axis++)
    for (const double side : {-1.0, 1.0}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const Vector3<double> face = middle + side * half[axis] * unit(axis, 1.0);
      const Vector3<double> a = half[u] * unit(u, 1.0), b = side * half[v] * unit(v, 1.0);
      triangles.push_back({{face - a - b, face + a - b, face + a + b}});
      triangles.push_back({{face - a - b, face + a + b, face - a + b}});
    }
}

/* The faces from inside are numbered as touched_from_inside() does. */

void Box::visit_surfaces(SurfaceVisitor &visitor) const
{
  const Vector3<double> to_corner{half[0], half[1], half[2]};
  if (!inside) return visitor.box(middle, 2.0 * to_corner);
  for (const double sign : {1.0, -1.0}) {
    const int face = sign > 0.0 ? 0 : 1;
    const Vector3<double> corner = middle - sign * to_corner;
    visitor.flat({sign, 0.0, 0.0}, corner, false, face);
    visitor.flat({0.0, sign, 0.0}, corner, false, face + 2);
    visitor.flat({0.0, 0.0, sign}, corner, false, face + 4);
  }
}

}    // namespace Talus
