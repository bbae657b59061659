// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The elastic force of cores that overlap is that of their mean overlap (mean_overlap.h): one force
// and its axis. It is shared among the corners of the polygon that the two faces have in common,
// which friction and damping know: by the barycentric coordinates of the axis in the polygon
// (M. Meyer, A. Barr, H. Lee, M. Desbrun, J. Graph. Tools 7, 13, 2002), none of which is negative.

#include "shape/convex/face_projection.h"
#include "shape/convex/mean_overlap.h"
#include "shape/convex/pair_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Corner = PolygonCorner;

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
      const double along = dot(core.normal(f), direction);
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

/* ---- names ----------------------------------------------------------------------------------- */

int corner_near(const ProjectedFace &face, Flat p, double reach)
{
  for (int k = 0; k < face.num_corners(); k++)
    if (square_of(face.corner[k] - p) < reach * reach) return k;
  return -1;
}

/// The corner where edges k and l of a face meet, or -1.
int common_corner(const ProjectedFace &face, int k, int l)
{
  const int count = face.num_corners();
  for (int c = 0; c < count; c++) {
    const int after = face.edge[c], before = face.edge[(c + count - 1) % count];
    if ((after == k && before == l) || (after == l && before == k)) return c;
  }
  return -1;
}

/* By the vertices that are near, not by the side of an edge on which rounding puts them: bodies
   that stand on each other edge to edge keep their contacts. */

std::uint32_t name_of(const Corner &before, const Corner &here, const ProjectedFace &a,
                      const ProjectedFace &b, double reach)
{
  const bool a_before = before.side == Corner::OF_A, a_here = here.side == Corner::OF_A;
  int at_a = corner_near(a, here.place, reach), at_b = corner_near(b, here.place, reach);
  if (a_before && a_here && at_a < 0) at_a = common_corner(a, before.edge, here.edge);
  if (at_a >= 0) return contact_name(ContactParts::VERTEX_OF_A, a.vertex[at_a], 0);
  if (!a_before && !a_here && at_b < 0) at_b = common_corner(b, before.edge, here.edge);
  if (at_b >= 0) return contact_name(ContactParts::VERTEX_OF_B, 0, b.vertex[at_b]);
  const int of_a = a_before ? before.edge : here.edge, of_b = a_before ? here.edge : before.edge;
  return contact_name(ContactParts::EDGES, of_a, of_b);
}

/* Where the faces have nothing in common: the parts that made the direction. */

std::uint32_t name_of(const CorePair &pair, const LeastDepth &least)
{
  const Vector n = least.direction;
  if (least.kind == LeastDepth::FACE_OF_A) {
    const Support high = highest_vertex(pair.b, pair.seen.direction_in_body(n));
    return contact_name(ContactParts::VERTEX_OF_B, 0, high.vertex);
  }
  if (least.kind == LeastDepth::FACE_OF_B || least.kind == LeastDepth::FACES)
    return contact_name(ContactParts::VERTEX_OF_A, highest_vertex(pair.a, -n).vertex, 0);
  return contact_name(ContactParts::EDGES, std::max(0, least.of_a), std::max(0, least.of_b));
}

/* ---- shares ---------------------------------------------------------------------------------- */

/* Corners that are one but for rounding: directions of sides need some length. The edge that begins
   at the last of them begins at the one that stays. */

void join_corners(std::vector<Corner> &polygon, double reach)
{
  std::size_t kept = 0;
  for (std::size_t k = 0; k < polygon.size(); k++) {
    if (kept > 0 && square_of(polygon[kept - 1].place - polygon[k].place) < reach * reach) {
      polygon[kept - 1].side = polygon[k].side;
      polygon[kept - 1].edge = polygon[k].edge;
    } else {
      polygon[kept++] = polygon[k];
    }
  }
  while (kept > 1 && square_of(polygon[kept - 1].place - polygon[0].place) < reach * reach) kept--;
  polygon.resize(kept);
}

/* Of the corners at a point, or at the one of the polygon that is nearest to it: positive, with the
   sum 1, and the sum of shares times corners is the point. A corner on the line between two others
   has none, and where corners merge theirs add up, so that nothing jumps. */

void find_shares(const std::vector<Corner> &polygon, Flat at, double reach,
                 std::vector<double> &share)
{
  const std::size_t count = polygon.size();
  share.assign(count, 0.0);
  double least = std::numeric_limits<double>::infinity(), part = 0.0;
  std::size_t nearest = 0;
  bool inside = count > 2;
  for (std::size_t k = 0; k < count; k++) {
    const Flat from = polygon[k].place, along = polygon[k + 1 < count ? k + 1 : 0].place - from;
    const double square = square_of(along), before = dot(at - from, along);
    const double t = square > 0.0 ? std::clamp(before / square, 0.0, 1.0) : 0.0;
    const double away = square_of(at - from - t * along);
    inside = inside && cross(along, at - from) > 0.0;
    if (away >= least) continue;
    least = away;
    nearest = k;
    part = t;
  }
  if (!inside || least < reach * reach) {
    share[nearest] += 1.0 - part;
    share[nearest + 1 < count ? nearest + 1 : 0] += part;
    return;
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < count; k++) {
    const Flat here = polygon[k].place, before = polygon[k > 0 ? k - 1 : count - 1].place,
               after = polygon[k + 1 < count ? k + 1 : 0].place;
    share[k] = std::max(0.0, cross(here - before, after - here)) /
               (cross(before - at, here - at) * cross(here - at, after - at));
    sum += share[k];
  }
  for (double &one : share) one /= sum;
}

/* Contacts of the same name become one at their common center. */

void merge(std::vector<ShapeContact> &contacts, std::size_t from)
{
  std::size_t kept = from;
  for (std::size_t k = from; k < contacts.size(); k++) {
    const ShapeContact contact = contacts[k];
    if (kept == from || contacts[kept - 1].name != contact.name) {
      contacts[kept++] = contact;
      continue;
    }
    ShapeContact &one = contacts[kept - 1];
    const double sum = one.weight + contact.weight, part = contact.weight / sum;
    one.position = one.position + part * (contact.position - one.position);
    one.weight = sum;
    one.energy += contact.energy;
  }
  contacts.resize(kept);
}

/* A force along an axis has no torque about it, and points that share it have if they lean: those
   that are r away from the middle by tilt (normal x r). */

void lean(std::vector<ShapeContact> &contacts, std::size_t from, double pitch, double reach)
{
  constexpr double most = 0.1;
  const Vector n = contacts[from].normal;
  double all = 0.0, square = 0.0, farthest = 0.0;
  Vector middle{0.0, 0.0, 0.0};
  for (std::size_t k = from; k < contacts.size(); k++) {
    all += contacts[k].weight;
    middle = middle + contacts[k].weight * contacts[k].position;
  }
  middle = (1.0 / all) * middle;
  for (std::size_t k = from; k < contacts.size(); k++) {
    const Vector r = cross(n, contacts[k].position - middle);
    square += contacts[k].weight / all * dot(r, r);
    farthest = std::max(farthest, dot(r, r));
  }
  if (!(square > reach * reach)) return;
  const double tilt =
      std::clamp(pitch / square, -most / std::sqrt(farthest), most / std::sqrt(farthest));
  for (std::size_t k = from; k < contacts.size(); k++) {
    const Vector leaning = n + tilt * cross(n, contacts[k].position - middle);
    const double size = length(leaning);
    contacts[k].normal = (1.0 / size) * leaning;
    contacts[k].weight *= size;
  }
}

}    // namespace

void add_face_contacts(const CorePair &pair, Rounding radius, const LeastDepth &least,
                       double merging, double force_exponent, std::vector<ShapeContact> &contacts)
{
  static thread_local ProjectedFace of_a, of_b;
  static thread_local std::vector<Corner> polygon, buffer;
  static thread_local std::vector<double> share;
  const Vector n = least.direction;
  const double beside_middle = 0.5 * (radius.of_b - radius.of_a);
  ShapeContact contact;
  contact.overlap = least.depth + radius.sum();
  contact.weight = contact.energy = 1.0;
  contact.normal = n;
  Vector deepest = pair.a.vertex(highest_vertex(pair.a, -n).vertex);
  if (find_single_point(pair, least, deepest)) {
    contact.position = deepest + (0.5 * least.depth + beside_middle) * n;
    contact.name = name_of(pair, least);
    contacts.push_back(contact);
    return;
  }
  const bool edges = least.kind == LeastDepth::EDGES;
  const Vector in_b = pair.seen.direction_in_body(n);
  const ProjectionFrame frame(n);
  project(pair.a, face_along(pair.a, -n, edges ? -1 : least.of_a, edges ? least.of_a : -1), Pose(),
          frame, of_a);
  project(pair.b, face_along(pair.b, in_b, edges ? -1 : least.of_b, edges ? least.of_b : -1),
          pair.seen, frame, of_b);
  common_polygon(of_a, of_b, polygon, buffer);
  join_corners(polygon, 1.0e-5 * merging);

  const double bottom_of_a = -largest_height(pair.a, -n),
               top_of_b = largest_height(pair.b, in_b) + dot(n, pair.seen.position);
  const double height = 0.5 * (bottom_of_a + top_of_b) + beside_middle;
  Vector at = deepest;
  double pitch = 0.0;
  MeanOverlap mean;
  if (find_mean_overlap(pair, least, bottom_of_a, top_of_b, mean)) {
    const double size = length(mean.push), ratio = (mean.value + radius.sum()) / contact.overlap,
                 more = force_exponent == 1.0 ? ratio : std::pow(ratio, force_exponent);
    contact.weight = size * more;
    contact.energy = ratio * more;
    contact.normal = (1.0 / size) * mean.push;
    at = (1.0 / size) * cross(contact.normal, mean.turn);
    pitch = dot(contact.normal, mean.turn) / size;
  }
  const Vector along = (1.0 / dot(n, contact.normal)) * contact.normal;
  const auto axis_at = [&](double z) { return frame.projected(at + (z - dot(n, at)) * along); };
  const std::size_t first = contacts.size();
  if (polygon.empty()) {
    contact.position = frame.in_space(axis_at(height), height);
    contact.name = name_of(pair, least);
    contacts.push_back(contact);
    return;
  }
  find_shares(polygon, axis_at(height), 1.0e-3 * merging, share);
  const ShapeContact all = contact;
  const auto middle_height = [&](Flat p) {
    return 0.5 * (of_a.height(p) + of_b.height(p)) + beside_middle;
  };
  Flat middle{0.0, 0.0};
  double z = 0.0, kept = 0.0;
  for (std::size_t k = 0; k < polygon.size(); k++) {
    if (share[k] < least_weight) continue;
    kept += share[k];
    middle = middle + share[k] * polygon[k].place;
    z += share[k] * middle_height(polygon[k].place);
  }
  middle = (1.0 / kept) * middle;
  z /= kept;
  // an axis beside the polygon, where other faces touch as well, draws the corners near
  double spread = 0.0;
  for (std::size_t k = 0; k < polygon.size(); k++)
    if (share[k] >= least_weight) spread = std::max(spread, square_of(polygon[k].place - middle));
  const Flat axis = axis_at(z);
  const double beside = square_of(axis - middle),
               scale = beside < spread ? 1.0 - std::sqrt(beside / spread) : 0.0;
  for (std::size_t k = 0; k < polygon.size(); k++) {
    if (share[k] < least_weight) continue;
    const Flat p = polygon[k].place;
    contact.weight = share[k] / kept * all.weight;
    contact.energy = share[k] / kept * all.energy;
    contact.position =
        frame.in_space(axis + scale * (p - middle), z + scale * (middle_height(p) - z));
    contact.name =
        name_of(polygon[k > 0 ? k - 1 : polygon.size() - 1], polygon[k], of_a, of_b, merging);
    contacts.push_back(contact);
  }
  sort_by_name(contacts);
  merge(contacts, first);
  lean(contacts, first, pitch, 1.0e-2 * merging);
}

}    // namespace Talus
