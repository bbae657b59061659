// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Convex particles outside a cylinder or a cone: the distance from a convex body, negative inside,
// is a convex function, so that each vertex and each edge of the particle has one nearest point.
// What faces touch are the rims: points at fixed places, and in between the one that is deepest.

#include "shape/convex/collide.h"

#include "body/shape/frustum.h"
#include "shape/convex/pair_contacts.h"
#include "shape/convex/shared_energy.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;

constexpr int rim_points = 12;

// Cosine of the angle between normals on both sides of a point of an edge: below, they are two.
constexpr double no_kink = 1.0 - 1.0e-12;

class RoundContacts {
 public:
  RoundContacts(const ConvexShape &shape, const Pose &particle_pose, const Frustum &frustum,
                double exponent, std::vector<ShapeContact> &found_points) :
      core(shape.core()),
      pose(particle_pose), body(frustum), radius(shape.radius()),
      reach(4.0 * shape.bounding_radius()), force_exponent(exponent), points(found_points)
  {
  }

  void find()
  {
    add_vertices();
    add_edges();
    if (!body.is_infinite())
      for (const int end : {0, 1}) add_rim(end);
    for (std::size_t k = 0; k < edges.size(); k++) points[first_edge + k].weight *= edges[k].slope;
    sort_by_name(points);
  }

 private:
  /// Distance of the surface, and its gradient. Beyond reach: reach.
  double distance(const Vector &x, Vector &outward) const
  {
    SurfaceContact found;
    if (!body.touches(x, reach, found)) return reach;
    outward = found.normal;
    return reach - found.overlap;
  }
  /// Returns its number.
  int add(const Vector &on_particle, const Vector &normal, double overlap, std::uint32_t name)
  {
    ShapeContact contact;
    contact.normal = normal;
    contact.overlap = overlap;
    contact.position = on_particle - (radius - 0.5 * overlap) * normal;
    contact.weight = 1.0;
    contact.name = name;
    points.push_back(contact);
    return static_cast<int>(points.size()) - 1;
  }
  /// One that shares its energy, see `energy`, if anything is left of it.
  int add_shared(const Vector &on_particle, const Vector &normal, double overlap,
                 std::uint32_t name)
  {
    if (!energy.finish()) return -1;
    const int contact = add(on_particle, normal, overlap, name);
    points[contact].weight = energy.weight();
    points[contact].energy = energy.energy();
    take_shares();
    return contact;
  }
  /// Also from the ends of edges, which have less to do with this than the edges themselves have.
  void take_shares()
  {
    energy.visit_ends([this](int contact, double share, double weight) {
      if (contact < first_edge || contact >= first_edge + static_cast<int>(edges.size())) {
        points[contact].weight -= weight;
        return;
      }
      const EdgeContact &edge = edges[contact - first_edge];
      const double part = weight / share;
      points[contact].weight -= part * edge.weight;
      for (int k = 0; k < edge.num_ends; k++) points[edge.end[k]].weight += part * edge.taken[k];
    });
  }
  /// With the share that it has left to its own ends, so that it counts less the nearer it is to them.
  void add_end(int contact)
  {
    if (contact >= 0) energy.add_end(contact, points[contact].overlap, points[contact].energy);
  }
  void add_vertices();
  void add_edges();
  void add_edge(int e);
  void add_rim(int end);
  void add_deepest(int end, const int (&contact)[rim_points]);
  /// Of a point of a rim with the particle: 0 if they do not touch.
  double overlap_at(const Vector &x, const Vector &away, const Vector &axis, Vector &normal,
                    CorePoint &nearest) const;

  struct Vertex {
    Vector place, outward;
    double distance;
    int contact;    // or -1
  };
  /// The contact of an edge: its weight and what it takes from its ends, before rims share with it; and
  /// by how much its overlap changes as it moves along its normal.
  struct EdgeContact {
    double weight, slope;
    int num_ends, end[2];
    double taken[2];
  };
  const ConvexCore &core;
  const Pose &pose;
  const Frustum &body;
  const double radius, reach, force_exponent;
  std::vector<ShapeContact> &points;
  // of this thread, used again
  struct Buffers {
    std::vector<Vertex> vertices;
    std::vector<int> of_edge;          // its contact between the ends, or -1
    std::vector<EdgeContact> edges;    // those, in the order of their contacts
    SharedEnergy energy;
  };
  static Buffers &buffers()
  {
    static thread_local Buffers of_thread;
    return of_thread;
  }
  std::vector<Vertex> &vertices = buffers().vertices;
  std::vector<int> &of_edge = buffers().of_edge;
  std::vector<EdgeContact> &edges = buffers().edges;
  int first_edge = 0;    // the contact of the first one
  SharedEnergy &energy = buffers().energy;
};

void RoundContacts::add_vertices()
{
  vertices.resize(core.num_vertices());
  for (int v = 0; v < core.num_vertices(); v++) {
    Vertex &vertex = vertices[v];
    vertex.place = pose.point_in_space(core.vertex(v));
    vertex.distance = distance(vertex.place, vertex.outward);
    vertex.contact = -1;
    if (vertex.distance < radius)
      vertex.contact = add(vertex.place, vertex.outward, radius - vertex.distance,
                           contact_name(ContactParts::VERTEX_OF_A, v, 0));
  }
}

void RoundContacts::add_edges()
{
  of_edge.assign(core.num_edges(), -1);
  edges.clear();
  first_edge = static_cast<int>(points.size());
  for (int e = 0; e < core.num_edges(); e++) {
    const int *end = core.edge(e).vertex;
    const Vertex &a = vertices[end[0]], &b = vertices[end[1]];
    const Vector along = b.place - a.place;
    // no point of it is nearer than this
    if (0.5 * (a.distance + b.distance - length(along)) >= radius) continue;
    if (dot(a.outward, along) < 0.0 && dot(b.outward, along) > 0.0) add_edge(e);
  }
}

/* By bisection of the slope. Inside the body it may jump there, between a cap and the mantle: the
   overlap then changes as along the mean of both normals that is perpendicular to the edge. */

void RoundContacts::add_edge(int e)
{
  const int *end = core.edge(e).vertex;
  const Vertex &a = vertices[end[0]], &b = vertices[end[1]];
  const Vector along = b.place - a.place;
  double low = 0.0, high = 1.0, least = reach;
  Vector outward = a.outward, place = a.place, before = a.outward, beyond = b.outward;
  for (int step = 0; step < 48; step++) {
    const double middle = 0.5 * (low + high);
    place = a.place + middle * along;
    least = distance(place, outward);
    const bool falls = dot(outward, along) < 0.0;
    (falls ? low : high) = middle;
    (falls ? before : beyond) = outward;
  }
  const double overlap = radius - least;
  if (!(overlap > 0.0)) return;
  double slope = 1.0;
  if (dot(before, beyond) < no_kink) {
    const double falling = -dot(before, along), rising = dot(beyond, along);
    outward = (1.0 / (falling + rising)) * (rising * before + falling * beyond);
    slope = length(outward);
    outward = slope > 0.0 ? (1.0 / slope) * outward : before;
  }
  energy.begin(overlap, force_exponent);
  add_end(a.contact);
  add_end(b.contact);
  of_edge[e] = add_shared(place, outward, overlap, contact_name(ContactParts::EDGES, e, 0));
  if (of_edge[e] < 0) return;
  EdgeContact edge{energy.weight(), slope, 0, {}, {}};
  energy.visit_ends([&edge](int contact, double /*share*/, double weight) {
    edge.end[edge.num_ends] = contact;
    edge.taken[edge.num_ends++] = weight;
  });
  edges.push_back(edge);
}

/* ---- rims ------------------------------------------------------------------------------------- */

double RoundContacts::overlap_at(const Vector &x, const Vector &away, const Vector &axis,
                                 Vector &normal, CorePoint &nearest) const
{
  nearest = nearest_point(core, pose.point_in_body(x));
  normal = -pose.direction_in_space(nearest.normal);
  const bool stands_out = std::max(dot(normal, away), dot(normal, axis)) > 1.0e-9;
  return stands_out ? std::max(radius - nearest.distance, 0.0) : 0.0;
}

void RoundContacts::add_rim(int end)
{
  const Frustum::Rim rim = body.rim(end);
  const int count = rim.radius > 0.0 ? rim_points : 1;
  int contact[rim_points];
  for (int k = 0; k < count; k++) {
    const double angle = 2.0 * 3.14159265358979323846 * k / rim_points;
    const Vector away = std::cos(angle) * rim.side + std::sin(angle) * cross(rim.axis, rim.side);
    const Vector x = rim.center + rim.radius * away;
    Vector normal;
    CorePoint nearest;
    const double overlap = overlap_at(x, away, rim.axis, normal, nearest);
    contact[k] = -1;
    if (overlap > 0.0)
      contact[k] = add(x + (radius - overlap) * normal, normal, overlap,
                       contact_name(ContactParts::VERTEX_OF_B, 0, end * rim_points + k));
  }
  if (rim.radius > 0.0) add_deepest(end, contact);
}

/* Between two of those points, against each face: of the rim, what is deepest behind its plane, with
   what the two points and the corners and edges of the face leave. */

void RoundContacts::add_deepest(int end, const int (&contact)[rim_points])
{
  const Frustum::Rim rim = body.rim(end);
  const Vector other = cross(rim.axis, rim.side);
  for (int f = 0; f < core.num_faces(); f++) {
    const Vector m = pose.direction_in_space(core.normal(f));
    const double x = -dot(m, rim.side), y = -dot(m, other), size = std::sqrt(x * x + y * y);
    if (!(size > 1.0e-9)) continue;
    const Vector away = (x / size) * rim.side + (y / size) * other;
    const Vector place = rim.center + rim.radius * away;
    Vector normal;
    CorePoint nearest;
    const double overlap = overlap_at(place, away, rim.axis, normal, nearest);
    if (!(overlap > 0.0) || nearest.kind != CorePoint::FACE || nearest.part != f) continue;
    const double at = std::atan2(y, x) / (2.0 * 3.14159265358979323846) * rim_points;
    const int before = (static_cast<int>(std::floor(at)) + rim_points) % rim_points;
    energy.begin(overlap, force_exponent);
    add_end(contact[before]);
    add_end(contact[(before + 1) % rim_points]);
    for (int k = 0; k < core.num_corners(f); k++) {
      add_end(vertices[core.corners(f)[k]].contact);
      add_end(of_edge[core.edges_of_face(f)[k]]);
    }
    add_shared(place + (radius - overlap) * normal, normal, overlap,
               contact_name(ContactParts::WHOLE, f, end));
  }
}

}    // namespace

bool collide_round(const ConvexShape &shape, const Pose &pose, const Frustum &body,
                   ShapeContacts &contacts, double force_exponent)
{
  contacts.clear();
  if (body.distance_bound(pose.position) >= shape.bounding_radius()) return false;
  RoundContacts(shape, pose, body, force_exponent, contacts.points).find();
  return !contacts.points.empty();
}

}    // namespace Talus
