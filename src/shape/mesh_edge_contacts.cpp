// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/mesh_contacts.h"
#include "shape/pair_contacts.h"

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
  if (ridge.bend != Bend::RIM) {
    const bool in_front = ridge.bend == Bend::RIDGE;
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
  if (ridge.bend == Bend::RIM) return true;
  const double side = ridge.bend == Bend::RIDGE ? 1.0 : -1.0;
  return std::max(side * dot(normal, plane_normal(ridge.planes[0])),
                  side * dot(normal, plane_normal(ridge.planes[1]))) > through;
}

/* Lines pass each other in the same way where bodies are apart: they overlap if both edges stand
   out along the normal, each is behind the faces of the other one, and neither their ends nor any
   of the other faces is nearer than the edges are to each other. */

bool MeshContacts::overlaps(const EdgePoint &at, const Ridge &ridge, int t,
                            const Vector &normal) const
{
  const Vector along = pose.direction_in_body(at.edge->along),
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
  for (const Vector &end : {at.edge->from, at.edge->from + at.edge->along})
    if (length(end - at.of_edge) < depth) return false;
  const Vector q = pose.point_in_body(at.of_ridge);
  for (int f = 0; f < core.num_faces(); f++) {
    const bool of_edge = f == edge.face[0] || f == edge.face[1];
    if (core.offset(f) - dot(core.normal(f), q) < (of_edge ? -slack : depth)) return false;
  }
  return ridge.bend == Bend::RIM || is_nearest(ridge, t, at.of_edge, slack, depth);
}

bool MeshContacts::is_nearest(const Ridge &ridge, int t, const Vector &x, double slack,
                              double depth) const
{
  const double side = ridge.bend == Bend::RIDGE ? 1.0 : -1.0;
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

void MeshContacts::add_edges(const Ridge &ridge, int t)
{
  const double square = dot(ridge.along, ridge.along);
  const Vector to_center = pose.position - ridge.from;
  const double part = std::clamp(dot(to_center, ridge.along) / square, 0.0, 1.0);
  const Vector apart = to_center - part * ridge.along;
  if (dot(apart, apart) >= bound * bound) return;
  int ends[4] = {-1, -1, -1, -1};    // contacts of the ends
  for (const auto &[vertex, contact] : with.of_corner)
    for (int k = 0; k < 2; k++)
      if (vertex == ridge.end[k]) ends[2 + k] = contact;
  for (const ParticleEdge &edge : with.edges) {
    const Vector d = edge.from - ridge.from;
    const double ab = dot(edge.along, ridge.along), ad = dot(edge.along, d),
                 bd = dot(ridge.along, d);
    const double det = edge.square * square - ab * ab;
    const double s = ab * bd - ad * square, u = edge.square * bd - ab * ad;
    if (!(s > 0.0 && u > 0.0 && s < det && u < det)) continue;
    const Vector of_edge = edge.from + (s / det) * edge.along,
                 of_ridge = ridge.from + (u / det) * ridge.along;
    const Vector across = cross(edge.along, ridge.along);
    Vector normal = (1.0 / length(across)) * across;
    if (!turn_outward(ridge, of_ridge, normal)) continue;
    double gap = dot(normal, of_edge - of_ridge);
    if (gap < 0.0 && !overlaps({&edge, of_edge, of_ridge}, ridge, t, normal)) {
      normal = -normal;    // they are apart, and pass each other beside the ridge
      gap = -gap;
      if (!is_beside(ridge, normal)) continue;
    }
    const double overlap = radius - gap;
    if (!(overlap > 0.0)) continue;
    ConvexContact contact;
    for (int k = 0; k < 2; k++) ends[k] = with.of_vertex[edge.end[k]];
    double of_end[4];
    for (int k = 0; k < 4; k++) of_end[k] = ends[k] < 0 ? 0.0 : points[ends[k]].overlap;
    contact.weight = 1.0 - *std::max_element(of_end, of_end + 4) / overlap;
    if (!(contact.weight > least_weight)) continue;
    contact.energy = contact.weight;
    contact.normal = normal;
    contact.overlap = overlap;
    contact.position = 0.5 * (of_edge + of_ridge - radius * normal);
    contact.name = contact_name(ContactParts::EDGES, edge.number, 0);
    contact.surface = ridge.name;
    contact.triangle = t;
    points.push_back(contact);
  }
}

}    // namespace Talus
