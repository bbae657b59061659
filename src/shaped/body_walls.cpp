// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/body_walls.h"

#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/plane.h"

namespace Talus {

BodyWalls::BodyWalls(const LargeBodyShape &body)
{
  const Vector3<double> middle = body.reference_point();
  if (const auto *plane = dynamic_cast<const Plane *>(&body)) {
    add_flat(plane->unit_normal(), middle, plane->has_two_sides());
  } else if (const auto *box = dynamic_cast<const Box *>(&body)) {
    const Vector3<double> half{box->half_edge(0), box->half_edge(1), box->half_edge(2)};
    if (!box->is_inside()) {
      auto shape = std::make_shared<ConvexShape>(ConvexShape::box(2.0 * half, 0.0));
      Pose its = shape->given_frame();
      its.position = its.position + middle;
      solid.push_back({shape, its});
      return;
    }
    for (const double sign : {1.0, -1.0}) {
      add_flat({sign, 0.0, 0.0}, middle - sign * half, false);
      add_flat({0.0, sign, 0.0}, middle - sign * half, false);
      add_flat({0.0, 0.0, sign}, middle - sign * half, false);
    }
  } else if (const auto *vessel = dynamic_cast<const Frustum *>(&body)) {
    if (!vessel->is_vessel()) return;
    const Vector3<double> &axis = vessel->unit_axis();
    round.push_back({middle, axis, vessel->mantle_radius()});
    if (vessel->is_endless()) return;
    add_flat(axis, middle - vessel->half_length() * axis, false);
    add_flat(-axis, middle + vessel->half_length() * axis, false);
  } else if (const auto *sphere = dynamic_cast<const Talus::Ball *>(&body)) {
    if (!sphere->is_inside()) ball.push_back({middle, sphere->radius()});
  }
}

void BodyWalls::add_flat(const Vector3<double> &normal, const Vector3<double> &point,
                         bool two_sided)
{
  flat.push_back({normal, dot(normal, point), two_sided});
}

bool BodyWalls::touch_flat(const Flat &wall, const ConvexShape &shape, const Pose &pose,
                           ConvexContacts &contacts) const
{
  const double height = dot(wall.normal, pose.position) - wall.offset,
               reach = shape.bounding_radius();
  if (height <= -reach || height >= reach) return false;
  const bool flip = wall.two_sided && height < 0.0;
  return collide_plane(shape, pose, flip ? -wall.normal : wall.normal,
                       flip ? -wall.offset : wall.offset, contacts);
}

/* A direction that separates is not kept: large bodies are few. */

bool BodyWalls::touch(int wall, const ConvexShape &shape, const Pose &pose,
                      ConvexContacts &contacts) const
{
  const auto take = [&wall](const auto &list) {
    const int size = static_cast<int>(list.size());
    const bool mine = wall < size;
    if (!mine) wall -= size;
    return mine;
  };
  if (take(flat)) return touch_flat(flat[wall], shape, pose, contacts);
  if (take(round))
    return collide_cylinder(shape, pose, round[wall].point, round[wall].axis, round[wall].radius,
                            contacts);
  if (take(solid)) {
    SeparatingDirection direction;
    return collide(shape, pose, *solid[wall].shape, solid[wall].pose, direction, contacts);
  }
  return collide_sphere(shape, pose, ball[wall].center, ball[wall].radius, contacts);
}

}    // namespace Talus
