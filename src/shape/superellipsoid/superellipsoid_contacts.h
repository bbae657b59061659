// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of superellipsoids, see collisions.h. With what is convex they have one: where the least way leads
// that moves them apart. With the inside of a body one for each place where it is nearest to a wall, with a mesh
// one for all faces, edges and corners that meet at ridges. Points on walls that are curved inward and on smooth patches
// of a mesh are named by their places, on other parts of a mesh by these.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_CONTACTS_H
#define TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_CONTACTS_H

#include "shape/collisions.h"
#include "shape/convex/convex_shape.h"
#include "shape/superellipsoid/superellipsoid.h"
#include "shape/surface.h"

namespace Talus {

using PlacedSuperellipsoid = Placed<Superellipsoid>;

bool superellipsoid_and_superellipsoid(const PlacedSuperellipsoid &a, const PlacedSuperellipsoid &b,
                                       const CollisionRequest &request, ShapeContacts &contacts);
/// Of several pairs, see Collisions::OfMany.
void many_superellipsoids(const CollisionJob *jobs, int count);

/// Faces, edges and corners, each with the rounding radius; the normal is one of those of the part.
bool superellipsoid_and_convex(const PlacedSuperellipsoid &a, const Placed<ConvexShape> &b,
                               const CollisionRequest &request, ShapeContacts &contacts);

/// A cylinder or cone from outside: its lateral surface, its caps, and their rims.
bool superellipsoid_and_round(const PlacedSuperellipsoid &a, const Placed<RoundSurface> &b,
                              const CollisionRequest &request, ShapeContacts &contacts);

/// A body from inside. At walls that are flatter than the shape there is one contact; in narrow ones a long
/// shape touches with both ends.
bool superellipsoid_and_vessel(const PlacedSuperellipsoid &a, const Placed<VesselSurface> &b,
                               const CollisionRequest &request, ShapeContacts &contacts);

bool superellipsoid_and_mesh(const PlacedSuperellipsoid &a, const Placed<MeshSurface> &b,
                             const CollisionRequest &request, ShapeContacts &contacts);

}    // namespace Talus

#endif
