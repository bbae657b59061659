// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids inside of a body. The distance of a wall that is flat or curved inward is a concave function of
// the place: from any point of the shape the way to that which is outermost along the direction of the wall leads
// nearer to it, and ends where the normals of both are opposite.

#include "body/shape/large_body_shape.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/touch.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Found = SuperellipsoidTouch::Found;

class Walls {
 public:
  Walls(const PlacedSuperellipsoid &placed, const LargeBodyShape &vessel) :
      a(placed), body(vessel), touch(placed.geometry, placed.pose),
      reach(4.0 * placed.geometry.bounding_radius())
  {
    const Superellipsoid &shape = a.geometry;
    const Vector half = shape.half_axes();
    for (const double side : {1.0, -1.0}) {
      pole[side > 0.0 ? 0 : 1] = a.pose.point_in_space({side * half.x, 0.0, 0.0});
      pole[side > 0.0 ? 2 : 3] = a.pose.point_in_space({0.0, side * half.y, 0.0});
      pole[side > 0.0 ? 4 : 5] = a.pose.point_in_space({0.0, 0.0, side * half.z});
    }
  }

  void find(ShapeContacts &contacts)
  {
    SurfaceContact around[LargeBodyShape::max_contacts];
    const int count = body.find_contacts(a.pose.position, reach, {nullptr, nullptr}, around);
    for (int k = 0; k < count; k++)
      if (reach - around[k].overlap < a.geometry.bounding_radius()) add_wall(around[k], contacts);
  }

 private:
  /// The wall `part` as seen from x: normal and distance.
  bool look(const Vector &x, int part, Vector &normal, double &distance) const
  {
    SurfaceContact found[LargeBodyShape::max_contacts];
    const int count = body.find_contacts(x, reach, {nullptr, nullptr}, found);
    for (int k = 0; k < count; k++)
      if (found[k].part == part) {
        normal = found[k].normal;
        distance = reach - found[k].overlap;
        return true;
      }
    return false;
  }
  /// From the direction of the wall to where the shape is nearest to it.
  bool approach(Vector normal, int part, Found &found) const
  {
    constexpr int most_steps = 200;
    constexpr double enough = 1.0e-15;
    double distance = 0.0;
    for (int step = 0; step < most_steps; step++) {
      const Vector before = normal;
      found = touch.plane(normal, 0.0);
      if (!look(found.place, part, normal, distance)) return false;
      const Vector turned = normal - before;
      if (dot(turned, turned) <= enough * enough) break;
    }
    found.normal = -normal;
    found.overlap = -distance;
    found.middle = found.place + 0.5 * found.overlap * normal;
    return found.overlap > 0.0;
  }
  void add_wall(const SurfaceContact &from_center, ShapeContacts &contacts) const
  {
    const int part = from_center.part;
    Found found[7];
    int count = 0, of_pole[7];
    const auto add = [&](const Vector &normal, int k) {
      if (!approach(normal, part, found[count])) return;
      const double near_by = 1.0e-3 * a.geometry.bounding_radius();
      for (int n = 0; n < count; n++)
        if (length(found[n].place - found[count].place) < near_by) return;
      of_pole[count++] = k;
    };
    bool is_curved = false;
    for (int k = 0; k < 6; k++) {
      Vector normal;
      double distance;
      if (!look(pole[k], part, normal, distance)) continue;
      const Vector turned = normal - from_center.normal;
      if (dot(turned, turned) < 1.0e-24) continue;
      is_curved = true;
      add(normal, k);
    }
    if (!is_curved || !count) add(from_center.normal, 0);
    for (int n = 0; n < count; n++)
      add_contact(found[n], part, count > 1 ? 1 + of_pole[n] : 0, contacts);
  }
  void add_contact(Found found, int part, int number, ShapeContacts &contacts) const
  {
    const Superellipsoid &shape = a.geometry;
    found.curvature =
        shape.curvature_for_laws(shape.at_normal(a.pose.direction_in_body(found.normal)));
    ShapeContact contact = shape_contact(found, 0.0, contact_name(ContactParts::WHOLE, number, 0));
    contact.surface = static_cast<std::uint32_t>(part);
    contact.part = part;
    contacts.points.push_back(contact);
  }

  const PlacedSuperellipsoid &a;
  const LargeBodyShape &body;
  const SuperellipsoidTouch touch;
  const double reach;
  Vector pole[6];
};

}    // namespace

bool superellipsoid_and_vessel(const PlacedSuperellipsoid &a, const Placed<VesselSurface> &b,
                               const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  if (b.geometry.body->distance_bound(a.pose.position) >= a.geometry.bounding_radius())
    return false;
  Walls(a, *b.geometry.body).find(contacts);
  return !contacts.points.empty();
}

}    // namespace Talus
