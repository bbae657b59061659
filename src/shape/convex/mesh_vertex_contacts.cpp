// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/mesh_contacts.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;

}    // namespace

/* ---- vertices of the particle ----------------------------------------------------------------- */

void MeshContacts::add_vertices()
{
  for (int v = 0; v < core.num_vertices(); v++) {
    const Vector x = pose.point_in_space(core.vertex(v));
    double lowest = radius;
    for (const NearTriangle &one : with.near) lowest = std::min(lowest, one.height(x));
    if (lowest >= radius) continue;
    if (radius > 0.0) add_in_front(v, x);
    if (lowest < 0.0) add_behind(v, x);
  }
  with.of_vertices = static_cast<int>(points.size());
}

/* What a vertex touches from the other side than that of the center it has gone through. */

void MeshContacts::add_in_front(int v, const Vector &x)
{
  SurfaceContact found[LargeBodyShape::max_contacts];
  const int count = surface.find_contacts(
      x, radius, {with.parts.data(), with.parts.data() + with.parts.size()}, found);
  for (int k = 0; k < count; k++) {
    const NearTriangle *one = near_of(found[k].part);
    if (!one || !(one->height(x) < 0.0 && dot(one->normal, found[k].normal) < 0.0))
      add_vertex_contact(v, x, found[k].normal, found[k].overlap, found[k].part);
  }
}

/* Behind the nearest of the triangles that face the center; beyond the rim of it only if the
   surface goes on there like a valley. The straight way from the center leads through some triangle
   then, and not past it. */

void MeshContacts::add_behind(int v, const Vector &x)
{
  if (std::none_of(with.near.begin(), with.near.end(), [&](const NearTriangle &one) {
        return detail.is_between(one.part, pose.position, x);
      }))
    return;
  const NearTriangle *at = nullptr;
  NearestPoint nearest{};
  for (const NearTriangle &one : with.near) {
    const NearestPoint candidate = detail.nearest(one.part, x);
    if (at && candidate.square >= nearest.square) continue;
    at = &one;
    nearest = candidate;
  }
  if (!(at->height(x) < 0.0)) return;
  if (nearest.feature == NearestPoint::FACE)
    add_vertex_contact(v, x, at->normal, radius - at->height(x), at->triangle);
  else
    add_behind_edges(v, x, *at, nearest);
}

void MeshContacts::add_behind_edges(int v, const Vector &x, const NearTriangle &at,
                                    const NearestPoint &nearest)
{
  static thread_local std::vector<int> around;
  const EdgeKind sharp = at.side > 0.0 ? EdgeKind::RIDGE : EdgeKind::VALLEY;
  bool stands_out = false;
  const auto look_at = [&](int t, int k) {
    const EdgeKind edge_kind = features.edge_kind(t, k);
    stands_out = stands_out || edge_kind == sharp || edge_kind == EdgeKind::BOUNDARY;
  };
  around.assign(1, at.triangle);
  if (nearest.feature == NearestPoint::EDGE) {
    look_at(at.triangle, nearest.index);
    if (stands_out) return;
    around.push_back(features.over(at.triangle, nearest.index));
  } else {
    around.clear();
    const TriangleMesh &mesh = surface.surface();
    const int corner = mesh.corners(at.triangle).vertex[nearest.index];
    features.visit_around(corner, [&](int t) {
      around.push_back(t);
      for (int k = 0; k < 3; k++)
        if (mesh.corners(t).vertex[k] == corner || mesh.corners(t).vertex[(k + 1) % 3] == corner)
          look_at(t, k);
    });
  }
  const std::size_t first = points.size();
  const NearTriangle *least_deep = nullptr;
  for (const int t : around) {
    const bool in_front = !(at.side * height_over(t, x) < 0.0);
    if (in_front && stands_out) return;    // outside
    const NearTriangle *one = near_of(t);
    if (in_front || !one) continue;
    if (!least_deep || one->height(x) > least_deep->height(x)) least_deep = one;
    if (!stands_out) add_vertex_contact(v, x, one->normal, radius - one->height(x), t);
  }
  if (stands_out && least_deep && points.size() == first)
    add_vertex_contact(v, x, least_deep->normal, radius - least_deep->height(x),
                       least_deep->triangle);
}

/* One contact of a vertex with triangles of one plane, and with those of a smooth patch: the
   deepest. */

void MeshContacts::add_vertex_contact(int v, const Vector &x, const Vector &normal, double overlap,
                                      int t)
{
  if (!(overlap > 0.0)) return;
  const TriangleMesh &mesh = surface.surface();
  ShapeContact contact;
  contact.normal = normal;
  contact.overlap = overlap;
  contact.position = x - (radius - 0.5 * overlap) * normal;
  contact.weight = 1.0;
  contact.surface = static_cast<std::uint32_t>(mesh.patch(t));
  contact.part = surface.part_of(t);
  int others = 0;
  for (ShapeContact &one : points) {
    if (one.name >> 15 != contact_name(ContactParts::VERTEX_OF_A, v, 0) >> 15) continue;
    if (one.surface != contact.surface) continue;
    if (dot(one.normal, normal) > TriangleMesh::smooth_cosine) {
      contact.name = one.name;
      if (one.overlap < overlap) one = contact;
      return;
    }
    others++;
  }
  contact.name = contact_name(ContactParts::VERTEX_OF_A, v, others);
  points.push_back(contact);
}

}    // namespace Talus
