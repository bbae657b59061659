// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Spheres that are near nothing of a mesh but one plane, eight at a time, each with a plane of its own.

#include "base/lanes.h"
#include "body/shape/mesh_shape.h"

namespace Talus {

FlatPlace MeshShape::flat_place(const Vector3<double> &center, double reach, int part) const
{
  FlatPlace place = detail->flat_place(part, center, reach);
  if (place.way > 0.0) place.part = part_of(place.part);
  return place;
}

/* As contact_with() and each_minimum(), for a foot on a face: from a side that does not act, and where the overlap is
   so large that other triangles of the plane count, they are asked. */

unsigned MeshShape::touches_flat(const EightSpheres &spheres, const EightFlatPlaces &places,
                                 EightContacts &contacts, unsigned &told) const
{
  const Vector3<Vec8> x{load8(spheres.center[0]), load8(spheres.center[1]),
                        load8(spheres.center[2])};
  const Vector3<Vec8> n{load8(places.normal[0]), load8(places.normal[1]), load8(places.normal[2])};
  const Vec8 radius = load8(spheres.radius), zero{};
  const Vector3<Vec8> away = (dot(x, n) - load8(places.offset)) * n;
  const Vec8 square = dot(away, away), height = dot(away, n);

  const unsigned within = less_bits(square, radius * radius);
  unsigned plain = less_bits(splat<Vec8>(TriangleMesh::smooth_cosine) * radius, magnitude(height));
  if (acting == MeshSide::NORMALS) plain &= ~less_bits(height, zero);
  if (acting == MeshSide::BACKS) plain &= ~less_bits(zero, height);
  told = ~within | plain;

  const bool_of<Vec8> behind = acting == MeshSide::BACKS ? height <= zero : height < zero;
  const Vector3<Vec8> outward = select(behind, -n, n);
  store(contacts.normal[0], outward.x);
  store(contacts.normal[1], outward.y);
  store(contacts.normal[2], outward.z);
  store(contacts.overlap, radius - square_root(square));
  for (int k = 0; k < lanes; k++) contacts.part[k] = places.part[k];
  return within & plain;
}

}    // namespace Talus
