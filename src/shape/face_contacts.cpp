// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The faces of two cores that overlap are projected along the normal of the contact; the polygon
// that they have in common is that of the first one, cut along the edges of the second one
// (I. E. Sutherland, G. W. Hodgman, Commun. ACM 17, 32, 1974).

#include "shape/pair_contacts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;

struct Flat {
  double x, y;
};
Flat operator-(Flat a, Flat b)
{
  return {a.x - b.x, a.y - b.y};
}
double dot(Flat a, Flat b)
{
  return a.x * b.x + a.y * b.y;
}
double cross(Flat a, Flat b)
{
  return a.x * b.y - a.y * b.x;
}
double square_of(Flat a)
{
  return dot(a, a);
}

/// A face in the plane of the contact: `height` along the normal is a linear function.
struct Projected {
  std::vector<Flat> corner;
  std::vector<int> vertex, edge;    // edge k from corner k to the next
  double at_origin, slope_x, slope_y;
  double height(Flat p) const { return at_origin + slope_x * p.x + slope_y * p.y; }
};

/// A corner of the common polygon, and the edge that begins there: of a, or of b.
struct Corner {
  Flat place;
  bool of_a;
  int edge;
};

/// Axes of the plane of the contact.
struct Frame {
  Vector x, y, normal;
  explicit Frame(const Vector &n) : normal(n)
  {
    const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
    const Vector other = ax <= ay && ax <= az ? Vector{1.0, 0.0, 0.0}
                         : ay <= az           ? Vector{0.0, 1.0, 0.0}
                                              : Vector{0.0, 0.0, 1.0};
    const Vector across = Talus::cross(other, n);
    x = (1.0 / length(across)) * across;
    y = Talus::cross(n, x);
  }
  Flat projected(const Vector &v) const { return {Talus::dot(x, v), Talus::dot(y, v)}; }
  Vector in_space(Flat p, double height) const { return p.x * x + p.y * y + height * normal; }
};

/* The face that looks along a direction most, among those that meet in the highest point of the
   core: the face of the direction itself, or those of its edge (or -1), or of its highest
   vertex. */

int face_along(const ConvexCore &core, const Vector &direction, int face, int edge)
{
  if (face >= 0) return face;
  int best = -1;
  double most = -2.0;
  const auto look_at = [&](const ConvexCore::Edge &near) {
    for (const int f : near.face) {
      const double along = Talus::dot(core.normal(f), direction);
      if (along <= most) continue;
      most = along;
      best = f;
    }
  };
  if (edge >= 0) {
    look_at(core.edge(edge));
    return best;
  }
  const int v = highest_vertex(core, direction).vertex;
  for (int k = 0; k < core.num_edges_of_vertex(v); k++)
    look_at(core.edge(core.edges_of_vertex(v)[k]));
  return best;
}

/* Corners counterclockwise as seen against the normal of the contact: those of a face that looks
   the other way are taken backward. */

void project(const ConvexCore &core, int f, const Pose &pose, const Frame &frame, bool backward,
             Projected &face)
{
  const int count = core.num_corners(f);
  face.corner.clear();
  face.vertex.clear();
  face.edge.clear();
  for (int k = 0; k < count; k++) {
    const int at = backward ? count - 1 - k : k;
    const int v = core.corners(f)[at];
    face.vertex.push_back(v);
    face.corner.push_back(frame.projected(pose.point_in_space(core.vertex(v))));
    // backward, the edge to the corner before
    face.edge.push_back(core.edges_of_face(f)[backward ? (at + count - 1) % count : at]);
  }
  const Vector n = pose.direction_in_space(core.normal(f));
  const double offset = core.offset(f) + Talus::dot(n, pose.position);
  const double along = Talus::dot(n, frame.normal);
  face.at_origin = offset / along;
  face.slope_x = -Talus::dot(n, frame.x) / along;
  face.slope_y = -Talus::dot(n, frame.y) / along;
}

/* Keeps what is left of the line from one corner of b to the next. */

void cut(std::vector<Corner> &polygon, std::vector<Corner> &buffer, Flat from, Flat to, int edge)
{
  buffer.clear();
  const Flat along = to - from;
  const std::size_t count = polygon.size();
  for (std::size_t k = 0; k < count; k++) {
    const Corner &here = polygon[k], &next = polygon[k + 1 < count ? k + 1 : 0];
    const double side = cross(along, here.place - from), beyond = cross(along, next.place - from);
    if (side >= 0.0) buffer.push_back(here);
    if ((side >= 0.0) == (beyond >= 0.0)) continue;
    const double t = side / (side - beyond);
    const Flat place{here.place.x + t * (next.place.x - here.place.x),
                     here.place.y + t * (next.place.y - here.place.y)};
    if (side >= 0.0)
      buffer.push_back({place, false, edge});    // from here on along the edge of b
    else
      buffer.push_back({place, here.of_a, here.edge});
  }
  polygon.swap(buffer);
}

/* ---- names ----------------------------------------------------------------------------------- */

int corner_near(const Projected &face, Flat p, double reach)
{
  for (std::size_t k = 0; k < face.corner.size(); k++)
    if (square_of(face.corner[k] - p) < reach * reach) return static_cast<int>(k);
  return -1;
}

/// The corner where edges k and l of a face meet, or -1.
int common_corner(const Projected &face, int k, int l)
{
  const int count = static_cast<int>(face.edge.size());
  for (int c = 0; c < count; c++) {
    const int after = face.edge[c], before = face.edge[(c + count - 1) % count];
    if ((after == k && before == l) || (after == l && before == k)) return c;
  }
  return -1;
}

/* By the vertices that are near, not by the side of an edge on which rounding puts them: bodies
   that stand on each other edge to edge keep their contacts. */

std::uint32_t name_of(const Corner &before, const Corner &here, const Projected &a,
                      const Projected &b, double reach)
{
  int at_a = corner_near(a, here.place, reach), at_b = corner_near(b, here.place, reach);
  if (before.of_a && here.of_a && at_a < 0) at_a = common_corner(a, before.edge, here.edge);
  if (at_a >= 0) return contact_name(ContactParts::VERTEX_OF_A, a.vertex[at_a], 0);
  if (!before.of_a && !here.of_a && at_b < 0) at_b = common_corner(b, before.edge, here.edge);
  if (at_b >= 0) return contact_name(ContactParts::VERTEX_OF_B, 0, b.vertex[at_b]);
  const int of_a = before.of_a ? before.edge : here.edge,
            of_b = before.of_a ? here.edge : before.edge;
  return contact_name(ContactParts::EDGES, of_a, of_b);
}

/* ---- weights --------------------------------------------------------------------------------- */

/* Corners that are one but for rounding: directions of sides need some length. The edge that begins
   at the last of them begins at the one that stays. */

void join_corners(std::vector<Corner> &polygon, double reach)
{
  std::size_t kept = 0;
  for (std::size_t k = 0; k < polygon.size(); k++) {
    if (kept > 0 && square_of(polygon[kept - 1].place - polygon[k].place) < reach * reach) {
      polygon[kept - 1].of_a = polygon[k].of_a;
      polygon[kept - 1].edge = polygon[k].edge;
    } else {
      polygon[kept++] = polygon[k];
    }
  }
  while (kept > 1 && square_of(polygon[kept - 1].place - polygon[0].place) < reach * reach) kept--;
  polygon.resize(kept);
}

/* The angle by which the polygon turns at its corner, over a right angle: those of a square have
   the weight 1, all corners together that of four. Where corners merge their angles add up, and one
   on the line between two others has none, so that nothing jumps. */

double turn_at(const std::vector<Corner> &polygon, std::size_t k)
{
  const std::size_t count = polygon.size();
  if (count < 3) return 4.0 / static_cast<double>(count);
  const Flat before = polygon[k].place - polygon[k > 0 ? k - 1 : count - 1].place;
  const Flat after = polygon[k + 1 < count ? k + 1 : 0].place - polygon[k].place;
  return std::max(0.0, std::atan2(cross(before, after), dot(before, after)) / 1.57079632679489662);
}

/* A blunt corner that is alone is as stiff as a contact of two bodies is: with linear springs the
   contacts bear at least as much as the deepest of them would with the weight 1. */

void strengthen(ConvexContact *first, ConvexContact *last)
{
  double deepest = 0.0, sum = 0.0;
  for (const ConvexContact *c = first; c != last; ++c) {
    deepest = std::max(deepest, c->overlap);
    sum += c->weight * c->overlap;
  }
  if (!(sum < deepest) || sum <= 0.0) return;
  for (ConvexContact *c = first; c != last; ++c) c->weight *= deepest / sum;
}

/* Contacts of the same name become one at their common center. */

void merge(std::vector<ConvexContact> &contacts, std::size_t from)
{
  std::size_t kept = from;
  for (std::size_t k = from; k < contacts.size(); k++) {
    const ConvexContact contact = contacts[k];
    if (kept == from || contacts[kept - 1].name != contact.name) {
      contacts[kept++] = contact;
      continue;
    }
    ConvexContact &one = contacts[kept - 1];
    const double sum = one.weight + contact.weight, part = contact.weight / sum;
    one.position = one.position + part * (contact.position - one.position);
    one.overlap += part * (contact.overlap - one.overlap);
    one.weight = sum;
  }
  contacts.resize(kept);
}

/* What is left where the faces have nothing in common: the parts that made the direction. */

ConvexContact single_contact(const CorePair &pair, Rounding radius, const LeastDepth &least)
{
  const Vector n = least.direction;
  const Support low = highest_vertex(pair.a, -n);
  const Support high = highest_vertex(pair.b, pair.seen.direction_in_body(n));
  ConvexContact contact;
  contact.normal = n;
  contact.overlap = least.depth + radius.sum();
  contact.weight = 1.0;
  const Vector at_a = pair.a.vertex(low.vertex), at_b = pair.vertex_of_b(high.vertex);
  const double shift = 0.5 * (radius.of_b - radius.of_a);
  if (least.kind == LeastDepth::FACE_OF_A) {
    contact.name = contact_name(ContactParts::VERTEX_OF_B, 0, high.vertex);
    contact.position = at_b - (0.5 * least.depth - shift) * n;
  } else if (least.kind == LeastDepth::FACE_OF_B) {
    contact.name = contact_name(ContactParts::VERTEX_OF_A, low.vertex, 0);
    contact.position = at_a + (0.5 * least.depth + shift) * n;
  } else {
    contact.name = contact_name(ContactParts::EDGES, least.of_a, least.of_b);
    contact.position = 0.5 * (at_a + at_b) + shift * n;
  }
  return contact;
}

}    // namespace

void add_face_contacts(const CorePair &pair, Rounding radius, const LeastDepth &least,
                       double merging, std::vector<ConvexContact> &contacts)
{
  static thread_local Projected of_a, of_b;
  static thread_local std::vector<Corner> polygon, buffer;
  const Frame frame(least.direction);
  const bool edges = least.kind == LeastDepth::EDGES;
  const int face_of_a =
      face_along(pair.a, -least.direction, edges ? -1 : least.of_a, edges ? least.of_a : -1);
  const int face_of_b = face_along(pair.b, pair.seen.direction_in_body(least.direction),
                                   edges ? -1 : least.of_b, edges ? least.of_b : -1);
  project(pair.a, face_of_a, Pose(), frame, true, of_a);
  project(pair.b, face_of_b, pair.seen, frame, false, of_b);

  polygon.clear();
  for (std::size_t k = 0; k < of_a.corner.size(); k++)
    polygon.push_back({of_a.corner[k], true, of_a.edge[k]});
  for (std::size_t k = 0, count = of_b.corner.size(); k < count && !polygon.empty(); k++)
    cut(polygon, buffer, of_b.corner[k], of_b.corner[k + 1 < count ? k + 1 : 0], of_b.edge[k]);

  join_corners(polygon, 1.0e-5 * merging);
  const std::size_t first = contacts.size();
  for (std::size_t k = 0; k < polygon.size(); k++) {
    const Flat p = polygon[k].place;
    const double bottom = of_a.height(p), top = of_b.height(p);
    ConvexContact contact;
    contact.overlap = top - bottom + radius.sum();
    contact.weight = turn_at(polygon, k);
    if (!(contact.overlap > 0.0) || contact.weight < least_weight) continue;
    contact.position = frame.in_space(p, 0.5 * (bottom + top + radius.of_b - radius.of_a));
    contact.normal = least.direction;
    contact.name =
        name_of(polygon[k > 0 ? k - 1 : polygon.size() - 1], polygon[k], of_a, of_b, merging);
    contacts.push_back(contact);
  }
  sort_by_name(contacts);
  merge(contacts, first);
  strengthen(contacts.data() + first, contacts.data() + contacts.size());
  for (std::size_t k = first; k < contacts.size(); k++) contacts[k].energy = contacts[k].weight;
  if (contacts.size() == first) contacts.push_back(single_contact(pair, radius, least));
}

}    // namespace Talus
