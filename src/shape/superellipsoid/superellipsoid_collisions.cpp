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

/* Known to be apart by more than rounding along a direction: no search would find that they touch. */

bool known_apart(const PlacedSuperellipsoid &a, const PlacedSuperellipsoid &b, const Pose &seen,
                 const SeparatingDirection &known)
{
  const Vector3<double> &n = known.direction;
  if (n.x == 0.0 && n.y == 0.0 && n.z == 0.0) return false;
  const double rounding = 1.0e-12 * (a.geometry.bounding_radius() + b.geometry.bounding_radius());
  return overlap_along(a.geometry, b.geometry, seen, -a.pose.direction_in_body(n)) < -rounding;
}

bool with_superellipsoid(const PlacedSuperellipsoid &a, const PlacedSuperellipsoid &b,
                         const CollisionRequest &how, ShapeContacts &contacts)
{
  contacts.clear();
  const Pose seen = relative_pose(a.pose, b.pose);
  if (how.direction && known_apart(a, b, seen, *how.direction)) return false;
  const CommonNormal found = find_common_normal(a.geometry, b.geometry, seen);
  const Vector3<double> normal = a.pose.direction_in_space(found.normal);
  if (!(found.overlap > 0.0)) {
    if (how.direction) how.direction->direction = -normal;
    return false;
  }
  const Vector3<double> middle = 0.5 * (found.of_a.place + found.place_on_b);
  return single({normal, a.pose.point_in_space(found.of_a.place), a.pose.point_in_space(middle),
                 found.overlap, a.geometry.curvature_for_laws(found.of_a)},
                found.curvature_of_b, contacts);
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
  table.add<with_superellipsoid, with_sphere, with_flat, superellipsoid_and_convex,
            superellipsoid_and_round, superellipsoid_and_vessel, superellipsoid_and_mesh>();
}

}    // namespace Talus
