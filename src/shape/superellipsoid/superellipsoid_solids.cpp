// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids and convex bodies with edges: of all faces, and of the edges and corners that have the common normal,
// the one with the least overlap. That of a face is the way to be apart along its normal, wherever the shape is.
//
// That they touch is seen by a point of both. Either an edge of the body is in the shape; or all that a face cuts out
// of the shape is in the interior of the face: then a straight line from the center of the shape to its lowest point,
// as seen from the face, goes through it, unless the center is in the body or behind another face.

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

  bool find(Least &least)
  {
    if (!look_at_faces(least)) return false;
    look_at_edges(least);
    look_at_vertices(least);
    return is_touched || meets_a_face();
  }

 private:
  /// false: a face shows that they are apart.
  bool look_at_faces(Least &least) const
  {
    for (int f = 0; f < core.num_faces(); f++) {
      const Found found = below(f);
      if (!(found.overlap > 0.0)) return false;
      least.take(found);
    }
    return true;
  }
  void look_at_edges(Least &least)
  {
    for (int e = 0; e < core.num_edges(); e++) {
      const ConvexCore::Edge &edge = core.edge(e);
      const Vector from = core.vertex(edge.vertex[0]), along = core.vertex(edge.vertex[1]) - from;
      const Vector x = pose.point_in_space(from), way = pose.direction_in_space(along);
      if (is_far(x, way)) continue;
      const SuperellipsoidTouch::AlongLine line = touch.edge(x, way, radius, radius);
      is_touched |= line.touches;
      if (!line.is_within) continue;
      const Vector m = -pose.direction_in_body(line.deepest.normal);    // out of the body
      const double slack = at_border * length(along);
      if (dot(m, cross(core.normal(edge.face[0]), along)) <= slack &&
          dot(m, cross(along, core.normal(edge.face[1]))) <= slack)
        least.take(line.deepest);
    }
  }
  void look_at_vertices(Least &least)
  {
    for (int v = 0; v < core.num_vertices(); v++) {
      const Vector x = pose.point_in_space(core.vertex(v));
      if (touch.is_beyond(x, radius)) continue;
      const Found found = touch.ball(x, radius);
      if (!(found.overlap > 0.0)) continue;
      is_touched = true;
      if (is_of_vertex(v, -pose.direction_in_body(found.normal))) least.take(found);
    }
  }
  Found below(int f) const
  {
    const Vector n = pose.direction_in_space(core.normal(f));
    return touch.plane(n, core.offset(f) + dot(n, pose.position) + radius);
  }
  bool meets_a_face() const
  {
    const Vector from = pose.point_in_body(center);
    for (int f = 0; f < core.num_faces(); f++) {
      const Vector lowest = pose.point_in_body(below(f).place) - radius * core.normal(f);
      if (meets_core(from, lowest - from)) return true;
    }
    return false;
  }
  /// A straight line, cut off by all planes.
  bool meets_core(const Vector &from, const Vector &way) const
  {
    double begin = 0.0, end = 1.0;
    for (int f = 0; f < core.num_faces(); f++) {
      const double height = dot(core.normal(f), from) - core.offset(f),
                   rise = dot(core.normal(f), way);
      if (rise < 0.0)
        begin = std::max(begin, -height / rise);
      else if (rise > 0.0)
        end = std::min(end, -height / rise);
      else if (height > 0.0)
        return false;
    }
    return begin <= end;
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
  bool is_touched = false;    ///< an edge or corner is in the shape
};

/* ---- cylinders and cones from outside --------------------------------------------------------- */

class WithFrustum {
 public:
  WithFrustum(const PlacedSuperellipsoid &a, const Frustum &frustum) :
      touch(a.geometry, a.pose), body(frustum), center(a.pose.position),
      reach(a.geometry.bounding_radius())
  {
  }

  bool find(Least &least)
  {
    look_at_side(least);
    if (body.is_infinite()) return is_touched;
    for (const int end : {0, 1})
      if (!look_at_cap(end, least)) return false;
    return is_touched || is_in_body(center);
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
  void look_at_side(Least &least)
  {
    const Line line = side_line(body.rim(0), body.rim(1));
    const SuperellipsoidTouch::AlongLine side = touch.edge(line.from, line.along, line.r0, line.r1);
    if (!side.is_within) return;
    least.take(side.deepest);
    // beyond the axis that is in the shape itself
    is_touched |= body.is_infinite() || is_in_body(side.deepest.place) ||
                  (touch.is_inside(side.of_ball) && is_in_body(side.of_ball));
  }
  /// false: it shows that they are apart.
  bool look_at_cap(int end, Least &least)
  {
    const Frustum::Rim rim = body.rim(end);
    const double offset = dot(rim.axis, rim.center), height = dot(rim.axis, center) - offset;
    const Found found = touch.plane(rim.axis, offset);
    if (!(found.overlap > 0.0)) return false;
    least.take(found);
    if (rim.radius > 0.0) {
      // the straight line to the lowest point, or from below to the highest
      const Found ahead = height >= 0.0 ? found : touch.plane(-rim.axis, -offset);
      if (ahead.overlap > 0.0) {
        const Vector x = touch.crossing(ahead, std::abs(height)) - rim.center;
        is_touched |= dot(x, x) <= rim.radius * rim.radius;
      }
      look_at_rim(end, rim, least);
    } else {
      const Found tip = touch.ball(rim.center, 0.0);
      if (!(tip.overlap > 0.0)) return true;
      is_touched = true;
      if (is_of_tip(end, rim, -tip.normal)) least.take(tip);
    }
    return true;
  }
  /// In the closed body.
  bool is_in_body(const Vector &x) const
  {
    const Frustum::Rim low = body.rim(0), high = body.rim(1);
    const Vector d = x - low.center;
    const double s = dot(d, high.axis), size = dot(high.center - low.center, high.axis);
    return s >= 0.0 && s <= size &&
           length(d - s * high.axis) <= low.radius + s / size * (high.radius - low.radius);
  }
  /// All points of the body are behind a plane through the tip with this normal.
  bool is_of_tip(int end, const Frustum::Rim &tip, const Vector &m) const
  {
    const Frustum::Rim other = body.rim(1 - end);
    const double up = dot(m, tip.axis), size = dot(tip.center - other.center, tip.axis);
    return other.radius * length(m - up * tip.axis) <=
           up * size + at_border * (other.radius + size);
  }
  void look_at_rim(int end, const Frustum::Rim &rim, Least &least)
  {
    const Vector d = center - rim.center;
    const double up = dot(d, rim.axis), away = length(d - up * rim.axis) - rim.radius;
    if (up * up + away * away >= reach * reach) return;
    const SuperellipsoidTouch::AlongLine line =
        touch.circle({rim.center, rim.side, cross(rim.axis, rim.side), rim.radius});
    is_touched |= line.touches;
    if (!line.is_within) return;
    // the normal must be between that of the cap and that of the side
    const Found &found = line.deepest;
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
  bool is_touched = false;    ///< a point of both is known
};

}    // namespace

bool superellipsoid_and_convex(const PlacedSuperellipsoid &a, const Placed<ConvexShape> &b,
                               const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  Least least;
  if (!WithConvex(a, b).find(least)) return false;
  return least.finish(1.0 / b.geometry.contact_radius(), contacts);
}

bool superellipsoid_and_round(const PlacedSuperellipsoid &a, const Placed<RoundSurface> &b,
                              const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  const Frustum &body = *b.geometry.body;
  if (body.distance_bound(a.pose.position) >= a.geometry.bounding_radius()) return false;
  Least least;
  return WithFrustum(a, body).find(least) && least.finish(0.0, contacts);
}

}    // namespace Talus
