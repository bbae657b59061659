// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Convex particles outside a cylinder or a cone: the distance from a convex body, negative inside,
// is a convex function, so that each vertex and each edge of the particle has one nearest point.
// What faces touch are the rims: points at fixed places, and in between the one that is deepest.

#include "shape/collide.h"

#include "body/shape/frustum.h"
#include "shape/pair_contacts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;

constexpr int rim_points = 12;

class RoundContacts {
 public:
  RoundContacts(const ConvexShape &shape, const Pose &its_pose, const Frustum &its_body,
                std::vector<ConvexContact> &its_points) :
      core(shape.core()),
      pose(its_pose), body(its_body), radius(shape.radius()), reach(4.0 * shape.bounding_radius()),
      points(its_points)
  {
  }

  void find()
  {
    add_vertices();
    add_edges();
    if (body.is_endless()) return;
    for (const int end : {0, 1}) add_rim(end);
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
  void add(const Vector &on_particle, const Vector &normal, double overlap, double weight,
           std::uint32_t name)
  {
    ConvexContact contact;
    contact.normal = normal;
    contact.overlap = overlap;
    contact.position = on_particle - (radius - 0.5 * overlap) * normal;
    contact.weight = contact.energy = weight;
    contact.name = name;
    points.push_back(contact);
  }
  void add_vertices();
  void add_edges();
  void add_edge(int e);
  void add_rim(int end);
  void add_deepest(int end, const double (&overlap)[rim_points]);
  /// Of a point of a rim with the particle: 0 if they do not touch.
  double overlap_at(const Vector &x, const Vector &away, const Vector &axis, Vector &normal,
                    CorePoint &nearest) const;

  struct Vertex {
    Vector place, outward;
    double distance;
  };
  const ConvexCore &core;
  const Pose &pose;
  const Frustum &body;
  const double radius, reach;
  std::vector<ConvexContact> &points;
  // of this thread, used again
  struct Buffers {
    std::vector<Vertex> vertices;
    std::vector<double> of_edge;    // overlap of its deepest point, ends included
  };
  static Buffers &buffers()
  {
    static thread_local Buffers its;
    return its;
  }
  std::vector<Vertex> &vertices = buffers().vertices;
  std::vector<double> &of_edge = buffers().of_edge;
};

void RoundContacts::add_vertices()
{
  vertices.resize(core.num_vertices());
  for (int v = 0; v < core.num_vertices(); v++) {
    Vertex &its = vertices[v];
    its.place = pose.point_in_space(core.vertex(v));
    its.distance = distance(its.place, its.outward);
    if (its.distance < radius)
      add(its.place, its.outward, radius - its.distance, 1.0,
          contact_name(ContactParts::VERTEX_OF_A, v, 0));
  }
}

void RoundContacts::add_edges()
{
  of_edge.assign(core.num_edges(), 0.0);
  for (int e = 0; e < core.num_edges(); e++) {
    const int *end = core.edge(e).vertex;
    const Vertex &a = vertices[end[0]], &b = vertices[end[1]];
    const Vector along = b.place - a.place;
    of_edge[e] = std::max(radius - std::min(a.distance, b.distance), 0.0);
    // no point of it is nearer than this
    if (0.5 * (a.distance + b.distance - length(along)) >= radius) continue;
    if (dot(a.outward, along) < 0.0 && dot(b.outward, along) > 0.0) add_edge(e);
  }
}

/* By bisection of the slope. */

void RoundContacts::add_edge(int e)
{
  const int *end = core.edge(e).vertex;
  const Vertex &a = vertices[end[0]], &b = vertices[end[1]];
  const Vector along = b.place - a.place;
  double low = 0.0, high = 1.0, least = reach;
  Vector outward = a.outward, place = a.place;
  for (int step = 0; step < 48; step++) {
    const double middle = 0.5 * (low + high);
    place = a.place + middle * along;
    least = distance(place, outward);
    (dot(outward, along) < 0.0 ? low : high) = middle;
  }
  const double overlap = radius - least;
  if (!(overlap > of_edge[e])) return;
  const double weight = 1.0 - of_edge[e] / overlap;
  of_edge[e] = overlap;
  if (weight > least_weight)
    add(place, outward, overlap, weight, contact_name(ContactParts::EDGES, e, 0));
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
  double overlap[rim_points] = {};
  for (int k = 0; k < count; k++) {
    const double angle = 2.0 * 3.14159265358979323846 * k / rim_points;
    const Vector away = std::cos(angle) * rim.side + std::sin(angle) * cross(rim.axis, rim.side);
    const Vector x = rim.center + rim.radius * away;
    Vector normal;
    CorePoint nearest;
    overlap[k] = overlap_at(x, away, rim.axis, normal, nearest);
    if (overlap[k] > 0.0)
      add(x + (radius - overlap[k]) * normal, normal, overlap[k], 1.0,
          contact_name(ContactParts::VERTEX_OF_B, 0, end * rim_points + k));
  }
  if (rim.radius > 0.0) add_deepest(end, overlap);
}

/* Between two of those points, against each face: of the rim, what is deepest behind its plane, with
   the weight that the two points and the edges of the face leave. */

void RoundContacts::add_deepest(int end, const double (&overlap)[rim_points])
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
    const double its = overlap_at(place, away, rim.axis, normal, nearest);
    if (!(its > 0.0) || nearest.kind != CorePoint::FACE || nearest.part != f) continue;
    const double at = std::atan2(y, x) / (2.0 * 3.14159265358979323846) * rim_points;
    const int before = (static_cast<int>(std::floor(at)) + rim_points) % rim_points;
    double of_ends = std::max(overlap[before], overlap[(before + 1) % rim_points]);
    for (int k = 0; k < core.num_corners(f); k++)
      of_ends = std::max(of_ends, of_edge[core.edges_of_face(f)[k]]);
    const double weight = 1.0 - of_ends / its;
    if (weight > least_weight)
      add(place + (radius - its) * normal, normal, its, weight,
          contact_name(ContactParts::WHOLE, f, end));
  }
}

}    // namespace

bool collide_round(const ConvexShape &shape, const Pose &pose, const Frustum &body,
                   ConvexContacts &contacts)
{
  contacts.clear();
  if (body.distance_bound(pose.position) >= shape.bounding_radius()) return false;
  RoundContacts(shape, pose, body, contacts.points).find();
  return !contacts.points.empty();
}

}    // namespace Talus
