// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The search of least_overlap.h, for one pair (Real = double) or eight (Real = Vec8): the same bits for each. All
// pairs of a search are of the same two shapes, and take the same steps whatever the others do.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_COMMON_NORMAL_SEARCH_H
#define TALUS_SHAPE_SUPERELLIPSOID_COMMON_NORMAL_SEARCH_H

#include "shape/superellipsoid/superellipsoid_surface.h"

namespace Talus {

TALUS_INLINE bool negated(bool condition)
{
  return !condition;
}
template <class Mask> TALUS_INLINE Mask negated(Mask mask)
{
  return ~mask;
}

/// Where b is in the frame of a: x = rotation * x_b + position.
template <class Real> struct SeenPose {
  Vector3<Real> position;
  Real rotation[3][3];

  TALUS_INLINE Vector3<Real> direction_seen(const Vector3<Real> &d) const
  {
    const auto row = [&](int k) {
      return rotation[k][0] * d.x + rotation[k][1] * d.y + rotation[k][2] * d.z;
    };
    return {row(0), row(1), row(2)};
  }
  TALUS_INLINE Vector3<Real> direction_in_b(const Vector3<Real> &d) const
  {
    const auto column = [&](int k) {
      return rotation[0][k] * d.x + rotation[1][k] * d.y + rotation[2][k] * d.z;
    };
    return {column(0), column(1), column(2)};
  }
};

/// Components along two tangents.
template <class Real> struct Flat {
  Real s, t;
};
template <class Real> struct FlatMatrix {    // rows
  Real ss, st, ts, tt;
  TALUS_INLINE Flat<Real> operator*(Flat<Real> v) const
  {
    return {ss * v.s + st * v.t, ts * v.s + tt * v.t};
  }
  TALUS_INLINE FlatMatrix operator*(const FlatMatrix &m) const
  {
    return {ss * m.ss + st * m.ts, ss * m.st + st * m.tt, ts * m.ss + tt * m.ts,
            ts * m.st + tt * m.tt};
  }
};

/* What the search knows of the other body: the point with a normal along n, mirrored about its center (so of
   -n, since both kinds are symmetric), and how it moves when n turns by dn: turn * dn = move * dplace. */

template <class Number> class OtherSuperellipsoid {
 public:
  using Real = Number;
  using Vector = Vector3<Real>;

  OtherSuperellipsoid(const SuperellipsoidSurface &superellipsoid, const SeenPose<Real> &b_seen) :
      shape(superellipsoid), seen(b_seen)
  {
  }
  static constexpr bool leads = true;

  struct At {
    Vector place;
    Real height;
    PointWithNormal<Real> own;
  };
  template <class Mask> TALUS_INLINE static At selected(Mask mask, const At &yes, const At &no)
  {
    return {select(mask, yes.place, no.place), select(mask, yes.height, no.height),
            select(mask, yes.own, no.own)};
  }
  TALUS_INLINE At at_normal(const Vector &n) const
  {
    return at(shape.at_normal(seen.direction_in_b(n)));
  }
  TALUS_INLINE At at(const PointWithNormal<Real> &own) const
  {
    return {seen.direction_seen(own.place), own.height, own};
  }
  TALUS_INLINE FlatMatrix<Real> curvature(const At &at, const Vector &s, const Vector &t) const
  {
    const Vector ls = seen.direction_in_b(s), lt = seen.direction_in_b(t);
    const Real st = at.own.curvature(ls, lt);
    return {at.own.curvature(ls, ls), st, st, at.own.curvature(lt, lt)};
  }
  TALUS_INLINE static FlatMatrix<Real> turn()
  {
    return {splat<Real>(1.0), splat<Real>(0.0), splat<Real>(0.0), splat<Real>(1.0)};
  }
  TALUS_INLINE FlatMatrix<Real> move(const At &at, const Vector &s, const Vector &t) const
  {
    return curvature(at, s, t);
  }
  const Vector &center() const { return seen.position; }

  const SuperellipsoidSurface &shape;
  const SeenPose<Real> &seen;
};

class OtherBall {
 public:
  using Real = double;
  using Vector = Vector3<double>;

  OtherBall(const Vector &ball_center, double ball_radius) :
      middle(ball_center), radius(ball_radius)
  {
  }
  static constexpr bool leads = false;

  struct At {
    Vector place;
    double height;
  };
  static At selected(bool mask, const At &yes, const At &no) { return mask ? yes : no; }
  At at_normal(const Vector &n) const { return {radius * n, radius}; }
  FlatMatrix<double> turn() const { return {radius, 0.0, 0.0, radius}; }
  FlatMatrix<double> move(const At & /*at*/, const Vector & /*s*/, const Vector & /*t*/) const
  {
    return {1.0, 0.0, 0.0, 1.0};
  }
  const Vector &center() const { return middle; }

 private:
  Vector middle;
  double radius;
};

template <class Other> class CommonNormalSearch {
  using Real = typename Other::Real;
  using Vector = Vector3<Real>;
  using Mask = bool_of<Real>;

 public:
  /// `size`: of both, to which steps relate.
  CommonNormalSearch(const SuperellipsoidSurface &superellipsoid, const Other &other_body,
                     double size_of_bodies) :
      a(superellipsoid),
      b(other_body), d(other_body.center()), size(size_of_bodies)
  {
  }

  struct State {
    Vector normal;
    PointWithNormal<Real> of_a;
    typename Other::At of_b;
    Real overlap, ratio;    ///< of n . d and the sum of the heights
  };
  TALUS_INLINE State at_normal(const Vector &n) const
  {
    return state(n, a.at_normal(n), b.at_normal(n));
  }
  TALUS_INLINE State at(const PointWithNormal<Real> &of_a) const
  {
    return state(of_a.normal, of_a, b.at_normal(of_a.normal));
  }

  enum class Goal { LEAST_OVERLAP, LARGEST_RATIO };
  /// Improves the state of those pairs until nothing can be gained but rounding. `stops`: as soon as they are
  /// apart.
  State descend(State from, Goal goal, bool stops, Mask going) const;

 private:
  TALUS_INLINE State state(const Vector &n, const PointWithNormal<Real> &of_a,
                           const typename Other::At &of_b) const
  {
    const Real heights = of_a.height + of_b.height, away = dot(n, d);
    return {n, of_a, of_b, heights - away, away / heights};
  }
  TALUS_INLINE static State selected(Mask mask, const State &yes, const State &no)
  {
    return {select(mask, yes.normal, no.normal), select(mask, yes.of_a, no.of_a),
            Other::selected(mask, yes.of_b, no.of_b), select(mask, yes.overlap, no.overlap),
            select(mask, yes.ratio, no.ratio)};
  }
  TALUS_INLINE static Real merit(const State &x, Goal goal)
  {
    return goal == Goal::LEAST_OVERLAP ? x.overlap : -x.ratio;
  }
  struct Way {
    Vector along;    // on the surface of the leader, that of the point that has to go farther
    Mask other_leads;
    Real far;    // the way of that point
  };
  TALUS_INLINE Way newton(const State &x, Goal goal, Mask turns) const;
  TALUS_INLINE State moved(const State &x, const Way &way, Real part) const;

  const SuperellipsoidSurface &a;
  const Other &b;
  const Vector d;
  const double size;
};

/* With curvatures K = dn/dp the condition t . (p_a + p_b - d) = 0 for tangents t yields, with the gradient g and
   the overlap f (0 while the ratio is sought, for which d is scaled)
     dp_a + dp_b - f dn = -g,   dn = K_a dp_a,   turn dn = move dp_b. */

template <class Other>
TALUS_INLINE typename CommonNormalSearch<Other>::Way
CommonNormalSearch<Other>::newton(const State &x, Goal goal, Mask turns) const
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const Vector &n = x.normal;
  Vector s =
      select(magnitude(n.x) < splat<Real>(0.6), Vector{zero, -n.z, n.y}, Vector{-n.y, n.x, zero});
  s = (1.0 / size_of(s)) * s;
  const Vector t = cross(n, s);
  const bool to_overlap = goal == Goal::LEAST_OVERLAP;
  const Real scale = to_overlap ? one : 1.0 / x.ratio, f = to_overlap ? x.overlap : zero;
  const Vector gap = x.of_a.place + x.of_b.place - scale * d;
  const Flat<Real> g{dot(s, gap), dot(t, gap)};
  const Real st = x.of_a.curvature(s, t);
  const FlatMatrix<Real> of_a{x.of_a.curvature(s, s), st, st, x.of_a.curvature(t, t)};
  const FlatMatrix<Real> move = b.move(x.of_b, s, t), turned = b.turn() * of_a,
                         moved_a = move * of_a;
  const FlatMatrix<Real> system{
      move.ss + turned.ss - f * moved_a.ss, move.st + turned.st - f * moved_a.st,
      move.ts + turned.ts - f * moved_a.ts, move.tt + turned.tt - f * moved_a.tt};
  const Flat<Real> right = move * Flat<Real>{-g.s, -g.t};
  const Real determinant = system.ss * system.tt - system.st * system.ts;
  const Flat<Real> solved{(system.tt * right.s - system.st * right.t) / determinant,
                          (system.ss * right.t - system.ts * right.s) / determinant};
  const Flat<Real> turn = of_a * solved;
  // downhill, where Newton's direction is not
  const auto is_downhill = turn.s * g.s + turn.t * g.t < zero;
  const Flat<Real> w{select(is_downhill, solved.s, -g.s), select(is_downhill, solved.t, -g.t)};
  const Real square = w.s * w.s + w.t * w.t;
  Way way{w.s * s + w.t * t, zero < zero, square_root(square)};
  if constexpr (Other::leads) {
    const FlatMatrix<Real> of_b = b.curvature(x.of_b, s, t);
    const Flat<Real> dn = of_a * w, u{-g.s - w.s + f * dn.s, -g.t - w.t + f * dn.t},
                     by_b = of_b * u;
    const Real square_of_u = u.s * u.s + u.t * u.t;
    const Mask farther = square_of_u > square;
    way.other_leads = ((farther & negated(turns)) | (negated(farther) & turns)) &
                      (by_b.s * g.s + by_b.t * g.t < zero);
    way.along = select(way.other_leads, u.s * s + u.t * t, way.along);
    way.far = square_root(larger(square, square_of_u));
  }
  return way;
}

template <class Other>
TALUS_INLINE typename CommonNormalSearch<Other>::State
CommonNormalSearch<Other>::moved(const State &x, const Way &way, Real part) const
{
  const Vector along = part * way.along;
  if constexpr (!Other::leads)
    return at(a.on_ray(x.of_a.place + along));
  else {
    const Mask other = way.other_leads;
    if (&a == &b.shape) {    // the same formulas for both
      const PointWithNormal<Real> leader = a.on_ray(
          select(other, x.of_b.own.place + b.seen.direction_in_b(along), x.of_a.place + along));
      const Vector n = select(other, b.seen.direction_seen(leader.normal), leader.normal);
      const PointWithNormal<Real> follower =
          a.at_normal(select(other, n, b.seen.direction_in_b(n)));
      return state(n, select(other, follower, leader), b.at(select(other, leader, follower)));
    }
    State by_a = x, by_b = x;
    if (any(negated(other))) by_a = at(a.on_ray(x.of_a.place + along));
    if (any(other)) {
      const PointWithNormal<Real> leader =
          b.shape.on_ray(x.of_b.own.place + b.seen.direction_in_b(along));
      const Vector n = b.seen.direction_seen(leader.normal);
      by_b = state(n, a.at_normal(n), b.at(leader));
    }
    return selected(other, by_b, by_a);
  }
}

/* Far away a step is halved until it gains something. Near by, where gains vanish in rounding, steps are taken as
   they are, as long as they shrink; the digits double with each. Where they hardly do, the other surface takes its
   turn to lead. */

template <class Other>
typename CommonNormalSearch<Other>::State
CommonNormalSearch<Other>::descend(State x, Goal goal, bool stops, Mask going) const
{
  constexpr int most_steps = 100;
  constexpr double near_by = 1.0e-4, last = 1.0e-8, noise = 1.0e-10, enough = 1.0e-13,
                   least_part = 1.0e-9;
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  Real near = splat<Real>(near_by * size), before = splat<Real>(1.0e9 * size), part = one;
  const Mask none = zero < zero;
  Mask turns = none, is_new = negated(none);    // not a step that has been halved
  Way way = newton(x, goal, turns);
  for (int step = 0; step < most_steps; step++) {
    const Real far = way.far;
    const Mask is_near = is_new & (far < 0.5 * near);
    Mask stop = (far <= splat<Real>(enough * size)) |
                (negated(is_near) & (far <= splat<Real>(noise * size)));
    if (stops) stop = stop | (x.overlap < zero);
    going = going & negated(is_new & stop);
    if (!any(going)) break;
    const Mask is_last = is_near & (far < 1.0e-3 * before) & (far < splat<Real>(last * size)),
               slow = is_new & (far > 0.5 * before);
    turns = (turns & negated(slow)) | (slow & negated(turns));
    before = select(is_new, far, before);
    near = select(is_near, far, near);
    const State next = moved(x, way, part);
    const Mask accepted = is_near | (merit(next, goal) < merit(x, goal));
    x = selected(going & accepted, next, x);
    part = select(accepted, one, 0.5 * part);
    going = going & negated(is_last) & (part > splat<Real>(least_part));
    if (!any(going)) break;
    is_new = accepted;
    const Way again = newton(x, goal, turns);
    way.along = select(accepted, again.along, way.along);
    way.far = select(accepted, again.far, way.far);
    way.other_leads = (accepted & again.other_leads) | (negated(accepted) & way.other_leads);
  }
  return x;
}

/// What touches has a point between the surfaces that is inside both, and is not deep.
template <class Other, class State>
TALUS_INLINE auto is_proven(const SuperellipsoidSurface &a, const Other &b, const State &x,
                            double deep)
{
  using Real = typename Other::Real;
  const Real one = splat<Real>(1.0), half = splat<Real>(0.5);
  const auto middle = half * (x.of_a.place + (b.center() - x.of_b.place));
  const auto in_b = b.seen.direction_in_b(middle - b.center());
  return (x.overlap < splat<Real>(deep)) & (a.gauge(middle) < one) & (b.shape.gauge(in_b) < one);
}

/* The normal at half way of F. Perram and M. S. Wertheim, J. Comput. Phys. 58, 409 (1985), of ellipsoids with these
   half axes. */

template <class Real>
TALUS_INLINE Vector3<Real> first_normal(const SuperellipsoidSurface &a,
                                        const SuperellipsoidSurface &b, const SeenPose<Real> &seen,
                                        const Vector3<double> &other)
{
  const Vector3<double> &h = a.half_axes(), &k = b.half_axes();
  const double square_of_a[3] = {h.x * h.x, h.y * h.y, h.z * h.z},
               square_of_b[3] = {k.x * k.x, k.y * k.y, k.z * k.z};
  const auto &r = seen.rotation;
  const auto sum = [&](int i, int j) {
    const Real of_b = square_of_b[0] * r[i][0] * r[j][0] + square_of_b[1] * r[i][1] * r[j][1] +
                      square_of_b[2] * r[i][2] * r[j][2];
    return i == j ? of_b + square_of_a[i] : of_b;
  };
  const Real xy = sum(0, 1), xz = sum(0, 2), yz = sum(1, 2);
  const Vector3<Real> p{sum(0, 0), xy, xz}, q{xy, sum(1, 1), yz}, t{xz, yz, sum(2, 2)};
  // the inverse of a symmetric matrix, but for a factor > 0
  const Vector3<Real> &d = seen.position;
  const Vector3<Real> n = d.x * cross(q, t) + d.y * cross(t, p) + d.z * cross(p, q);
  const Real zero = splat<Real>(0.0), size = size_of(n);
  const auto is_known = size > zero;
  return select(is_known, (1.0 / select(is_known, size, splat<Real>(1.0))) * n,
                in_all_lanes<Real>(other));
}

}    // namespace Talus

#endif
