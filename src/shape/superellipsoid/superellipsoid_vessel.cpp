// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Superellipsoids inside of a body. How far a point is behind a wall that is flat or curved inward is a convex function
// of the point, so that from any point of the shape the way to that which is outermost along the direction of the wall
// leads outward. It ends where the normals of both are the same and the shape is at least as curved as the wall: in a
// place that is touched, of which there may be several if the shape is flatter than the wall elsewhere. Near by, the
// steps are those of Newton's method.
//
// Shapes are flattest at the ends of their axes, and symmetric; so that one place at most is looked for in each octant
// of a shape, from its middle. The way outward does not go beyond a place: if it leaves the octant there is none. For
// most octants the first step shows that, which is made for all eight at once.

#include "body/shape/large_body_shape.h"
#include "shape/superellipsoid/superellipsoid_contacts.h"
#include "shape/superellipsoid/touch.h"

#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/// Where a wall is, as seen from a point: the unit vector toward it, and how far the point is behind it.
struct Outward {
  Vector direction;
  double behind;
};

/// One of the walls of a body.
class Wall {
 public:
  Wall(const LargeBodyShape &vessel, int wall_part, double far_enough) :
      body(vessel), part(wall_part), reach(far_enough)
  {
  }
  /// false: it does not act there.
  bool look(const Vector &x, Outward &seen) const
  {
    SurfaceContact found[LargeBodyShape::max_contacts];
    const int count = body.find_contacts(x, reach, {nullptr, nullptr}, found);
    for (int k = 0; k < count; k++)
      if (found[k].part == part) {
        seen = {-found[k].normal, found[k].overlap - reach};
        return true;
      }
    return false;
  }

 private:
  const LargeBodyShape &body;
  const int part;
  const double reach;
};

/// A point of the shape, outermost along a direction, and the wall there.
struct Place {
  Vector normal, x;    ///< in the frame of the body
  Superellipsoid::Point of_shape;
  Outward wall;
  Vector lacking() const { return wall.direction - normal; }
};

class Climb {
 public:
  Climb(const PlacedSuperellipsoid &placed, const Wall &touched) :
      a(placed), wall(touched), size(placed.geometry.bounding_radius())
  {
  }

  /// Outward from where the wall is in that direction. false: it does not act.
  bool from(const Vector &direction, Place &place) const
  {
    constexpr int most_steps = 200;
    constexpr double enough = 4.0e-16;
    if (!outermost(direction, place)) return false;
    for (int step = 0; step < most_steps; step++) {
      const Vector lacking = place.lacking();
      const double square = dot(lacking, lacking);
      if (square <= enough * enough) break;
      Place next;
      Vector turned;
      if (newton(place, turned) && outermost(turned, next) && is_better(next, place, square)) {
        const Vector way = next.x - place.x;
        place = next;
        if (dot(way, way) <= 1.0e-24 * size * size) break;
        continue;
      }
      if (!outermost(place.wall.direction, next)) return false;
      const bool is_farther = next.wall.behind > place.wall.behind;
      if (is_farther || dot(next.lacking(), next.lacking()) < square) place = next;
      if (!is_farther) break;    // but for rounding it is there
    }
    return true;
  }
  /// The shape is more curved than the wall.
  bool is_summit(const Place &place) const
  {
    Vector turned;
    return newton(place, turned);
  }

 private:
  bool outermost(const Vector &normal, Place &place) const
  {
    place.normal = normal;
    place.of_shape = a.geometry.at_normal(a.pose.direction_in_body(normal));
    place.x = a.pose.point_in_space(place.of_shape.place);
    return wall.look(place.x, place.wall);
  }
  bool is_better(const Place &next, const Place &place, double square) const
  {
    const double gain = next.wall.behind - place.wall.behind, rounding = 1.0e-14 * size;
    return gain > rounding ||
           (gain > -rounding && dot(next.lacking(), next.lacking()) < 0.9 * square);
  }
  /* With curvatures K of the shape and W of the wall, dn = K dx, and both normals agree after (K - W) dx = lacking. */
  bool newton(const Place &place, Vector &turned) const
  {
    const double part = 1.0e-6 * size;
    const Vector &n = place.normal;
    Vector s = std::abs(n.x) < 0.6 ? Vector{0.0, -n.z, n.y} : Vector{-n.y, n.x, 0.0};
    s = (1.0 / length(s)) * s;
    const Vector t = cross(n, s), lacking = place.lacking();
    Outward along_s, along_t;
    if (!wall.look(place.x + part * s, along_s) || !wall.look(place.x + part * t, along_t))
      return false;
    const Vector by_s = (1.0 / part) * (along_s.direction - place.wall.direction),
                 by_t = (1.0 / part) * (along_t.direction - place.wall.direction);
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
  const Wall &wall;
  const double size;
};

/// The places of one wall.
class Places {
 public:
  Places(const PlacedSuperellipsoid &placed, const Wall &touched) :
      a(placed), half(placed.geometry.half_axes()), wall(touched), climb(placed, touched)
  {
  }

  void find(const Vector &from_center)
  {
    Place first;
    if (!climb.from(from_center, first)) return;
    if (is_flat(from_center)) return add(first);
    if (climb.is_summit(first)) {
      add(first);
      leave_out_octants_at(first.of_shape.place);
    }
    Vector direction[8];
    const unsigned climbing = first_steps(direction);
    for (int octant = 0; octant < 8; octant++) {
      Place place;
      if ((climbing >> octant & 1U) && climb.from(direction[octant], place)) add(place);
    }
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
  /// It has one normal.
  bool is_flat(const Vector &normal) const
  {
    for (const double side : {1.0, -1.0})
      for (const Vector &end : {Vector{side * half.x, 0.0, 0.0}, Vector{0.0, side * half.y, 0.0},
                                Vector{0.0, 0.0, side * half.z}}) {
        Outward seen;
        if (!wall.look(a.pose.point_in_space(end), seen)) continue;
        const Vector turned = seen.direction - normal;
        if (dot(turned, turned) >= 1.0e-24) return false;
      }
    return true;
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
      Outward at_wall;
      own[0][octant] = 1.0;
      if (left_out[octant] ||
          !wall.look(a.pose.point_in_space({to.x * half.x, to.y * half.y, to.z * half.z}), at_wall))
        continue;
      seen |= 1U << octant;
      direction[octant] = at_wall.direction;
      const Vector n = a.pose.direction_in_body(at_wall.direction);
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
  const Wall &wall;
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

}    // namespace

bool superellipsoid_and_vessel(const PlacedSuperellipsoid &a, const Placed<VesselSurface> &b,
                               const CollisionRequest & /*request*/, ShapeContacts &contacts)
{
  contacts.clear();
  const LargeBodyShape &body = *b.geometry.body;
  const double size = a.geometry.bounding_radius(), reach = 4.0 * size;
  if (body.distance_bound(a.pose.position) >= size) return false;
  SurfaceContact around[LargeBodyShape::max_contacts];
  const int count = body.find_contacts(a.pose.position, reach, {nullptr, nullptr}, around);
  for (int k = 0; k < count; k++) {
    if (reach - around[k].overlap >= size) continue;
    const Wall wall(body, around[k].part, reach);
    Places places(a, wall);
    places.find(-around[k].normal);
    places.each([&](const Place &place) { add_contact(a, place, around[k].part, contacts); });
  }
  return !contacts.points.empty();
}

}    // namespace Talus
