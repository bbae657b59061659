// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/frustum.h"
#include "shape/convex/collide.h"
#include "shape/convex/collide_mesh.h"
#include "shape/convex/convex_words.h"
#include "shape/surface.h"

#include <algorithm>

namespace Talus {
namespace {

using Convex = Placed<ConvexShape>;

bool with_curvature(bool touch, double of_a, double of_b, ShapeContacts &contacts)
{
  for (ShapeContact &one : contacts.points) {
    one.curvature[0] = of_a;
    one.curvature[1] = of_b;
  }
  return touch;
}

bool with_curvature(bool touch, const ConvexShape &a, ShapeContacts &contacts)
{
  return with_curvature(touch, 1.0 / a.contact_radius(), 0.0, contacts);
}

void look_at_cores(double radius_a, double radius_b, ShapeContacts &contacts)
{
  double overlap = 0.0;
  for (const ShapeContact &one : contacts.points) overlap = std::max(overlap, one.overlap);
  const double sum = radius_a + radius_b, smaller = std::min(radius_a, radius_b);
  contacts.core_depth = overlap - sum;
  contacts.core_ratio = contacts.core_depth / (smaller > 0.0 ? smaller : sum);
}

bool with_convex(const Convex &a, const Convex &b, const CollisionRequest &how,
                 ShapeContacts &contacts)
{
  SeparatingDirection unknown;
  const bool touch =
      collide(a.geometry, a.pose, b.geometry, b.pose, how.direction ? *how.direction : unknown,
              contacts, how.method, how.force_exponent);
  if (contacts.cores_overlap) look_at_cores(a.geometry.radius(), b.geometry.radius(), contacts);
  return with_curvature(touch, 1.0 / a.geometry.contact_radius(), 1.0 / b.geometry.contact_radius(),
                        contacts);
}

bool with_sphere(const Convex &a, const Placed<Sphere> &b, const CollisionRequest & /*how*/,
                 ShapeContacts &contacts)
{
  const bool touch =
      collide_sphere(a.geometry, a.pose, b.pose.position, b.geometry.radius, contacts);
  return with_curvature(touch, 1.0 / a.geometry.contact_radius(), 1.0 / b.geometry.radius,
                        contacts);
}

bool with_flat(const Convex &a, const Placed<FlatSurface> &b, const CollisionRequest & /*how*/,
               ShapeContacts &contacts)
{
  const FlatSurface &plane = b.geometry;
  const double height = dot(plane.normal, a.pose.position) - plane.offset,
               reach = a.geometry.bounding_radius();
  contacts.clear();
  if (height <= -reach || height >= reach) return false;
  const bool flip = plane.two_sided && height < 0.0;
  const bool touch = collide_plane(a.geometry, a.pose, flip ? -plane.normal : plane.normal,
                                   flip ? -plane.offset : plane.offset, contacts);
  for (ShapeContact &point : contacts.points) point.part = plane.part;
  return with_curvature(touch, a.geometry, contacts);
}

bool with_vessel(const Convex &a, const Placed<VesselSurface> &b, const CollisionRequest & /*how*/,
                 ShapeContacts &contacts)
{
  return with_curvature(collide_vessel(a.geometry, a.pose, *b.geometry.body, contacts), a.geometry,
                        contacts);
}

bool with_round(const Convex &a, const Placed<RoundSurface> &b, const CollisionRequest &how,
                ShapeContacts &contacts)
{
  return with_curvature(
      collide_round(a.geometry, a.pose, *b.geometry.body, contacts, how.force_exponent), a.geometry,
      contacts);
}

bool with_mesh(const Convex &a, const Placed<MeshSurface> &b, const CollisionRequest &how,
               ShapeContacts &contacts)
{
  const SolidMesh mesh{*b.geometry.shape, *b.geometry.features};
  return with_curvature(collide_mesh(a.geometry, a.pose, mesh, contacts, how.force_exponent),
                        a.geometry, contacts);
}

}    // namespace

void add_convex_collisions(Collisions &table)
{
  table.add<with_convex, with_sphere, with_flat, with_vessel, with_round, with_mesh>();
}

}    // namespace Talus
