// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids and convex bodies with edges: of all parts whose normals are those of the common normal, the
// one with the least overlap.

#include "body/shape/frustum.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/touch.h"

#include <cmath>
#include <limits>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Found = SuperellipsoidTouch::Found;

const std::uint32_t whole = contact_name(ContactParts::WHOLE, 0, 0);

// sine of the angle by which a normal may be beyond those of a part: one of two parts, at least, has a normal
// that is at the border of both
constexpr double at_border = 1.0e-9;

/// The least deep of several.
class Least {
 public:
  void take(const Found &found)
  {
    if (found.overlap > 0.0 && found.overlap < overlap) {
      overlap = found.overlap;
      best = found;
    }
  }
  bool finish(double other_curvature, ShapeContacts &contacts) const
  {
    if (!(overlap < std::numeric_limits<double>::infinity())) return false;
    contacts.points.push_back(shape_contact(best, other_curvature, whole));
    return true;
  }

 private:
  double overlap = std::numeric_limits<double>::infinity();
  Found best{};
};

/* ---- convex particles and boxes --------------------------------------------------------------- */

class WithConvex {
 public:
  WithConvex(const PlacedSuperellipsoid &a, const Placed<ConvexShape> &b) :
      touch(a.geometry, a.pose), core(b.geometry.core()), pose(b.pose), radius(b.geometry.radius()),
      center(a.pose.position), reach(a.geometry.bounding_radius() + b.geometry.radius())
  {
  }

  /// false: a face shows that they are apart.
  bool look_at_faces(Least &least) const
  {
    for (int f = 0; f < core.num_faces(); f++) {
      const Vector n = pose.direction_in_space(core.normal(f));
      const double offset = core.offset(f) + dot(n, pose.position) + radius;
      const Found found = touch.plane(n, offset);
      if (!(found.overlap > 0.0)) return false;
      if (is_over(f, found.place) && touch.is_proven(found)) least.take(found);
    }
    return true;
  }
  void look_at_edges(Least &least) const
  {
    for (int e = 0; e < core.num_edges(); e++) {
      const ConvexCore::Edge &edge = core.edge(e);
      const Vector from = core.vertex(edge.vertex[0]), along = core.vertex(edge.vertex[1]) - from;
      const Vector x = pose.point_in_space(from), way = pose.direction_in_space(along);
      Found found;
      if (is_far(x, way) || !touch.edge(x, way, radius, radius, found)) continue;
      const Vector m = -pose.direction_in_body(found.normal);    // out of the body
      const double slack = at_border * length(along);
      if (dot(m, cross(core.normal(edge.face[0]), along)) <= slack &&
          dot(m, cross(along, core.normal(edge.face[1]))) <= slack)
        least.take(found);
    }
  }
  void look_at_vertices(Least &least) const
  {
    for (int v = 0; v < core.num_vertices(); v++) {
      const Vector x = pose.point_in_space(core.vertex(v));
      if (touch.is_beyond(x, radius)) continue;
      const Found found = touch.ball(x, radius);
      if (found.overlap > 0.0 && is_of_vertex(v, -pose.direction_in_body(found.normal)))
        least.take(found);
    }
  }

 private:
  bool is_over(int f, const Vector &x) const
  {
    const Vector own = pose.point_in_body(x);
    const int count = core.num_corners(f), *corner = core.corners(f);
    Vector from = core.vertex(corner[count - 1]);
    for (int k = 0; k < count; k++) {
      const Vector to = core.vertex(corner[k]);
      const double slack = at_border * length(to - from) * length(own - from);
      if (dot(cross(core.normal(f), to - from), own - from) < -slack) return false;
      from = to;
    }
    return true;
  }
  bool is_of_vertex(int v, const Vector &m) const
  {
    for (int k = 0; k < core.num_edges_of_vertex(v); k++) {
      const int *end = core.edge(core.edges_of_vertex(v)[k]).vertex;
      const Vector away = core.vertex(end[0] == v ? end[1] : end[0]) - core.vertex(v);
      if (dot(m, away) > at_border * length(away)) return false;
    }
    return true;
  }
  /// No point of the edge is in the sphere around the shape.
  bool is_far(const Vector &from, const Vector &along) const
  {
    const Vector d = center - from;
    const double t = std::min(1.0, std::max(0.0, dot(d, along) / dot(along, along)));
    const Vector nearest = d - t * along;
    return dot(nearest, nearest) >= reach * reach;
  }

  const SuperellipsoidTouch touch;
  const ConvexCore &core;
  const Pose &pose;
  const double radius;
  const Vector center;
  const double reach;
};

/* ---- cylinders and cones from outside --------------------------------------------------------- */

class WithFrustum {
 public:
  WithFrustum(const PlacedSuperellipsoid &a, const Frustum &frustum) :
      touch(a.geometry, a.pose), body(frustum), center(a.pose.position),
      reach(a.geometry.bounding_radius())
  {
  }

  void look_at_side(Least &least) const
  {
    Found found;
    const Line line = side_line(body.rim(0), body.rim(1));
    if (touch.edge(line.from, line.along, line.r0, line.r1, found) && touch.is_proven(found))
      least.take(found);
  }
  void look_at_cap(int end, Least &least) const
  {
    const Frustum::Rim rim = body.rim(end);
    if (rim.radius > 0.0) {
      const Found found = touch.plane(rim.axis, dot(rim.axis, rim.center));
      const Vector d = found.place - rim.center, across = d - dot(d, rim.axis) * rim.axis;
      if (length(across) <= rim.radius && touch.is_proven(found)) least.take(found);
      look_at_rim(end, rim, least);
    } else {
      const Found found = touch.ball(rim.center, 0.0);
      if (found.overlap > 0.0 && dot(found.normal, rim.axis) < 0.0) least.take(found);
    }
  }

 private:
  struct Line {
    Vector from, along;
    double r0, r1;
  };
  /* The lateral surface is that of the balls whose centers are on the axis and which touch it from inside, in
     circles from one rim to the other. */
  Line side_line(const Frustum::Rim &low, const Frustum::Rim &high) const
  {
    const Vector axis = high.axis;
    if (body.is_infinite()) {
      const double s = dot(center - body.reference_point(), axis);
      const Vector middle = body.reference_point() + s * axis;
      return {middle - 2.0 * reach * axis, 4.0 * reach * axis, low.radius, low.radius};
    }
    const double size = dot(high.center - low.center, axis), fall = low.radius - high.radius;
    const double slope = fall / size, stretch = std::sqrt(1.0 + slope * slope);
    const Vector from = low.center - low.radius * slope * axis,
                 to = high.center - high.radius * slope * axis;
    return {from, to - from, low.radius * stretch, high.radius * stretch};
  }
  void look_at_rim(int end, const Frustum::Rim &rim, Least &least) const
  {
    const Vector d = center - rim.center;
    const double up = dot(d, rim.axis), away = length(d - up * rim.axis) - rim.radius;
    if (up * up + away * away >= reach * reach) return;
    Found found;
    if (!touch.circle({rim.center, rim.side, cross(rim.axis, rim.side), rim.radius}, found)) return;
    // the normal must be between that of the cap and that of the side
    const Vector m = -found.normal;
    Vector out = found.other() - rim.center;
    out = out - dot(out, rim.axis) * rim.axis;
    out = (1.0 / length(out)) * out;
    const Frustum::Rim other = body.rim(1 - end);
    const Vector down = (other.center + other.radius * out) - (rim.center + rim.radius * out);
    if (dot(m, out) >= -at_border && dot(m, down) <= at_border * length(down)) least.take(found);
  }

  const SuperellipsoidTouch touch;
  const Frustum &body;
  const Vector center;
  const double reach;
};

}    // namespace

bool superellipsoid_and_convex(const PlacedSuperellipsoid &a, const Placed<ConvexShape> &b,
                               const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  const WithConvex with(a, b);
  Least least;
  if (!with.look_at_faces(least)) return false;
  with.look_at_edges(least);
  with.look_at_vertices(least);
  return least.finish(1.0 / b.geometry.contact_radius(), contacts);
}

bool superellipsoid_and_round(const PlacedSuperellipsoid &a, const Placed<RoundSurface> &b,
                              const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  const Frustum &body = *b.geometry.body;
  if (body.distance_bound(a.pose.position) >= a.geometry.bounding_radius()) return false;
  const WithFrustum with(a, body);
  Least least;
  with.look_at_side(least);
  if (!body.is_infinite())
    for (const int end : {0, 1}) with.look_at_cap(end, least);
  return least.finish(0.0, contacts);
}

}    // namespace Talus
