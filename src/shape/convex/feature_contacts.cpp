// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/convex/nearest_lines.h"
#include "shape/convex/pair_contacts.h"
#include "shape/convex/shared_energy.h"

#include <algorithm>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/// Vertices of a core that may touch the other one, and the edges that lead to them.
struct Candidates {
  std::vector<int> vertices, edges;
  std::vector<double> overlap;    // of all vertices; 0: none
  std::vector<int> contact;       // of all vertices that overlap: which of the contacts

  void find(const ConvexCore &core, const Vector &direction, double height);
};

/* Vertices above a height, and all edges with one of them as an end, each once: in ascending order,
   so that sums over those that touch do not depend on how many others are looked at. */

void Candidates::find(const ConvexCore &core, const Vector &direction, double height)
{
  vertices.clear();
  edges.clear();
  overlap.assign(core.num_vertices(), -1.0);
  contact.resize(core.num_vertices());
  const VectorArray &x = core.all_vertices();
  const double *cx = x.of(0), *cy = x.of(1), *cz = x.of(2);
  for (int v = 0; v < core.num_vertices(); v++)
    if (direction.x * cx[v] + direction.y * cy[v] + direction.z * cz[v] > height) {
      vertices.push_back(v);
      overlap[v] = 0.0;
    }
  for (const int v : vertices)
    for (int k = 0; k < core.num_edges_of_vertex(v); k++) {
      const int e = core.edges_of_vertex(v)[k];
      const int other = core.edge(e).vertex[core.edge(e).vertex[0] == v ? 1 : 0];
      if (overlap[other] < 0.0 || v < other) edges.push_back(e);
    }
  std::sort(edges.begin(), edges.end());
  for (double &o : overlap) o = std::max(o, 0.0);
}

/* Two spheres at the nearest points. */

ShapeContact sphere_contact(const Vector &of_a, const Vector &of_b, const Vector &normal,
                            double distance, Rounding radius)
{
  ShapeContact contact;
  contact.normal = normal;
  contact.overlap = radius.sum() - distance;
  contact.position = 0.5 * (of_a + of_b + (radius.of_b - radius.of_a) * normal);
  contact.weight = 1.0;
  return contact;
}

/// An edge of a core.
struct Edge {
  int number;
  Segment segment;
  int end[2];
  double overlap[2];    // of the ends
};

Edge edge_of(const ConvexCore &core, const Pose &frame, const Candidates &candidates, int e)
{
  const ConvexCore::Edge &edge = core.edge(e);
  const int from = edge.vertex[0], to = edge.vertex[1];
  const Vector along = core.vertex(to) - core.vertex(from);
  return {
      e,
      {frame.point_in_space(core.vertex(from)), frame.direction_in_space(along), dot(along, along)},
      {from, to},
      {candidates.overlap[from], candidates.overlap[to]}};
}

bool edges_touch(const Edge &a, const Edge &b, Rounding radius, ShapeContact &contact)
{
  Vector p, q;
  if (!find_nearest_inside(a.segment, b.segment, p, q)) return false;
  const Vector pq = p - q;
  const double square = dot(pq, pq);
  if (square >= radius.sum() * radius.sum() || square == 0.0) return false;
  const double distance = std::sqrt(square);
  contact = sphere_contact(p, q, (1.0 / distance) * pq, distance, radius);
  contact.name = contact_name(ContactParts::EDGES, a.number, b.number);
  return true;
}

void add_ends(const Edge &edge, const Candidates &candidates, SharedEnergy &energy)
{
  for (int k = 0; k < 2; k++) energy.add_end(candidates.contact[edge.end[k]], edge.overlap[k]);
}

}    // namespace

void sort_by_name(std::vector<ShapeContact> &contacts)
{
  std::sort(contacts.begin(), contacts.end(),
            [](const ShapeContact &a, const ShapeContact &b) { return a.name < b.name; });
}

/* Whatever is nearer than the radii is nearer than that along any direction. */

void add_feature_contacts(const CorePair &pair, Rounding radius, const Gap &gap,
                          double force_exponent, std::vector<ShapeContact> &contacts)
{
  static thread_local Candidates of_a, of_b;
  static thread_local std::vector<Edge> edges_of_b;
  static thread_local SharedEnergy energy;
  const Pose &seen = pair.seen;
  const Vector n = gap.direction, in_b = seen.direction_in_body(n);
  const double bottom_of_a = -highest_vertex(pair.a, -n).height;
  const double shift = dot(n, seen.position);
  const double top_of_b = highest_vertex(pair.b, in_b).height + shift;
  const double reach = radius.sum() + 1.0e-9 * pair.scale();
  of_a.find(pair.a, -n, -top_of_b - reach);
  of_b.find(pair.b, in_b, bottom_of_a - reach - shift);

  for (const int v : of_a.vertices) {
    const Vector x = pair.a.vertex(v);
    const CorePoint near = nearest_point(pair.b, seen.point_in_body(x));
    of_a.overlap[v] = std::max(0.0, radius.sum() - near.distance);
    if (!(of_a.overlap[v] > 0.0)) continue;
    of_a.contact[v] = static_cast<int>(contacts.size());
    contacts.push_back(sphere_contact(x, seen.point_in_space(near.point),
                                      seen.direction_in_space(near.normal), near.distance, radius));
    contacts.back().name = contact_name(ContactParts::VERTEX_OF_A, v, 0);
  }
  for (const int v : of_b.vertices) {
    const Vector x = pair.vertex_of_b(v);
    const CorePoint near = nearest_point(pair.a, x);
    of_b.overlap[v] = std::max(0.0, radius.sum() - near.distance);
    if (!(of_b.overlap[v] > 0.0)) continue;
    of_b.contact[v] = static_cast<int>(contacts.size());
    contacts.push_back(sphere_contact(near.point, x, -near.normal, near.distance, radius));
    contacts.back().name = contact_name(ContactParts::VERTEX_OF_B, 0, v);
  }

  edges_of_b.clear();
  for (const int e : of_b.edges) edges_of_b.push_back(edge_of(pair.b, seen, of_b, e));
  const Pose own;
  ShapeContact contact;
  for (const int e : of_a.edges) {
    const Edge a = edge_of(pair.a, own, of_a, e);
    for (const Edge &b : edges_of_b) {
      if (!edges_touch(a, b, radius, contact)) continue;
      energy.begin(contact.overlap, force_exponent);
      add_ends(a, of_a, energy);
      add_ends(b, of_b, energy);
      if (!energy.finish()) continue;
      contact.weight = energy.weight();
      contact.energy = energy.energy();
      contacts.push_back(contact);
      energy.take_from(contacts);
    }
  }
  sort_by_name(contacts);
}

}    // namespace Talus
