// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/collide_mesh.h"

#include "shape/pair_contacts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Ridge = MeshFeatures::Ridge;
using MeshCorner = MeshFeatures::Corner;

// Edges overlap along directions in which both stand out, or lean to a face of theirs by less than
// this (sine): so what touches does not change where a face lies on a face.
constexpr double lean = 0.4;

constexpr double deepest = 0.3;    // edges overlap by less of the size of the particle

// How exactly edges are behind faces, over the size of the particle.
constexpr double near_enough = 1.0e-3;

// What stands out touches along directions that lead away from one of its faces by more than this
// (sine): not through a plate.
constexpr double through = 1.0e-9;

/// A triangle near the particle that faces its center.
struct Near {
  int triangle, part;    ///< of the mesh; of its detail
  double side;           ///< 1: the center is where its normal points to; -1: on the other side
  Vector normal;         ///< toward the center
  double offset;         ///< of its plane
  double height(const Vector &x) const { return dot(normal, x) - offset; }
};

/// An edge of the particle.
struct Edge {
  int number;
  Vector from, along;
  double square;
  int end[2];
};

bool is_known(const Vector &v)
{
  return v.x != 0.0 || v.y != 0.0 || v.z != 0.0;
}

class MeshContacts {
 public:
  MeshContacts(const ConvexShape &its_shape, const Pose &its_pose, const SolidMesh &mesh,
               double its_exponent, std::vector<ConvexContact> &its_points) :
      shape(its_shape),
      core(its_shape.core()), pose(its_pose), surface(mesh.shape), features(mesh.features),
      detail(mesh.shape.near_detail()), radius(its_shape.radius()),
      bound(its_shape.bounding_radius()), force_exponent(its_exponent), points(its_points)
  {
  }

  bool find();

 private:
  bool look_around();
  void add_vertices();
  void add_in_front(int v, const Vector &x);
  void add_behind(int v, const Vector &x);
  void add_behind_edges(int v, const Vector &x, const Near &at, const NearestPoint &nearest);
  void add_vertex_contact(int v, const Vector &x, const Vector &normal, double overlap, int t);
  bool stands_out(const MeshCorner &corner, const Vector &from_center, const Vector &normal,
                  bool overlaps) const;
  void keep_deepest(int v, int contact);
  void add_corner(const MeshCorner &corner, int t);
  void add_edges(const Ridge &ridge, int t);
  bool turn_outward(const Ridge &ridge, const Vector &at, Vector &normal) const;
  /// The points of two edges that are nearest to each other.
  struct EdgePoint {
    const Edge *edge;
    Vector of_edge, of_ridge;
  };
  Vector plane_normal(int t) const
  {
    const TriangleMesh &mesh = surface.surface();
    return mesh.normal(mesh.plane_of(t));
  }
  bool is_beside(const Ridge &ridge, const Vector &normal) const;
  bool overlaps(const EdgePoint &at, const Ridge &ridge, int t, const Vector &normal) const;
  bool is_nearest(const Ridge &ridge, int t, const Vector &x, double slack, double depth) const;
  const Near *near_of(int triangle) const;
  double height_over(int triangle, const Vector &x) const;

  const ConvexShape &shape;
  const ConvexCore &core;
  const Pose &pose;
  const MeshShape &surface;
  const MeshFeatures &features;
  const MeshDetail &detail;
  const double radius, bound, force_exponent;
  std::vector<ConvexContact> &points;

  // of this thread, used again
  struct Buffers {
    std::vector<NearPart> parts;
    std::vector<Near> near;
    std::vector<int> of_vertex;                         // its deepest contact, or -1
    std::vector<std::pair<int, int>> of_corner;         // vertex of the mesh, contact
    std::vector<const MeshFeatures::Ridge *> ridges;    // and triangles that they belong to
    std::vector<int> of_ridge;
    std::vector<Edge> edges;
  };
  static Buffers &buffers()
  {
    static thread_local Buffers its;
    return its;
  }
  Buffers &with = buffers();
};

bool MeshContacts::look_around()
{
  with.parts.clear();
  with.near.clear();
  if (!surface.is_near(pose.position, bound, with.parts)) return false;
  const TriangleMesh &mesh = surface.surface();
  const MeshSide acting = surface.side();
  for (const NearPart &part : with.parts) {
    const int t = detail.number(part.part);
    const Vector n = detail.normal(part.part);
    const double offset = dot(mesh.vertex(mesh.corners(mesh.plane_of(t)).vertex[0]), n);
    const bool in_front = dot(n, pose.position) >= offset;
    if (acting == (in_front ? MeshSide::BACKS : MeshSide::NORMALS)) continue;
    const double side = in_front ? 1.0 : -1.0;
    with.near.push_back({t, part.part, side, side * n, side * offset});
  }
  return !with.near.empty();
}

double MeshContacts::height_over(int triangle, const Vector &x) const
{
  const TriangleMesh &mesh = surface.surface();
  const int plane = mesh.plane_of(triangle);
  return dot(mesh.normal(plane), x - mesh.vertex(mesh.corners(plane).vertex[0]));
}

const Near *MeshContacts::near_of(int triangle) const
{
  for (const Near &one : with.near)
    if (one.triangle == triangle) return &one;
  return nullptr;
}

bool MeshContacts::find()
{
  if (!look_around()) return false;
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
      with.edges.push_back({e,
                            pose.point_in_space(from),
                            pose.direction_in_space(along),
                            dot(along, along),
                            {edge.vertex[0], edge.vertex[1]}});
    }
    for (std::size_t r = 0; r < with.ridges.size(); r++)
      add_edges(*with.ridges[r], with.of_ridge[r]);
  }
  std::sort(points.begin(), points.end(), [](const ConvexContact &a, const ConvexContact &b) {
    return a.name != b.name ? a.name < b.name : a.surface < b.surface;
  });
  return !points.empty();
}

/* ---- vertices of the particle ----------------------------------------------------------------- */

void MeshContacts::add_vertices()
{
  with.of_vertex.assign(core.num_vertices(), -1);
  for (int v = 0; v < core.num_vertices(); v++) {
    const Vector x = pose.point_in_space(core.vertex(v));
    double lowest = radius;
    for (const Near &one : with.near) lowest = std::min(lowest, one.height(x));
    if (lowest >= radius) continue;
    if (radius > 0.0) add_in_front(v, x);
    if (lowest < 0.0) add_behind(v, x);
  }
}

/* What a vertex touches from the other side than that of the center it has gone through. */

void MeshContacts::add_in_front(int v, const Vector &x)
{
  SurfaceContact found[LargeBodyShape::max_contacts];
  const int count = surface.find_contacts(
      x, radius, {with.parts.data(), with.parts.data() + with.parts.size()}, found);
  for (int k = 0; k < count; k++) {
    const Near *one = near_of(found[k].part);
    if (!one || !(one->height(x) < 0.0 && dot(one->normal, found[k].normal) < 0.0))
      add_vertex_contact(v, x, found[k].normal, found[k].overlap, found[k].part);
  }
}

/* Behind the nearest of the triangles that face the center; beyond the rim of it only if the
   surface goes on there like a valley. The straight way from the center leads through some triangle
   then, and not past it. */

void MeshContacts::add_behind(int v, const Vector &x)
{
  if (std::none_of(with.near.begin(), with.near.end(),
                   [&](const Near &one) { return detail.is_between(one.part, pose.position, x); }))
    return;
  const Near *at = nullptr;
  NearestPoint nearest{};
  for (const Near &one : with.near) {
    const NearestPoint its = detail.nearest(one.part, x);
    if (at && its.square >= nearest.square) continue;
    at = &one;
    nearest = its;
  }
  if (!(at->height(x) < 0.0)) return;
  if (nearest.feature == NearestPoint::FACE)
    add_vertex_contact(v, x, at->normal, radius - at->height(x), at->triangle);
  else
    add_behind_edges(v, x, *at, nearest);
}

void MeshContacts::add_behind_edges(int v, const Vector &x, const Near &at,
                                    const NearestPoint &nearest)
{
  static thread_local std::vector<int> around;
  const Bend sharp = at.side > 0.0 ? Bend::RIDGE : Bend::VALLEY;
  bool stands_out = false;
  const auto look_at = [&](int t, int k) {
    const Bend bend = features.bend(t, k);
    stands_out = stands_out || bend == sharp || bend == Bend::RIM;
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
  const Near *least_deep = nullptr;
  for (const int t : around) {
    const bool in_front = !(at.side * height_over(t, x) < 0.0);
    if (in_front && stands_out) return;    // outside
    const Near *one = near_of(t);
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
  ConvexContact contact;
  contact.normal = normal;
  contact.overlap = overlap;
  contact.position = x - (radius - 0.5 * overlap) * normal;
  contact.weight = 1.0;
  contact.surface = static_cast<std::uint32_t>(mesh.patch(t));
  contact.triangle = t;
  int others = 0;
  for (ConvexContact &one : points) {
    if (one.name >> 15 != contact_name(ContactParts::VERTEX_OF_A, v, 0) >> 15) continue;
    if (one.surface != contact.surface) continue;
    if (dot(one.normal, normal) > TriangleMesh::smooth_cosine) {
      contact.name = one.name;
      if (one.overlap < overlap) one = contact;
      keep_deepest(v, static_cast<int>(&one - points.data()));
      return;
    }
    others++;
  }
  contact.name = contact_name(ContactParts::VERTEX_OF_A, v, others);
  points.push_back(contact);
  keep_deepest(v, static_cast<int>(points.size()) - 1);
}

void MeshContacts::keep_deepest(int v, int contact)
{
  int &kept = with.of_vertex[v];
  if (kept < 0 || points[contact].overlap > points[kept].overlap) kept = contact;
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
  ConvexContact contact;
  contact.normal = normal;
  contact.overlap = overlap;
  contact.position = corner.place - 0.5 * overlap * normal;
  contact.weight = 1.0;
  contact.name = contact_name(ContactParts::VERTEX_OF_B, 0, 0);
  contact.surface = static_cast<std::uint32_t>(corner.vertex);
  contact.triangle = t;
  with.of_corner.emplace_back(corner.vertex, static_cast<int>(points.size()));
  points.push_back(contact);
}

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
  for (const Near &one : with.near) {
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
  for (const Edge &edge : with.edges) {
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
    EdgeWeights weights;
    if (!weights_of_edges(of_end, overlap, force_exponent, weights)) continue;
    for (int k = 0; k < 4; k++)
      if (ends[k] >= 0) points[ends[k]].weight -= weights.of_end[k];
    contact.weight = weights.own;
    contact.normal = normal;
    contact.overlap = overlap;
    contact.position = 0.5 * (of_edge + of_ridge - radius * normal);
    contact.name = contact_name(ContactParts::EDGES, edge.number, 0);
    contact.surface = ridge.name;
    contact.triangle = t;
    points.push_back(contact);
  }
}

}    // namespace

bool collide_mesh(const ConvexShape &shape, const Pose &pose, const SolidMesh &mesh,
                  ConvexContacts &contacts, double force_exponent)
{
  contacts.clear();
  return MeshContacts(shape, pose, mesh, force_exponent, contacts.points).find();
}

}    // namespace Talus
