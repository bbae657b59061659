// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/least_overlap.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

using Vector = Vector3<double>;
using Point = Superellipsoid::Point;

/// Components along two tangents.
struct Flat {
  double s, t;
};
struct FlatMatrix {    // rows
  double ss, st, ts, tt;
  Flat operator*(Flat v) const { return {ss * v.s + st * v.t, ts * v.s + tt * v.t}; }
  FlatMatrix operator*(const FlatMatrix &m) const
  {
    return {ss * m.ss + st * m.ts, ss * m.st + st * m.tt, ts * m.ss + tt * m.ts,
            ts * m.st + tt * m.tt};
  }
  FlatMatrix operator+(const FlatMatrix &m) const
  {
    return {ss + m.ss, st + m.st, ts + m.ts, tt + m.tt};
  }
  double trace() const { return ss + tt; }
};
FlatMatrix operator*(double factor, const FlatMatrix &m)
{
  return {factor * m.ss, factor * m.st, factor * m.ts, factor * m.tt};
}

/* What the search knows of the other body: the point with a normal along n, mirrored about its center (so of
   -n, since both kinds are symmetric), and how it moves when n turns by dn: turn * dn = move * dplace. */

class OtherSuperellipsoid {
 public:
  OtherSuperellipsoid(const Superellipsoid &superellipsoid, const Pose &b_seen) :
      shape(superellipsoid), seen(b_seen)
  {
  }
  static constexpr bool leads = true;

  struct At {
    Vector place;
    double height;
    Point own;
  };
  At at_normal(const Vector &n) const { return of(shape.at_normal(seen.direction_in_body(n))); }
  /// Moved along the surface.
  At moved(const At &from, const Vector &way, Vector &normal) const
  {
    const At to = of(shape.on_ray(from.own.place + seen.direction_in_body(way)));
    normal = seen.direction_in_space(to.own.normal);
    return to;
  }
  FlatMatrix curvature(const At &at, const Vector &s, const Vector &t) const
  {
    const Vector ls = seen.direction_in_body(s), lt = seen.direction_in_body(t);
    const double st = at.own.curvature(ls, lt);
    return {at.own.curvature(ls, ls), st, st, at.own.curvature(lt, lt)};
  }
  static FlatMatrix turn() { return {1.0, 0.0, 0.0, 1.0}; }
  FlatMatrix move(const At &at, const Vector &s, const Vector &t) const
  {
    return curvature(at, s, t);
  }
  bool contains(const Vector &x) const { return shape.gauge(seen.point_in_body(x)) < 1.0; }
  const Vector &center() const { return seen.position; }
  double inscribed_radius() const { return shape.inscribed_radius(); }

  const Superellipsoid &shape;

 private:
  At of(const Point &own) const { return {seen.direction_in_space(own.place), own.height, own}; }

  const Pose &seen;
};

class OtherBall {
 public:
  OtherBall(const Vector &ball_center, double ball_radius) :
      middle(ball_center), radius(ball_radius)
  {
  }
  static constexpr bool leads = false;

  struct At {
    Vector place;
    double height;
  };
  At at_normal(const Vector &n) const { return {radius * n, radius}; }
  At moved(const At &from, const Vector & /*way*/, Vector & /*normal*/) const { return from; }
  FlatMatrix curvature(const At & /*at*/, const Vector & /*s*/, const Vector & /*t*/) const
  {
    return {};
  }
  FlatMatrix turn() const { return {radius, 0.0, 0.0, radius}; }
  FlatMatrix move(const At & /*at*/, const Vector & /*s*/, const Vector & /*t*/) const
  {
    return {1.0, 0.0, 0.0, 1.0};
  }
  const Vector &center() const { return middle; }

 private:
  Vector middle;
  double radius;
};

template <class Other> class Search {
 public:
  Search(const Superellipsoid &superellipsoid, const Other &other_body) :
      a(superellipsoid), b(other_body), d(other_body.center()),
      size(superellipsoid.bounding_radius())
  {
  }

  struct State {
    Vector normal;
    Point of_a;
    typename Other::At of_b;
    double overlap, ratio;    ///< of n . d and the sum of the heights
  };
  State at_normal(const Vector &n) const { return state(n, a.at_normal(n), b.at_normal(n)); }
  State at(const Point &of_a) const { return state(of_a.normal, of_a, b.at_normal(of_a.normal)); }

  enum class Goal { LEAST_OVERLAP, LARGEST_RATIO };
  /// Improves the state until nothing can be gained but rounding. `stops`: as soon as they are apart.
  State descend(State from, Goal goal, bool stops) const;

 private:
  State state(const Vector &n, const Point &of_a, const typename Other::At &of_b) const
  {
    const double heights = of_a.height + of_b.height, away = dot(n, d);
    return {n, of_a, of_b, heights - away, away / heights};
  }
  static double merit(const State &x, Goal goal)
  {
    return goal == Goal::LEAST_OVERLAP ? x.overlap : -x.ratio;
  }
  struct Way {
    Vector along;    // on the surface of the leader
    bool other_leads;
  };
  Way newton(const State &x, Goal goal, bool curved_leads) const;
  State moved(const State &x, const Way &way, double part) const
  {
    const Vector along = part * way.along;
    if (!way.other_leads) return at(a.on_ray(x.of_a.place + along));
    Vector n;
    const auto of_b = b.moved(x.of_b, along, n);
    return state(n, a.at_normal(n), of_b);
  }

  const Superellipsoid &a;
  const Other &b;
  const Vector d;
  const double size;
};

/* With curvatures K = dn/dp the condition t . (p_a + p_b - d) = 0 for tangents t yields, with the gradient g and
   the overlap f (0 while the ratio is sought, for which d is scaled)
     dp_a + dp_b - f dn = -g,   dn = K_a dp_a,   turn dn = move dp_b. */

template <class Other>
typename Search<Other>::Way Search<Other>::newton(const State &x, Goal goal,
                                                  bool curved_leads) const
{
  const Vector &n = x.normal;
  Vector s = std::abs(n.x) < 0.6 ? Vector{0.0, -n.z, n.y} : Vector{-n.y, n.x, 0.0};
  s = (1.0 / length(s)) * s;
  const Vector t = cross(n, s);
  const bool to_overlap = goal == Goal::LEAST_OVERLAP;
  const double scale = to_overlap ? 1.0 : 1.0 / x.ratio, f = to_overlap ? x.overlap : 0.0;
  const Vector gap = x.of_a.place + x.of_b.place - scale * d;
  const Flat g{dot(s, gap), dot(t, gap)};
  const double st = x.of_a.curvature(s, t);
  const FlatMatrix of_a{x.of_a.curvature(s, s), st, st, x.of_a.curvature(t, t)};
  const FlatMatrix move = b.move(x.of_b, s, t), turn = b.turn();
  const FlatMatrix system = move + turn * of_a + (-f) * (move * of_a);
  const Flat right = move * Flat{-g.s, -g.t};
  const double determinant = system.ss * system.tt - system.st * system.ts;
  Flat w{-g.s, -g.t};    // downhill, where Newton's direction is not
  if (determinant != 0.0) {
    const Flat solved{(system.tt * right.s - system.st * right.t) / determinant,
                      (system.ss * right.t - system.ts * right.s) / determinant};
    const Flat dn = of_a * solved;
    if (dn.s * g.s + dn.t * g.t < 0.0) w = solved;
  }
  const Flat dn = of_a * w;
  Way way{w.s * s + w.t * t, false};
  if constexpr (Other::leads) {
    const FlatMatrix of_b = b.curvature(x.of_b, s, t);
    if ((of_b.trace() < of_a.trace()) != curved_leads) {
      const Flat u{-g.s - w.s + f * dn.s, -g.t - w.t + f * dn.t};
      const Flat turned = of_b * u;
      if (turned.s * g.s + turned.t * g.t < 0.0) way = {u.s * s + u.t * t, true};
    }
  }
  return way;
}

/* Far away a step is halved until it gains something. Near by, where gains vanish in rounding, steps are taken as
   they are, as long as they shrink; the digits double with each. Where they hardly do, each surface may be the flatter one in some direction: they
   lead in turn. */

template <class Other>
typename Search<Other>::State Search<Other>::descend(State x, Goal goal, bool stops) const
{
  constexpr int most_steps = 60, most_halvings = 30;
  constexpr double near_by = 1.0e-4, last = 1.0e-8, noise = 1.0e-10, enough = 1.0e-13;
  double near = near_by * size, before = 1.0e9 * size;
  bool curved_leads = false;
  for (int step = 0; step < most_steps; step++) {
    if (stops && x.overlap < 0.0) break;
    const Way way = newton(x, goal, curved_leads);
    const double far = length(way.along);
    if (far <= enough * size) break;
    const bool fast = far < 1.0e-3 * before;
    if (far > 0.5 * before) curved_leads = !curved_leads;
    before = far;
    if (far < 0.5 * near) {
      near = far;
      x = moved(x, way, 1.0);
      if (fast && far < last * size) break;
      continue;
    }
    if (far <= noise * size) break;
    double part = 1.0;
    State next = moved(x, way, part);
    for (int half = 0; half < most_halvings && !(merit(next, goal) < merit(x, goal)); half++) {
      part *= 0.5;
      next = moved(x, way, part);
    }
    if (!(merit(next, goal) < merit(x, goal))) break;
    x = next;
  }
  return x;
}

/* ---- two superellipsoids ---------------------------------------------------------------------- */

/* The normal at half way of F. Perram and M. S. Wertheim, J. Comput. Phys. 58, 409 (1985), of ellipsoids with these
   half axes. */

Vector first_normal(const Superellipsoid &a, const Superellipsoid &b, const Pose &seen)
{
  const auto squares = [](const Superellipsoid &shape) {
    const Vector &h = shape.half_axes();
    return Eigen::Vector3d(h.x * h.x, h.y * h.y, h.z * h.z);
  };
  Eigen::Matrix3d sum = seen.rotation * squares(b).asDiagonal() * seen.rotation.transpose();
  sum.diagonal() += squares(a);
  const Vector d = seen.position, p{sum(0, 0), sum(0, 1), sum(0, 2)},
               q{sum(1, 0), sum(1, 1), sum(1, 2)}, r{sum(2, 0), sum(2, 1), sum(2, 2)};
  // the inverse of a symmetric matrix, but for a factor > 0
  const Vector n = d.x * cross(q, r) + d.y * cross(r, p) + d.z * cross(p, q);
  const double size = length(n);
  return size > 0.0 ? (1.0 / size) * n : a.nearest_pole().normal;
}

CommonNormal result(const Search<OtherSuperellipsoid>::State &x, const OtherSuperellipsoid &b)
{
  CommonNormal found{x.normal, x.overlap, x.of_a, b.center() - x.of_b.place, 0.0};
  if (x.overlap > 0.0) found.curvature_of_b = b.shape.curvature_for_laws(x.of_b.own);
  return found;
}

}    // namespace

double overlap_along(const Superellipsoid &a, const Superellipsoid &b, const Pose &seen,
                     const Vector &normal)
{
  return a.at_normal(normal).height + b.at_normal(seen.direction_in_body(normal)).height -
         dot(normal, seen.position);
}

CommonNormal find_common_normal(const Superellipsoid &a, const Superellipsoid &b, const Pose &seen)
{
  // overlaps that are small enough for f to have one minimum near by
  constexpr double shallow = 0.1;
  using PairSearch = Search<OtherSuperellipsoid>;
  const OtherSuperellipsoid other(b, seen);
  const PairSearch search(a, other);
  const PairSearch::State first = search.at_normal(first_normal(a, b, seen));
  PairSearch::State x = search.descend(first, PairSearch::Goal::LEAST_OVERLAP, true);
  if (x.overlap < 0.0) return result(x, other);
  const Vector on_b = seen.position - x.of_b.place, middle = 0.5 * (x.of_a.place + on_b);
  const bool is_shallow =
      x.overlap < shallow * std::min(a.inscribed_radius(), b.inscribed_radius());
  if (is_shallow && a.gauge(middle) < 1.0 && other.contains(middle)) return result(x, other);
  if (!(first.ratio > 0.0)) return result(x, other);    // the same center
  PairSearch::State touching = search.descend(first, PairSearch::Goal::LARGEST_RATIO, true);
  touching = search.descend(touching, PairSearch::Goal::LEAST_OVERLAP, true);
  return result(
      touching.overlap < x.overlap || touching.overlap < 0.0 || !is_shallow ? touching : x, other);
}

/* ---- a ball ----------------------------------------------------------------------------------- */

CommonNormal find_common_normal(const Superellipsoid &a, const Vector &center, double radius)
{
  using BallSearch = Search<OtherBall>;
  const OtherBall ball(center, radius);
  const BallSearch search(a, ball);
  const bool at_center =
      !(dot(center, center) > 1.0e-24 * a.inscribed_radius() * a.inscribed_radius());
  const BallSearch::State x =
      search.descend(search.at(at_center ? a.nearest_pole() : a.on_ray(center)),
                     BallSearch::Goal::LEAST_OVERLAP, false);
  return {x.normal, x.overlap, x.of_a, center - x.of_b.place, 0.0};
}

}    // namespace Talus
