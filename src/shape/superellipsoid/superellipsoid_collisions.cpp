// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/least_overlap.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/superellipsoid_words.h"
#include "shape/superellipsoid/touch.h"

namespace Talus {
namespace {

const std::uint32_t whole = contact_name(ContactParts::WHOLE, 0, 0);

bool single(const SuperellipsoidTouch::Found &found, double other_curvature,
            ShapeContacts &contacts)
{
  if (!(found.overlap > 0.0)) return false;
  contacts.points.push_back(shape_contact(found, other_curvature, whole));
  return true;
}

bool with_sphere(const PlacedSuperellipsoid &a, const Placed<Sphere> &b,
                 const CollisionRequest & /*how*/, ShapeContacts &contacts)
{
  contacts.clear();
  const SuperellipsoidTouch touch(a.geometry, a.pose);
  const double radius = b.geometry.radius;
  if (touch.is_beyond(b.pose.position, radius)) return false;
  return single(touch.ball(b.pose.position, radius), 1.0 / radius, contacts);
}

/* As for other shapes, up to a center one bounding radius behind. */

bool with_flat(const PlacedSuperellipsoid &a, const Placed<FlatSurface> &b,
               const CollisionRequest & /*how*/, ShapeContacts &contacts)
{
  contacts.clear();
  const FlatSurface &plane = b.geometry;
  const double height = dot(plane.normal, a.pose.position) - plane.offset,
               reach = a.geometry.bounding_radius();
  if (height <= -reach || height >= reach) return false;
  const double side = plane.two_sided && height < 0.0 ? -1.0 : 1.0;
  const SuperellipsoidTouch touch(a.geometry, a.pose);
  if (!single(touch.plane(side * plane.normal, side * plane.offset), 0.0, contacts)) return false;
  contacts.points.back().part = plane.part;
  return true;
}

}    // namespace

void add_superellipsoid_collisions(Collisions &table)
{
  table.add<superellipsoid_and_superellipsoid, with_sphere, with_flat, superellipsoid_and_convex,
            superellipsoid_and_round, superellipsoid_and_vessel, superellipsoid_and_mesh>();
  table.add_many<Superellipsoid, Superellipsoid>(many_superellipsoids);
}

}    // namespace Talus
