// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids and meshes. A triangle is touched where the shape is lowest, if that is over it; an edge that
// stands out, at the point that is deepest in the shape; and a corner, each if the normal is one of those of the
// part. In a hollow that is cut into facets the deepest contact of one smooth patch counts, as for spheres.

#include "body/shape/mesh_shape.h"
#include "shape/mesh_features.h"
#include "shape/near_triangles.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/touch.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Found = SuperellipsoidTouch::Found;
using Ridge = MeshFeatures::Ridge;
using MeshCorner = MeshFeatures::Corner;

constexpr double at_border = 1.0e-9;    // sine, see superellipsoid_solids.cpp

class WithMesh {
 public:
  WithMesh(const PlacedSuperellipsoid &a, const MeshSurface &mesh, ShapeContacts &found_contacts) :
      touch(a.geometry, a.pose), center(a.pose.position), reach(a.geometry.bounding_radius()),
      surface(*mesh.shape), features(*mesh.features), contacts(found_contacts)
  {
  }

  void find()
  {
    if (!find_near_triangles(surface, center, reach, with.parts, with.near)) return;
    for (const NearTriangle &one : with.near) add_face(one);
    const MeshDetail &detail = surface.near_detail();
    for (const NearPart &part : with.parts) {
      const int t = detail.number(part.part);
      features.visit_ridges(t, [&](const Ridge &ridge) { add_ridge(ridge, t); });
      features.visit_corners(t, [&](const MeshCorner &corner) { add_corner(corner, t); });
    }
    std::sort(contacts.points.begin(), contacts.points.end(),
              [](const ShapeContact &a, const ShapeContact &b) {
                return a.name != b.name ? a.name < b.name : a.surface < b.surface;
              });
  }

 private:
  void add_face(const NearTriangle &one)
  {
    const Found found = touch.plane(one.normal, one.offset);
    if (!(found.overlap > 0.0)) return;
    const NearestPoint nearest = surface.near_detail().nearest(one.part, found.place);
    // at the border of two triangles of one plane both count, and become one contact
    if (nearest.square > found.overlap * found.overlap * (1.0 + 1.0e-12)) return;
    if (!touch.is_proven(found)) return;
    add(found, one.triangle, ContactParts::WHOLE,
        static_cast<std::uint32_t>(surface.surface().patch(one.triangle)));
  }
  void add_ridge(const Ridge &ridge, int t)
  {
    const Vector d = center - ridge.from;
    const double along = std::clamp(dot(d, ridge.along) / dot(ridge.along, ridge.along), 0.0, 1.0);
    const Vector away = d - along * ridge.along;
    if (dot(away, away) >= reach * reach) return;
    if (!may_act(ridge)) return;
    Found found;
    if (!touch.edge(ridge.from, ridge.along, 0.0, 0.0, found)) return;
    const Vector m = -found.normal;
    if (dot(m, ridge.inward[0]) > at_border || dot(m, ridge.inward[1]) > at_border) return;
    if (!acts(m, ridge.outward)) return;
    add(found, t, ContactParts::EDGES, ridge.name);
  }
  void add_corner(const MeshCorner &corner, int t)
  {
    if (touch.is_beyond(corner.place, 0.0)) return;
    const Found found = touch.ball(corner.place, 0.0);
    if (!(found.overlap > 0.0)) return;
    const Vector m = -found.normal;
    const TriangleMesh &mesh = surface.surface();
    bool is_of_corner = true;
    features.visit_around(corner.vertex, [&](int triangle) {
      for (const int v : mesh.corners(triangle).vertex) {
        const Vector side = mesh.vertex(v) - corner.place;
        if (dot(m, side) > at_border * length(side)) is_of_corner = false;
      }
    });
    if (!is_of_corner || !acts(m, corner.outward)) return;
    add(found, t, ContactParts::VERTEX_OF_B, static_cast<std::uint32_t>(corner.vertex));
  }
  /// A ridge is one from in front, a valley from behind: where that side acts, and the center is on it.
  bool may_act(const Ridge &ridge) const
  {
    if (ridge.edge_kind == EdgeKind::BOUNDARY) return true;
    const bool in_front = ridge.edge_kind == EdgeKind::RIDGE;
    if (surface.side() == (in_front ? MeshSide::BACKS : MeshSide::NORMALS)) return false;
    const Vector away = center - ridge.from;
    const TriangleMesh &mesh = surface.surface();
    return std::any_of(ridge.planes, ridge.planes + 2, [&](int t) {
      return t < 0 || (dot(away, mesh.normal(t)) > 0.0) == in_front;
    });
  }
  /// The normal says from which side of its triangles something that stands out is touched: does that act?
  bool acts(const Vector &normal, const Vector &outward) const
  {
    const double in_front = dot(normal, outward);
    if (in_front == 0.0) return true;
    return surface.side() != (in_front > 0.0 ? MeshSide::BACKS : MeshSide::NORMALS);
  }
  /// Contacts with one smooth patch, or with pieces of one edge, whose normals are nearly the same are one: the
  /// deepest. Others of the patch are counted by their names.
  void add(const Found &found, int t, ContactParts parts, std::uint32_t part_name)
  {
    ShapeContact contact = shape_contact(found, 0.0, 0);
    contact.surface = part_name;
    contact.part = surface.part_of(t);
    int others = 0;
    for (ShapeContact &one : contacts.points) {
      if (one.surface != part_name || parts_of(one.name) != parts) continue;
      if (dot(one.normal, contact.normal) > TriangleMesh::smooth_cosine) {
        contact.name = one.name;
        if (one.overlap < contact.overlap) one = contact;
        return;
      }
      others++;
    }
    contact.name = contact_name(parts, 0, others);
    contacts.points.push_back(contact);
  }

  // of this thread, used again
  struct Buffers {
    std::vector<NearPart> parts;
    std::vector<NearTriangle> near;
  };
  static Buffers &buffers()
  {
    static thread_local Buffers of_thread;
    return of_thread;
  }

  const SuperellipsoidTouch touch;
  const Vector center;
  const double reach;
  const MeshShape &surface;
  const MeshFeatures &features;
  ShapeContacts &contacts;
  Buffers &with = buffers();
};

}    // namespace

bool superellipsoid_and_mesh(const PlacedSuperellipsoid &a, const Placed<MeshSurface> &b,
                             const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  WithMesh(a, b.geometry, contacts).find();
  return !contacts.points.empty();
}

}    // namespace Talus
