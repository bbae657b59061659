// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids inside of a body. How far a point is behind a wall that is flat or curved inward is a convex function
// of the point. At a flat wall the outermost point of the shape is known, and round ones have one angle (round_wall.h).
//
// In a ball, from any point of the shape the way to that which is outermost along the direction of the wall leads
// outward. It ends where the normals of both are the same and the shape is at least as curved as the wall: in a
// place that is touched, of which there may be several if the shape is flatter than the wall elsewhere. Near by, the
// steps are those of Newton's method. Shapes are flattest at the ends of their axes, and symmetric; so that one place at
// most is looked for in each octant of a shape, from its middle. The way outward does not go beyond a place: if it leaves
// the octant there is none. For most octants the first step shows that, which is made for all eight at once.

#include "body/shape/large_body_shape.h"
#include "shape/superellipsoid/round_wall.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/touch.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/// A unit vector normal to this one.
Vector beside(const Vector &n)
{
  const Vector s = std::abs(n.x) < 0.6 ? Vector{0.0, -n.z, n.y} : Vector{-n.y, n.x, 0.0};
  return (1.0 / length(s)) * s;
}

/// A point of the shape, outermost along a direction, and the wall there.
struct Place {
  Vector normal, x;    ///< in the frame of the body
  Superellipsoid::Point of_shape;
  InwardWall::Outward wall;
  Vector lacking() const { return wall.direction - normal; }
};

Place outermost(const PlacedSuperellipsoid &a, const InwardWall &wall, const Vector &normal)
{
  Place place;
  place.normal = normal;
  place.of_shape = a.geometry.at_normal(a.pose.direction_in_body(normal));
  place.x = a.pose.point_in_space(place.of_shape.place);
  place.wall = wall.from(place.x);
  return place;
}

class Climb {
 public:
  Climb(const PlacedSuperellipsoid &placed, const InwardWall &touched) :
      a(placed), wall(touched), size(placed.geometry.bounding_radius())
  {
  }

  /// Outward from where the wall is in that direction.
  Place from(const Vector &direction) const
  {
    constexpr int most_steps = 200;
    constexpr double enough = 4.0e-16;
    Place place = outermost(a, wall, direction);
    for (int step = 0; step < most_steps; step++) {
      const Vector lacking = place.lacking();
      const double square = dot(lacking, lacking);
      if (square <= enough * enough) break;
      Vector turned;
      if (newton(place, turned)) {
        const Place next = outermost(a, wall, turned);
        if (is_better(next, place, square)) {
          const Vector way = next.x - place.x;
          place = next;
          if (dot(way, way) <= 1.0e-24 * size * size) break;
          continue;
        }
      }
      const Place next = outermost(a, wall, place.wall.direction);
      const bool is_farther = next.wall.behind > place.wall.behind;
      if (is_farther || dot(next.lacking(), next.lacking()) < square) place = next;
      if (!is_farther) break;    // but for rounding it is there
    }
    return place;
  }
  /// The shape is more curved than the wall.
  bool is_summit(const Place &place) const
  {
    Vector turned;
    return newton(place, turned);
  }

 private:
  bool is_better(const Place &next, const Place &place, double square) const
  {
    const double gain = next.wall.behind - place.wall.behind, rounding = 1.0e-14 * size;
    return gain > rounding ||
           (gain > -rounding && dot(next.lacking(), next.lacking()) < 0.9 * square);
  }
  /* With curvatures K of the shape and W of the wall, dn = K dx, and both normals agree after (K - W) dx = lacking. */
  bool newton(const Place &place, Vector &turned) const
  {
    const Vector &n = place.normal;
    const Vector s = beside(n), t = cross(n, s), lacking = place.lacking();
    const Vector by_s = wall.turn(place.x, s), by_t = wall.turn(place.x, t);
    const Vector own_s = a.pose.direction_in_body(s), own_t = a.pose.direction_in_body(t);
    const double ss = place.of_shape.curvature(own_s, own_s),
                 st = place.of_shape.curvature(own_s, own_t),
                 tt = place.of_shape.curvature(own_t, own_t);
    const double mixed = st - 0.5 * (dot(s, by_t) + dot(t, by_s)), in_s = ss - dot(s, by_s),
                 in_t = tt - dot(t, by_t), determinant = in_s * in_t - mixed * mixed;
    if (!(in_s > 0.0 && determinant > 0.0)) return false;
    const double gs = dot(s, lacking), gt = dot(t, lacking);
    const double ds = (in_t * gs - mixed * gt) / determinant,
                 dt = (in_s * gt - mixed * gs) / determinant;
    turned = n + (ss * ds + st * dt) * s + (st * ds + tt * dt) * t;
    turned = (1.0 / length(turned)) * turned;
    return true;
  }

  const PlacedSuperellipsoid &a;
  const InwardWall &wall;
  const double size;
};

/// The places of one ball.
class Places {
 public:
  Places(const PlacedSuperellipsoid &placed, const InwardWall &touched) :
      a(placed), half(placed.geometry.half_axes()), wall(touched), climb(placed, touched)
  {
  }

  void find(const Vector &from_center)
  {
    const Place first = climb.from(from_center);
    if (climb.is_summit(first)) {
      add(first);
      leave_out_octants_at(first.of_shape.place);
    }
    Vector direction[8];
    const unsigned climbing = first_steps(direction);
    for (int octant = 0; octant < 8; octant++)
      if (climbing >> octant & 1U) add(climb.from(direction[octant]));
    if (!count) add(first);
  }
  template <class Visit> void each(Visit visit) const
  {
    for (int k = 0; k < count; k++) visit(found[k]);
  }

 private:
  static Vector signs(int octant)
  {
    return {octant & 1 ? -1.0 : 1.0, octant & 2 ? -1.0 : 1.0, octant & 4 ? -1.0 : 1.0};
  }
  void add(const Place &place)
  {
    const double near_by = 1.0e-3 * a.geometry.bounding_radius();
    if (!(place.wall.behind > 0.0)) return;
    for (int k = 0; k < count; k++)
      if (length(found[k].x - place.x) < near_by) return;
    found[count++] = place;
  }
  void leave_out_octants_at(const Vector &x)
  {
    for (int octant = 0; octant < 8; octant++) left_out[octant] = is_in(octant, x);
  }
  bool is_in(int octant, const Vector &x) const
  {
    constexpr double at_border = 1.0e-3;
    const Vector to = signs(octant);
    return to.x * x.x >= -at_border * half.x && to.y * x.y >= -at_border * half.y &&
           to.z * x.z >= -at_border * half.z;
  }
  /// Bits of the octants that are not left by the first step from their middle, along these directions.
  unsigned first_steps(Vector (&direction)[8]) const
  {
    alignas(64) double own[3][8] = {};
    unsigned seen = 0;
    for (int octant = 0; octant < 8; octant++) {
      const Vector to = 0.5 * signs(octant);
      own[0][octant] = 1.0;
      if (left_out[octant]) continue;
      seen |= 1U << octant;
      direction[octant] =
          wall.from(a.pose.point_in_space({to.x * half.x, to.y * half.y, to.z * half.z})).direction;
      const Vector n = a.pose.direction_in_body(direction[octant]);
      own[0][octant] = n.x;
      own[1][octant] = n.y;
      own[2][octant] = n.z;
    }
    const Vector3<Vec8> normals{load8(own[0]), load8(own[1]), load8(own[2])};
    const Vector3<Vec8> next = a.geometry.formulas().at_normal(normals).place;
    for (int octant = 0; octant < 8; octant++)
      if (!is_in(octant, {next.x[octant], next.y[octant], next.z[octant]})) seen &= ~(1U << octant);
    return seen;
  }

  const PlacedSuperellipsoid &a;
  const Vector half;
  const InwardWall &wall;
  const Climb climb;
  Place found[9];
  int count = 0;
  bool left_out[8] = {};
};

void add_contact(const PlacedSuperellipsoid &a, const Place &place, int part,
                 ShapeContacts &contacts)
{
  SuperellipsoidTouch::Found found;
  found.normal = place.wall.direction;
  found.place = place.x;
  found.overlap = place.wall.behind;
  found.middle = place.x - 0.5 * found.overlap * found.normal;
  found.curvature = a.geometry.curvature_for_laws(place.of_shape);
  const Vector way = place.x - a.pose.position;
  ShapeContact contact = shape_contact(found, 0.0, place_name((1.0 / length(way)) * way));
  contact.is_named_by_place = true;
  contact.surface = static_cast<std::uint32_t>(part);
  contact.part = part;
  contacts.points.push_back(contact);
}

/* Of a ball around the shape: the support function of the shape as seen from its center is sublinear, so that within a
   triangle of directions it is below the greatest value over the distance of the plane of the three from zero. Seven triangles
   cover the directions in which the shape is seen. */

bool may_leave(const PlacedSuperellipsoid &a, const InwardWall &ball, const Vector &direction)
{
  constexpr double cosine[7] = {1.0,
                                0.62348980185873353,
                                -0.22252093395631440,
                                -0.90096886790241913,
                                -0.90096886790241913,
                                -0.22252093395631440,
                                0.62348980185873353};
  constexpr double sine[7] = {0.0,
                              0.78183148246802981,
                              0.97492791218182361,
                              0.43388373911755812,
                              -0.43388373911755812,
                              -0.97492791218182361,
                              -0.78183148246802981};
  constexpr double over_half = 1.1099162641747424;    // 1 / cos(pi / 7)
  const Vector from_center = a.pose.position - ball.point;
  const double size = a.geometry.bounding_radius(), distance = length(from_center);
  if (!(distance > 1.5 * size)) return true;
  const double aside = over_half * size / std::sqrt(distance * distance - size * size);
  const Vector &n = direction;
  const Vector s = beside(n), t = cross(n, s);
  const double inverse = 1.0 / std::sqrt(1.0 + aside * aside);
  Vector seen[lanes];
  for (int k = 0; k < 7; k++)
    seen[k] = inverse * (n + (aside * cosine[k]) * s + (aside * sine[k]) * t);
  seen[7] = n;
  alignas(64) double own[3][lanes], outward[lanes];
  for (int k = 0; k < lanes; k++) {
    const Vector m = a.pose.direction_in_body(seen[k]);
    own[0][k] = m.x;
    own[1][k] = m.y;
    own[2][k] = m.z;
    outward[k] = dot(seen[k], from_center);
  }
  const Vec8 height = a.geometry.formulas()
                          .at_normal(Vector3<Vec8>{load8(own[0]), load8(own[1]), load8(own[2])})
                          .height;
  double most = 0.0;
  for (int k = 0; k < lanes; k++) most = std::max(most, outward[k] + height[k]);
  const Vector across = cross(seen[0] - seen[7], seen[1] - seen[7]);
  return most * length(across) >= ball.radius * std::fabs(dot(across, seen[7]));
}

void touch_wall(const PlacedSuperellipsoid &a, const InwardWall &wall, const Vector &direction,
                ShapeContacts &contacts)
{
  const auto add = [&](const Place &place) {
    if (place.wall.behind > 0.0) add_contact(a, place, wall.part, contacts);
  };
  if (wall.kind == InwardWall::Kind::FLAT) {
    add(outermost(a, wall, direction));
  } else if (wall.kind == InwardWall::Kind::ROUND) {
    Vector normals[RoundWall::most_places];
    const int count = RoundWall(a, wall).find(normals);
    for (int k = 0; k < count; k++) add(outermost(a, wall, normals[k]));
  } else if (may_leave(a, wall, direction)) {
    Places places(a, wall);
    places.find(direction);
    places.each(add);
  }
}

}    // namespace

/* A shape that is far behind a wall is not in the body. The deepest wall comes first. */

bool superellipsoid_and_vessel(const PlacedSuperellipsoid &a, const Placed<VesselSurface> &b,
                               const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  struct Near {
    const InwardWall *wall;
    InwardWall::Outward seen;
  };
  contacts.clear();
  const double size = a.geometry.bounding_radius(), too_far = 4.0 * size;
  Near near[LargeBodyShape::max_contacts];
  int count = 0;
  for (const InwardWall &wall : b.geometry.walls) {
    const InwardWall::Outward seen = wall.from(a.pose.position);
    if (seen.behind >= too_far) return false;
    if (seen.behind > -size) near[count++] = {&wall, seen};
  }
  std::stable_sort(near, near + count, [](const Near &one, const Near &other) {
    return one.seen.behind > other.seen.behind;
  });
  for (int k = 0; k < count; k++) touch_wall(a, *near[k].wall, near[k].seen.direction, contacts);
  return !contacts.points.empty();
}

}    // namespace Talus
