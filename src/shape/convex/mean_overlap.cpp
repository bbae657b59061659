// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Each pair of an upper face of b and a lower face of a has a cell, the polygon in which they are
// above each other and g > 0, and g is linear there. With N = sum of areas, F = integral of g^4 the
// overlap is (15 F/N)^(1/4). If the surface of a body moves by u,
//
//   dF = integral of 4 g^3 dg + integral of g^4 u.m ds over its silhouette (m: normal in the plane),
//   dN = integral of u.m ds over its silhouette + integral of dg/|grad g| ds over g = 0,
//
// with dg = u.(1, -slope) for faces of b, and minus that for a: linear in u, so that the integrals
// of g^3, of g^3 times the place, and of lines give force and torque.

#include "shape/convex/mean_overlap.h"

#include "shape/convex/face_projection.h"

#include <algorithm>
#include <limits>

namespace Talus {
namespace {

using Vector = Vector3<double>;

// Faces that look along the plane of projection more than that are its walls.
constexpr double steepest = 1.0e-6;

/// Derivatives by the place of a body and by its turning about the origin.
struct Wrench {
  Vector force{0.0, 0.0, 0.0}, torque{0.0, 0.0, 0.0};
  /// `weight`, and the integral of weight times place, of a direction.
  void add(const Vector &direction, double weight, const Vector &of_place)
  {
    force = force + weight * direction;
    torque = torque + cross(of_place, direction);
  }
  void add(double factor, const Wrench &other)
  {
    force = force + factor * other.force;
    torque = torque + factor * other.torque;
  }
};

struct Sums {
  double area = 0.0, fourth = 0.0;
  Wrench area_of[2], fourth_of[2];    // derivatives by the motion of a, and of b
};

/// A face that may overlap; in the axes of the projection.
struct Side {
  ProjectedFace face;
  std::vector<char> is_silhouette;      // its edges
  Vector lift;                          // dg = u . lift
  std::vector<PolygonCorner> inside;    // what is in the slab, and its bounds
  Flat low, high;

  void keep_inside(double sign, double least_height, PolygonCorner::Side side);
  bool is_beside(const Side &other) const
  {
    return low.x > other.high.x || high.x < other.low.x || low.y > other.high.y ||
           high.y < other.low.y || lies_along(other) || other.lies_along(*this);
  }

 private:
  bool lies_along(const Side &other) const;
};

/* The other one is on the outer side of one of the sides. */

bool Side::lies_along(const Side &other) const
{
  for (std::size_t k = 0, count = inside.size(); k < count; k++) {
    const Flat from = inside[k].place, along = inside[k + 1 < count ? k + 1 : 0].place - from;
    if (square_of(along) > 0.0 &&
        std::all_of(other.inside.begin(), other.inside.end(),
                    [&](const PolygonCorner &c) { return cross(along, c.place - from) <= 0.0; }))
      return true;
  }
  return false;
}

/// Faces of one core that look at the other one and reach into the slab of the overlap.
struct Sides {
  std::vector<Side> all;
  std::vector<int> faces;
  int count = 0;

  void find(const ConvexCore &core, const Pose &pose, const ProjectionFrame &frame, double sign,
            double least_height);
};

/* The side of a polygon where `height` is 0, which grows along the slope, is a cut. */

void cut_at_zero(std::vector<PolygonCorner> &polygon, std::vector<PolygonCorner> &buffer,
                 double at_origin, Flat slope)
{
  const double square = square_of(slope);
  if (square == 0.0 || std::all_of(polygon.begin(), polygon.end(), [&](const PolygonCorner &c) {
        return at_origin + dot(slope, c.place) >= 0.0;
      }))
    return;
  const Flat from = (-at_origin / square) * slope, to{from.x + slope.y, from.y - slope.x};
  cut(polygon, buffer, from, to, PolygonCorner::CUT, 0);
}

void Side::keep_inside(double sign, double least_height, PolygonCorner::Side side)
{
  static thread_local std::vector<PolygonCorner> buffer;
  inside.clear();
  for (int k = 0; k < face.num_corners(); k++)
    inside.push_back({side, face.corner[k], face.edge[k]});
  cut_at_zero(inside, buffer, sign * face.at_origin - least_height, sign * face.slope);
  constexpr double far = std::numeric_limits<double>::infinity();
  low = {far, far};
  high = {-far, -far};
  for (const PolygonCorner &c : inside) {
    low = {std::min(low.x, c.place.x), std::min(low.y, c.place.y)};
    high = {std::max(high.x, c.place.x), std::max(high.y, c.place.y)};
  }
}

/* `sign`: 1 for b, whose upper faces look at a, and -1. */

void Sides::find(const ConvexCore &core, const Pose &pose, const ProjectionFrame &frame,
                 double sign, double least_height)
{
  const Vector up = pose.direction_in_body(sign * frame.normal);
  const double shift = sign * dot(frame.normal, pose.position);
  faces.clear();
  for (int v = 0; v < core.num_vertices(); v++) {
    if (!(dot(up, core.vertex(v)) + shift > least_height)) continue;
    for (int k = 0; k < core.num_edges_of_vertex(v); k++) {    // each face once: left of its edge
      const ConvexCore::Edge &edge = core.edge(core.edges_of_vertex(v)[k]);
      const int f = edge.face[edge.vertex[0] == v ? 0 : 1];
      if (dot(up, core.normal(f)) > steepest) faces.push_back(f);
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  count = static_cast<int>(faces.size());
  if (static_cast<int>(all.size()) < count) all.resize(count);
  for (int n = 0; n < count; n++) {
    Side &side = all[n];
    project(core, faces[n], pose, frame, side.face);
    side.lift = {-sign * side.face.slope.x, -sign * side.face.slope.y, sign};
    side.is_silhouette.clear();
    for (const int e : side.face.edge) {
      const int *both = core.edge(e).face;
      const int beyond = both[0] == faces[n] ? both[1] : both[0];
      side.is_silhouette.push_back(!(dot(up, core.normal(beyond)) > steepest));
    }
    side.keep_inside(sign, least_height, sign > 0.0 ? PolygonCorner::OF_B : PolygonCorner::OF_A);
  }
}

/// A cell, its gaps at the corners, and what they are summed to.
class Cell {
 public:
  Cell(const Side &side_a, const Side &side_b, std::vector<PolygonCorner> &cell_polygon,
       std::vector<PolygonCorner> &buffer) :
      a(side_a),
      b(side_b), polygon(cell_polygon), slope(b.face.slope - a.face.slope),
      at_origin(b.face.at_origin - a.face.at_origin)
  {
    polygon = a.inside;
    for (int k = 0; k < b.face.num_corners() && polygon.size() > 2; k++)
      cut(polygon, buffer, b.face.corner[k], b.face.next_corner(k), PolygonCorner::OF_B,
          b.face.edge[k]);
    cut_at_zero(polygon, buffer, at_origin, slope);
  }

  void add_to(Sums &sums) const
  {
    const std::size_t count = polygon.size();
    if (count < 3) return;
    add_area(sums);
    for (std::size_t k = 0; k < count; k++)
      add_side(polygon[k], polygon[k + 1 < count ? k + 1 : 0].place, sums);
  }

 private:
  double gap(Flat p) const { return at_origin + dot(slope, p); }
  void add_area(Sums &sums) const;
  void add_side(const PolygonCorner &from, Flat to, Sums &sums) const;
  void add_silhouette(const Side &side, Wrench &area, Wrench &fourth, Flat from, Flat to) const;

  const Side &a, &b;
  std::vector<PolygonCorner> &polygon;
  const Flat slope;
  const double at_origin;
};

/* The integral of weight times place on a face, from those of the weight and of weight times p. */

Vector raised(const ProjectedFace &face, double weight, Flat of_place)
{
  return {of_place.x, of_place.y, weight * face.at_origin + dot(face.slope, of_place)};
}

/* Sums of all products of n numbers, each as often as one likes (complete homogeneous polynomials):
   the integral of (sum of g_k times barycentric coordinate k)^n over a triangle is its area times
   2 n!/(n+2)! h_n(g_0, g_1, g_2), its derivative by g_k that of h_n, which is h_{n-1} with g_k once
   more; of a line its length times h_n(g_0, g_1)/(n+1). */

struct Products {
  double h[5] = {1.0, 0.0, 0.0, 0.0, 0.0};
  Products with(double g) const
  {
    Products more;
    for (int n = 1; n < 5; n++) more.h[n] = h[n] + g * more.h[n - 1];
    return more;
  }
};

/* Triangles from the first corner. */

void Cell::add_area(Sums &sums) const
{
  const Flat p = polygon[0].place;
  const double gp = gap(p);
  double third = 0.0;
  Flat of_place{0.0, 0.0};
  for (std::size_t k = 1; k + 1 < polygon.size(); k++) {
    const Flat q = polygon[k].place, r = polygon[k + 1].place;
    const double gq = gap(q), gr = gap(r), area = 0.5 * cross(q - p, r - p);
    const Products all = Products().with(gp).with(gq).with(gr);
    const double of_p = all.with(gp).h[3], of_q = all.with(gq).h[3], of_r = all.with(gr).h[3];
    sums.area += area;
    sums.fourth += area / 15.0 * all.h[4];
    third += area / 60.0 * (of_p + of_q + of_r);
    of_place = of_place + (area / 60.0) * (of_p * p + of_q * q + of_r * r);
  }
  sums.fourth_of[0].add(a.lift, 4.0 * third, raised(a.face, 4.0 * third, 4.0 * of_place));
  sums.fourth_of[1].add(b.lift, 4.0 * third, raised(b.face, 4.0 * third, 4.0 * of_place));
}

void Cell::add_side(const PolygonCorner &from, Flat to, Sums &sums) const
{
  if (from.side == PolygonCorner::CUT) {
    const double ratio = std::sqrt(square_of(to - from.place) / square_of(slope));
    const Flat middle = (0.5 * ratio) * (from.place + to);
    sums.area_of[0].add(a.lift, ratio, raised(a.face, ratio, middle));
    sums.area_of[1].add(b.lift, ratio, raised(b.face, ratio, middle));
    return;
  }
  const bool of_a = from.side == PolygonCorner::OF_A;
  const Side &side = of_a ? a : b;
  const auto at = std::find(side.face.edge.begin(), side.face.edge.end(), from.edge);
  if (side.is_silhouette[at - side.face.edge.begin()])
    add_silhouette(side, sums.area_of[of_a ? 0 : 1], sums.fourth_of[of_a ? 0 : 1], from.place, to);
}

void Cell::add_silhouette(const Side &side, Wrench &area, Wrench &fourth, Flat from, Flat to) const
{
  const Vector outward{to.y - from.y, from.x - to.x, 0.0};    // times the length
  area.add(outward, 1.0, raised(side.face, 1.0, 0.5 * (from + to)));
  const double g = gap(from), h = gap(to);
  const Products both = Products().with(g).with(h);
  const double of_from = both.with(g).h[4] / 30.0, of_to = both.with(h).h[4] / 30.0;
  fourth.add(outward, of_from + of_to,
             raised(side.face, of_from + of_to, of_from * from + of_to * to));
}

Vector in_space(const ProjectionFrame &frame, const Vector &v)
{
  return frame.in_space({v.x, v.y}, v.z);
}

/* A direction across an edge of each turns with both. Turning it alone is turning both bodies back:
   `both` is the sum of their derivatives. */

Vector turn_of_normal(const CorePair &pair, const LeastDepth &least, const Vector &both)
{
  const ConvexCore::Edge &of_a = pair.a.edge(least.of_a), &of_b = pair.b.edge(least.of_b);
  const Vector a = pair.a.vertex(of_a.vertex[1]) - pair.a.vertex(of_a.vertex[0]);
  const Vector b =
      pair.seen.direction_in_space(pair.b.vertex(of_b.vertex[1]) - pair.b.vertex(of_b.vertex[0]));
  const double size = dot(cross(a, b), least.direction);    // with the sign of the direction
  const Vector q = cross(both, least.direction);
  return (1.0 / size) * (dot(q, a) * b - dot(a, b) * q);
}

}    // namespace

bool find_mean_overlap(const CorePair &pair, const LeastDepth &least, double bottom_of_a,
                       double top_of_b, MeanOverlap &overlap)
{
  static thread_local Sides of_a, of_b;
  static thread_local std::vector<PolygonCorner> polygon, buffer;
  const Vector n = least.direction;
  const ProjectionFrame frame(n);
  of_a.find(pair.a, Pose(), frame, -1.0, -top_of_b);
  of_b.find(pair.b, pair.seen, frame, 1.0, bottom_of_a);
  Sums sums;
  for (int s = 0; s < of_a.count; s++)
    for (int t = 0; t < of_b.count; t++)
      if (!of_a.all[s].is_beside(of_b.all[t]))
        Cell(of_a.all[s], of_b.all[t], polygon, buffer).add_to(sums);
  if (!(sums.area > 0.0 && sums.fourth > 0.0)) return false;

  const double o = std::sqrt(std::sqrt(15.0 * sums.fourth / sums.area));
  overlap.value = o;
  Wrench by[2];    // derivatives of the overlap, the direction being fixed
  for (int body = 0; body < 2; body++) {
    Wrench sum;
    sum.add(3.75 / (o * o * o * sums.area), sums.fourth_of[body]);
    sum.add(-0.25 * o / sums.area, sums.area_of[body]);
    by[body] = {in_space(frame, sum.force), in_space(frame, sum.torque)};
  }
  // A direction that moves with a: as if b moved back. Where faces of both are as deep the overlap has a kink, and the
  // mean of both derivatives does not depend on which body is called a.
  const double moves_with_a = least.kind == LeastDepth::FACE_OF_A ? 1.0
                              : least.kind == LeastDepth::FACES   ? 0.5
                                                                  : 0.0;
  overlap.push = moves_with_a * by[1].force - (1.0 - moves_with_a) * by[0].force;
  overlap.turn = moves_with_a * by[1].torque - (1.0 - moves_with_a) * by[0].torque;
  if (least.kind == LeastDepth::EDGES && least.of_a >= 0)
    overlap.turn = overlap.turn + turn_of_normal(pair, least, by[0].torque + by[1].torque);
  return true;
}

}    // namespace Talus
