// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/mesh_contacts.h"
#include "shape/convex/nearest_lines.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Ridge = MeshFeatures::Ridge;

// Edges overlap along directions in which both stand out, or lean to a face of theirs by less than
// this (sine): so what touches does not change where a face lies on a face.
constexpr double lean = 0.4;

constexpr double deepest = 0.3;    // edges overlap by less of the size of the particle

// How exactly edges are behind faces, over the size of the particle.
constexpr double near_enough = 1.0e-3;

// A ridge in front of what an end touches by this, over the size of the particle, is of another part
// of the surface.
constexpr double unrelated = 0.1;

bool is_known(const Vector &v)
{
  return v.x != 0.0 || v.y != 0.0 || v.z != 0.0;
}

}    // namespace

/* ---- edges ------------------------------------------------------------------------------------ */

/* Turns the normal to where the ridge stands out, or of an edge without thickness to the particle;
   false if this is on a side that does not act. */

bool MeshContacts::turn_outward(const Ridge &ridge, const Vector &at, Vector &normal) const
{
  const Vector to_center = pose.position - at;
  const MeshSide side = surface.side();
  if (ridge.edge_kind != EdgeKind::BOUNDARY) {
    const bool in_front = ridge.edge_kind == EdgeKind::RIDGE;
    if (in_front != (dot(normal, ridge.outward) > 0.0)) normal = -normal;
    return side != (in_front ? MeshSide::BACKS : MeshSide::NORMALS);
  }
  if (dot(normal, to_center) < 0.0) normal = -normal;
  if (side == MeshSide::BOTH || side == MeshSide::UNDECIDED || !is_known(ridge.inward[0]))
    return true;
  const Vector up = cross(ridge.along, ridge.inward[0]);    // edges go round normals
  return (dot(up, to_center) > 0.0) == (side == MeshSide::NORMALS);
}

bool MeshContacts::is_beside(const Ridge &ridge, const Vector &normal) const
{
  if (ridge.edge_kind == EdgeKind::BOUNDARY) return true;
  const double side = ridge.edge_kind == EdgeKind::RIDGE ? 1.0 : -1.0;
  return std::max(side * dot(normal, plane_normal(ridge.planes[0])),
                  side * dot(normal, plane_normal(ridge.planes[1]))) > through;
}

/* Lines pass each other in the same way where bodies are apart: they overlap if both edges stand
   out along the normal, each is behind the faces of the other one, and neither their ends nor any
   of the other faces is nearer than the edges are to each other. */

bool MeshContacts::overlaps(const EdgePoint &at, const Ridge &ridge, int t,
                            const Vector &normal) const
{
  const Vector along = pose.direction_in_body(at.edge->segment.along),
               toward = pose.direction_in_body(-normal);
  const ConvexCore::Edge &edge = core.edge(at.edge->number);
  const double limit = lean * length(along);
  if (dot(normal, ridge.inward[0]) > lean || dot(normal, ridge.inward[1]) > lean) return false;
  if (dot(cross(core.normal(edge.face[0]), along), toward) > limit ||
      dot(cross(along, core.normal(edge.face[1])), toward) > limit)
    return false;
  const double slack = near_enough * bound, depth = length(at.of_edge - at.of_ridge) - slack;
  if (depth > deepest * bound) return false;
  for (const int v : ridge.end)
    if (length(surface.surface().vertex(v) - at.of_ridge) < depth) return false;
  const Segment &segment = at.edge->segment;
  for (const Vector &end : {segment.from, segment.from + segment.along})
    if (length(end - at.of_edge) < depth) return false;
  const Vector q = pose.point_in_body(at.of_ridge);
  for (int f = 0; f < core.num_faces(); f++) {
    const bool of_edge = f == edge.face[0] || f == edge.face[1];
    if (core.offset(f) - dot(core.normal(f), q) < (of_edge ? -slack : depth)) return false;
  }
  return ridge.edge_kind == EdgeKind::BOUNDARY || is_nearest(ridge, t, at.of_edge, slack, depth);
}

bool MeshContacts::is_nearest(const Ridge &ridge, int t, const Vector &x, double slack,
                              double depth) const
{
  const double side = ridge.edge_kind == EdgeKind::RIDGE ? 1.0 : -1.0;
  int k = 0;
  while (surface.surface().corners(t).vertex[k] != ridge.vertex[0]) k++;
  const int other = features.over(t, k);
  if (side * height_over(t, x) > slack || side * height_over(other, x) > slack) return false;
  for (const NearTriangle &one : with.near) {
    const int plane = surface.surface().plane_of(one.triangle);
    if (plane == ridge.planes[0] || plane == ridge.planes[1]) continue;
    if (std::sqrt(detail.nearest(one.part, x).square) < depth) return false;
  }
  return true;
}

/* An end may also touch what has nothing to do with the ridge, such as the floor on which an upright
   edge stands that leans against it. They belong together as far as one convex body can have both:
   the ridge is behind the plane that the end touches. */

bool MeshContacts::share_with_ends(const EdgePoint &at, const Ridge &ridge, double overlap) const
{
  const double apart = unrelated * bound;
  const auto is_of_edge = [&](const ShapeContact &one) {
    return std::any_of(at.edge->end, at.edge->end + 2, [&](int v) {
      return one.name >> 15 == contact_name(ContactParts::VERTEX_OF_A, v, 0) >> 15;
    });
  };
  with.energy.begin(overlap, force_exponent);
  for (int k = 0; k < with.of_vertices; k++) {
    const ShapeContact &one = points[k];
    if (!is_of_edge(one)) continue;
    const Vector place = one.position + 0.5 * one.overlap * one.normal;
    const double before = dot(one.normal, at.of_ridge - place);
    with.energy.add_end(k, one.overlap, 1.0 - std::clamp(before / apart, 0.0, 1.0));
  }
  for (const auto &[vertex, contact] : with.of_corner)
    if (vertex == ridge.end[0] || vertex == ridge.end[1])
      with.energy.add_end(contact, points[contact].overlap);
  return with.energy.finish();
}

void MeshContacts::add_edges(const Ridge &ridge, int t)
{
  const Segment segment{ridge.from, ridge.along, dot(ridge.along, ridge.along)};
  const Vector to_center = pose.position - ridge.from;
  const double part = std::clamp(dot(to_center, ridge.along) / segment.square, 0.0, 1.0);
  const Vector apart = to_center - part * ridge.along;
  if (dot(apart, apart) >= bound * bound) return;
  for (const ParticleEdge &edge : with.edges) {
    Vector of_edge, of_ridge;
    if (!find_nearest_inside(edge.segment, segment, of_edge, of_ridge)) continue;
    const Vector across = cross(edge.segment.along, ridge.along);
    Vector normal = (1.0 / length(across)) * across;
    if (!turn_outward(ridge, of_ridge, normal)) continue;
    double gap = dot(normal, of_edge - of_ridge);
    const EdgePoint at{&edge, of_edge, of_ridge};
    if (gap < 0.0 && !overlaps(at, ridge, t, normal)) {
      normal = -normal;    // they are apart, and pass each other beside the ridge
      gap = -gap;
      if (!is_beside(ridge, normal)) continue;
    }
    const double overlap = radius - gap;
    if (!(overlap > 0.0)) continue;
    if (!share_with_ends(at, ridge, overlap)) continue;
    ShapeContact contact;
    contact.weight = with.energy.weight();
    contact.energy = with.energy.energy();
    contact.normal = normal;
    contact.overlap = overlap;
    contact.position = 0.5 * (of_edge + of_ridge - radius * normal);
    contact.name = contact_name(ContactParts::EDGES, edge.number, 0);
    contact.surface = ridge.name;
    contact.part = surface.part_of(t);
    points.push_back(contact);
    with.energy.take_from(points);
  }
}

}    // namespace Talus
