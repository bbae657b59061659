// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/body_walls.h"

#include "body/shape/ball.h"
#include "body/shape/box.h"
#include "body/shape/frustum.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/plane.h"
#include "body/shape/rectangle.h"
#include "shape/collide_mesh.h"

#include <memory>

namespace Talus {
namespace {

/// The two triangles of a rectangle.
std::shared_ptr<const MeshShape> mesh_of(const Rectangle &rectangle)
{
  std::vector<Triangle> triangles;
  rectangle.tessellate({}, triangles);
  return std::make_shared<const MeshShape>(
      TriangleMesh(triangles), rectangle.has_two_sides() ? MeshSide::BOTH : MeshSide::NORMALS);
}

}    // namespace

BodyWalls::BodyWalls(const LargeBodyShape &body) : parts(body.most_contacts() > 1)
{
  const Vector3<double> middle = body.reference_point();
  const auto add_vessel = [&] {
    walls.emplace_back([&body](const Particle &one, ConvexContacts &contacts) {
      return collide_vessel(one.shape, one.pose, body, contacts);
    });
  };
  if (const auto *plane = dynamic_cast<const Plane *>(&body)) {
    add_flat(plane->unit_normal(), middle, plane->has_two_sides());
  } else if (const auto *box = dynamic_cast<const Box *>(&body)) {
    const Vector3<double> half{box->half_edge(0), box->half_edge(1), box->half_edge(2)};
    if (!box->is_inside()) {
      add_solid_box(middle, 2.0 * half);
      return;
    }
    for (const double sign : {1.0, -1.0}) {
      const int face = sign > 0.0 ? 0 : 1;    // as Box numbers them
      add_flat({sign, 0.0, 0.0}, middle - sign * half, false, face);
      add_flat({0.0, sign, 0.0}, middle - sign * half, false, face + 2);
      add_flat({0.0, 0.0, sign}, middle - sign * half, false, face + 4);
    }
  } else if (const auto *frustum = dynamic_cast<const Frustum *>(&body)) {
    if (frustum->is_vessel()) add_vessel();
    if (frustum->is_solid())
      walls.emplace_back([frustum](const Particle &one, ConvexContacts &contacts) {
        return collide_round(one.shape, one.pose, *frustum, contacts, one.force_exponent);
      });
  } else if (const auto *ball = dynamic_cast<const Talus::Ball *>(&body)) {
    if (ball->is_inside()) {
      add_vessel();
      return;
    }
    walls.emplace_back(
        [middle, radius = ball->radius()](const Particle &one, ConvexContacts &contacts) {
          return collide_sphere(one.shape, one.pose, middle, radius, contacts);
        });
  } else if (const auto *mesh = dynamic_cast<const MeshShape *>(&body)) {
    walls.emplace_back([mesh, features = std::make_shared<const MeshFeatures>(mesh->surface())](
                           const Particle &one, ConvexContacts &contacts) {
      return collide_mesh(one.shape, one.pose, {*mesh, *features}, contacts, one.force_exponent);
    });
  } else if (const auto *rectangle = dynamic_cast<const Rectangle *>(&body)) {
    const auto its = mesh_of(*rectangle);
    walls.emplace_back([its, features = std::make_shared<const MeshFeatures>(its->surface())](
                           const Particle &one, ConvexContacts &contacts) {
      return collide_mesh(one.shape, one.pose, {*its, *features}, contacts, one.force_exponent);
    });
  }
}

std::string BodyWalls::refusal(const LargeBodyShape &body)
{
  if (dynamic_cast<const MeshShape *>(&body) || BodyWalls(body).size() > 0) return "";
  return "particles with a shape touch no surface of this kind: use plane, rectangle, box, sphere, "
         "cylinder or cone without 'open', or mesh";
}

/* A direction that separates is not kept: large bodies are few. */

void BodyWalls::add_solid_box(const Vector3<double> &middle, const Vector3<double> &edges)
{
  const auto box = std::make_shared<const ConvexShape>(ConvexShape::box(edges, 0.0));
  Pose its = box->given_frame();
  its.position = its.position + middle;
  walls.emplace_back([box, its](const Particle &one, ConvexContacts &contacts) {
    SeparatingDirection direction;
    return collide(one.shape, one.pose, *box, its, direction, contacts, NarrowPhase::FEATURES,
                   one.force_exponent);
  });
}

void BodyWalls::add_flat(const Vector3<double> &normal, const Vector3<double> &point,
                         bool two_sided, int part)
{
  walls.emplace_back([normal, offset = dot(normal, point), two_sided,
                      part](const Particle &one, ConvexContacts &contacts) {
    const double height = dot(normal, one.pose.position) - offset,
                 reach = one.shape.bounding_radius();
    if (height <= -reach || height >= reach) return false;
    const bool flip = two_sided && height < 0.0;
    const bool touch = collide_plane(one.shape, one.pose, flip ? -normal : normal,
                                     flip ? -offset : offset, contacts);
    for (ConvexContact &point : contacts.points) point.part = part;
    return touch;
  });
}

}    // namespace Talus
