// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/solid.h"

namespace Talus {

bool touch(const Solid &a, const Solid &b, NarrowPhase method, double force_exponent,
           SeparatingDirection &direction, ConvexContacts &contacts)
{
  if (a.shape && b.shape)
    return collide(*a.shape, a.pose, *b.shape, b.pose, direction, contacts, method, force_exponent);
  if (a.shape) return collide_sphere(*a.shape, a.pose, b.center(), b.radius, contacts);
  if (!collide_sphere(*b.shape, b.pose, a.center(), a.radius, contacts)) return false;
  for (ConvexContact &one : contacts.points) {
    one.normal = -one.normal;
    one.name = exchanged_name(one.name);
  }
  return true;
}

}    // namespace Talus
