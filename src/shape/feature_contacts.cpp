// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/pair_contacts.h"

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

ConvexContact sphere_contact(const Vector &of_a, const Vector &of_b, const Vector &normal,
                             double distance, Rounding radius)
{
  ConvexContact contact;
  contact.normal = normal;
  contact.overlap = radius.sum() - distance;
  contact.position = 0.5 * (of_a + of_b + (radius.of_b - radius.of_a) * normal);
  contact.weight = 1.0;
  return contact;
}

struct Segment {
  int edge;
  Vector from, along;
  double square;
  int end[2];
  double overlap[2];    // of the ends
};

Segment segment_of(const ConvexCore &core, const Pose &frame, const Candidates &candidates, int e)
{
  const ConvexCore::Edge &edge = core.edge(e);
  const int from = edge.vertex[0], to = edge.vertex[1];
  const Vector along = core.vertex(to) - core.vertex(from);
  return {e,
          frame.point_in_space(core.vertex(from)),
          frame.direction_in_space(along),
          dot(along, along),
          {from, to},
          {candidates.overlap[from], candidates.overlap[to]}};
}

/* The nearest points of two lines, if they are between the ends of both edges; see C. Ericson,
   Real-time collision detection (2005), section 5.1.9. */

bool edges_touch(const Segment &a, const Segment &b, Rounding radius, ConvexContact &contact)
{
  const Vector d = a.from - b.from;
  const double ab = dot(a.along, b.along), ad = dot(a.along, d), bd = dot(b.along, d);
  const double det = a.square * b.square - ab * ab;
  const double s = ab * bd - ad * b.square, t = a.square * bd - ab * ad;
  if (!(s > 0.0 && t > 0.0 && s < det && t < det)) return false;
  const Vector p = a.from + (s / det) * a.along, q = b.from + (t / det) * b.along, pq = p - q;
  const double square = dot(pq, pq);
  if (square >= radius.sum() * radius.sum() || square == 0.0) return false;
  const double distance = std::sqrt(square);
  contact = sphere_contact(p, q, (1.0 / distance) * pq, distance, radius);
  contact.name = contact_name(ContactParts::EDGES, a.edge, b.edge);
  return true;
}

/* (o_end/o)^m, m being the exponent of energies. */

double energy_ratio(double of_end, double of_edges, double force_exponent)
{
  const double y = of_end / of_edges;
  if (force_exponent == 1.0) return y * y;
  if (force_exponent == 1.5) return y * y * std::sqrt(y);
  return std::pow(y, force_exponent + 1.0);
}

/// Weights that a contact of two edges has, and takes from those of its ends (two of a, two of b).
struct EdgeWeights {
  double own, of_end[4];
  double energy;    ///< over phi(o)
};

/* What the contact of an end leaves of the energy of a contact of two edges, and minus its slope, for
   the ratio p of their energies: 1 - a p, which ends at p = 1 without a kink, as a parabola over a
   fifth. Where the slope is above 1 the weight of the end is negative, and pulls at what should
   topple about the edge; the mean slope is 1, so that it cannot be below 1 everywhere. */

struct Left {
  double share, slope;
};

Left left_by_end(double p)
{
  constexpr double bend = 0.2, steepest = 1.0 / (1.0 - 0.5 * bend), to_end = 1.0 - bend;
  if (p < to_end) return {1.0 - steepest * p, steepest};
  const double slope = steepest * (1.0 - p) / bend;
  return {0.5 * slope * (1.0 - p), slope};
}

/* The derivatives of the energy phi(o) prod_k left(p_k), p_k = (o_k/o)^m, phi ~ o^m: by o over
   phi'(o), and by -o_k over phi'(o_k). */

bool weights_of_edges(const Segment &a, const Segment &b, double overlap, double force_exponent,
                      EdgeWeights &weights)
{
  const double of_end[4] = {a.overlap[0], a.overlap[1], b.overlap[0], b.overlap[1]};
  double left[4], shared[4];
  weights.own = 1.0;
  for (int k = 0; k < 4; k++) {
    if (of_end[k] >= overlap) return false;
    const double p = energy_ratio(of_end[k], overlap, force_exponent);
    const Left by_end = left_by_end(p);
    left[k] = by_end.share;
    weights.of_end[k] = by_end.slope;
    shared[k] = p * by_end.slope;
    weights.own *= left[k];
  }
  weights.energy = weights.own;
  for (int k = 0; k < 4; k++) {
    double others = 1.0;
    for (int l = 0; l < 4; l++)
      if (l != k) others *= left[l];
    weights.of_end[k] *= others;
    weights.own += shared[k] * others;
  }
  return weights.own > least_weight;
}

void take_from_ends(const Segment &edge, const Candidates &candidates, const double *weight,
                    std::vector<ConvexContact> &contacts)
{
  for (int k = 0; k < 2; k++)
    if (edge.overlap[k] > 0.0) contacts[candidates.contact[edge.end[k]]].weight -= weight[k];
}

}    // namespace

void sort_by_name(std::vector<ConvexContact> &contacts)
{
  std::sort(contacts.begin(), contacts.end(),
            [](const ConvexContact &a, const ConvexContact &b) { return a.name < b.name; });
}

/* Whatever is nearer than the radii is nearer than that along any direction. */

void add_feature_contacts(const CorePair &pair, Rounding radius, const Gap &gap,
                          double force_exponent, std::vector<ConvexContact> &contacts)
{
  static thread_local Candidates of_a, of_b;
  static thread_local std::vector<Segment> segments;
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

  segments.clear();
  for (const int e : of_b.edges) segments.push_back(segment_of(pair.b, seen, of_b, e));
  const Pose own;
  ConvexContact contact;
  EdgeWeights weights;
  for (const int e : of_a.edges) {
    const Segment a = segment_of(pair.a, own, of_a, e);
    for (const Segment &b : segments) {
      if (!edges_touch(a, b, radius, contact)) continue;
      if (!weights_of_edges(a, b, contact.overlap, force_exponent, weights)) continue;
      contact.weight = weights.own;
      contact.energy = weights.energy;
      contacts.push_back(contact);
      take_from_ends(a, of_a, weights.of_end, contacts);
      take_from_ends(b, of_b, weights.of_end + 2, contacts);
    }
  }
  sort_by_name(contacts);
}

}    // namespace Talus
