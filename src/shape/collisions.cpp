// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/collisions.h"

namespace Talus {

Collisions::Collision Collisions::find(const Geometry &a, const Geometry &b) const
{
  const std::type_index of_a = typeid(a), of_b = typeid(b);
  const auto direct = functions.find({of_a, of_b});
  if (direct != functions.end()) {
    const auto many = of_many.find({of_a, of_b});
    return {direct->second, false, many != of_many.end() ? many->second : nullptr};
  }
  const auto exchanged = functions.find({of_b, of_a});
  if (exchanged != functions.end()) return {exchanged->second, true, nullptr};
  return {};
}

bool Collisions::Collision::operator()(const Geometry &a, const Pose &pose_a, const Geometry &b,
                                       const Pose &pose_b, const CollisionRequest &request,
                                       ShapeContacts &contacts) const
{
  if (!exchanged) return function(a, pose_a, b, pose_b, request, contacts);
  SeparatingDirection seen;
  if (request.direction) seen.direction = -request.direction->direction;
  CollisionRequest turned = request;
  turned.direction = &seen;
  const bool touch = function(b, pose_b, a, pose_a, turned, contacts);
  if (request.direction) request.direction->direction = -seen.direction;
  for (ShapeContact &one : contacts.points) {
    one.normal = -one.normal;
    std::swap(one.curvature[0], one.curvature[1]);
    one.name = exchanged_name(one.name);
  }
  return touch;
}

}    // namespace Talus
