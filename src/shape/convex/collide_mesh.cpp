// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/collide_mesh.h"

#include "shape/convex/core_pair.h"
#include "shape/convex/mesh_contacts.h"

#include <algorithm>

namespace Talus {

namespace {

using Vector = Vector3<double>;
using Ridge = MeshFeatures::Ridge;
using MeshCorner = MeshFeatures::Corner;

}    // namespace

double MeshContacts::height_over(int triangle, const Vector &x) const
{
  const TriangleMesh &mesh = surface.surface();
  const int plane = mesh.plane_of(triangle);
  return dot(mesh.normal(plane), x - mesh.vertex(mesh.corners(plane).vertex[0]));
}

const NearTriangle *MeshContacts::near_of(int triangle) const
{
  const TriangleMesh &mesh = surface.surface();    // an image or the triangle: one of them is near
  for (const NearTriangle &one : with.near)
    if (mesh.own(one.triangle) == mesh.own(triangle)) return &one;
  return nullptr;
}

bool MeshContacts::find()
{
  if (!find_near_triangles(surface, pose.position, bound, with.parts, with.near)) return false;
  add_vertices();
  with.ridges.clear();
  with.of_ridge.clear();
  with.of_corner.clear();
  for (const NearPart &part : with.parts) {
    const int t = detail.number(part.part);
    features.visit_corners(t, [&](const MeshCorner &corner) { add_corner(corner, t); });
    features.visit_ridges(t, [&](const Ridge &ridge) {
      with.ridges.push_back(&ridge);
      with.of_ridge.push_back(t);
    });
  }
  if (!with.ridges.empty()) {
    with.edges.clear();
    for (int e = 0; e < core.num_edges(); e++) {
      const ConvexCore::Edge &edge = core.edge(e);
      const Vector from = core.vertex(edge.vertex[0]), along = core.vertex(edge.vertex[1]) - from;
      const Segment segment{pose.point_in_space(from), pose.direction_in_space(along),
                            dot(along, along)};
      with.edges.push_back({e, segment, {edge.vertex[0], edge.vertex[1]}});
    }
    for (std::size_t r = 0; r < with.ridges.size(); r++)
      add_edges(*with.ridges[r], with.of_ridge[r]);
  }
  std::sort(points.begin(), points.end(), [](const ShapeContact &a, const ShapeContact &b) {
    return a.name != b.name ? a.name < b.name : a.surface < b.surface;
  });
  return !points.empty();
}

/* ---- corners of the mesh ---------------------------------------------------------------------- */

/* On a side that acts; if on both, on that of the center. */

bool MeshContacts::stands_out(const MeshCorner &corner, const Vector &from_center,
                              const Vector &normal, bool overlaps) const
{
  const MeshSide side = surface.side();
  bool in_front = corner.in_front && side != MeshSide::BACKS;
  const bool behind = corner.behind && side != MeshSide::NORMALS;
  if (in_front && behind) in_front = dot(from_center, corner.outward) < 0.0;
  if (!in_front && !behind) return false;
  const double sign = in_front ? 1.0 : -1.0;
  if (overlaps) return sign * dot(normal, corner.outward) > 0.0;
  double most = -1.0;
  features.visit_around(corner.vertex,
                        [&](int t) { most = std::max(most, sign * dot(normal, plane_normal(t))); });
  return most > through;
}

void MeshContacts::add_corner(const MeshCorner &corner, int t)
{
  const Vector from_center = corner.place - pose.position;
  if (dot(from_center, from_center) >= bound * bound) return;
  const CorePoint nearest = nearest_point(core, pose.point_in_body(corner.place));
  const double overlap = radius - nearest.distance;
  if (!(overlap > 0.0)) return;
  const Vector normal = -pose.direction_in_space(nearest.normal);
  if (!stands_out(corner, from_center, normal, nearest.distance < 0.0)) return;
  ShapeContact contact;
  contact.normal = normal;
  contact.overlap = overlap;
  contact.position = corner.place - 0.5 * overlap * normal;
  contact.weight = 1.0;
  contact.name = contact_name(ContactParts::VERTEX_OF_B, 0, 0);
  contact.surface = static_cast<std::uint32_t>(corner.vertex);
  contact.part = surface.part_of(t);
  with.of_corner.emplace_back(corner.vertex, static_cast<int>(points.size()));
  points.push_back(contact);
}

bool collide_mesh(const ConvexShape &shape, const Pose &pose, const SolidMesh &mesh,
                  ShapeContacts &contacts, double force_exponent)
{
  contacts.clear();
  return MeshContacts(shape, pose, mesh, force_exponent, contacts.points).find();
}

}    // namespace Talus
