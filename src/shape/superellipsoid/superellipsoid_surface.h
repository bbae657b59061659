// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The surface of a superellipsoid, see superellipsoid.h, for one point (Real = double) or eight (Real = Vec8): the
// same bits for each.
//
// The height of the surface along a direction is known in closed form (its support function: the dual norm,
// with exponents n/(n - 1)), and so is the point at that height, whose normal is along the direction.

#ifndef TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_SURFACE_H
#define TALUS_SHAPE_SUPERELLIPSOID_SUPERELLIPSOID_SURFACE_H

#include "base/power.h"
#include "base/vector3.h"

namespace Talus {

/// A point of the surface, the normal there (outward, a unit vector), and how fast it turns.
template <class Real> struct PointWithNormal {
  Vector3<Real> place, normal;
  Real height;    ///< normal . place: of the tangent plane above the center
  /// For tangents t, u: t . dn = t . B u if the point moves along u; B has but these components.
  Real xx, yy, zz, xy;
  Real curvature(const Vector3<Real> &t, const Vector3<Real> &u) const
  {
    return xx * t.x * u.x + yy * t.y * u.y + zz * t.z * u.z + xy * (t.x * u.y + t.y * u.x);
  }
};

template <class Mask, class Real>
TALUS_INLINE PointWithNormal<Real> select(Mask mask, const PointWithNormal<Real> &yes,
                                          const PointWithNormal<Real> &no)
{
  return {select(mask, yes.place, no.place),   select(mask, yes.normal, no.normal),
          select(mask, yes.height, no.height), select(mask, yes.xx, no.xx),
          select(mask, yes.yy, no.yy),         select(mask, yes.zz, no.zz),
          select(mask, yes.xy, no.xy)};
}

template <class Real> TALUS_INLINE Real size_of(const Vector3<Real> &v)
{
  return square_root(dot(v, v));
}

class SuperellipsoidSurface {
 public:
  /// Half axes > 0, exponents >= 2.
  SuperellipsoidSurface(const Vector3<double> &half_axes, double n1, double n2) :
      half(half_axes), exponent1(n1), exponent2(n2), powers1(n1), powers2(n2),
      ratio(n1 / n2), square{half.x * half.x, half.y * half.y, half.z * half.z},
      inverse_square{1.0 / square.x, 1.0 / square.y, 1.0 / square.z}
  {
  }

  const Vector3<double> &half_axes() const { return half; }
  double n1() const { return exponent1; }
  double n2() const { return exponent2; }
  bool is_ellipsoid() const { return exponent1 == 2.0 && exponent2 == 2.0; }

  /// See Superellipsoid.
  template <class Real> TALUS_INLINE Real gauge(const Vector3<Real> &x) const;
  template <class Real>
  TALUS_INLINE PointWithNormal<Real> at_normal(const Vector3<Real> &normal) const;
  template <class Real> TALUS_INLINE PointWithNormal<Real> on_ray(const Vector3<Real> &x) const;

 private:
  /// A point of the surface in the octant x, y, z >= 0, in units of the half axes; and what its derivatives
  /// consist of: with rho = (x^n2 + y^n2)^(1/n2) the powers (x/rho)^(n2-1), (y/rho)^(n2-1), rho^(n1-1), z^(n1-1).
  template <class Real> struct UnitPoint {
    Real x, y, z, rho;
    Real x_power, y_power, rho_power, z_power;
  };
  template <class Real>
  TALUS_INLINE UnitPoint<Real> unit_point_at(const Vector3<Real> &normal, Real &height) const;
  template <class Real>
  TALUS_INLINE PointWithNormal<Real> point(const UnitPoint<Real> &u,
                                           const Vector3<Real> &signs_from) const;
  /// With q = x^2/a^2 + ... = 1 the normal is along x/a^2, and the length of that 1/height.
  template <class Real>
  TALUS_INLINE PointWithNormal<Real> ellipsoid_point(const Vector3<Real> &place,
                                                     const Vector3<Real> &normal, Real height) const
  {
    return {place,
            normal,
            height,
            height * inverse_square.x,
            height * inverse_square.y,
            height * inverse_square.z,
            splat<Real>(0.0)};
  }

  Vector3<double> half;
  double exponent1, exponent2;
  struct Powers {    // of n: n, n - 1, and their inverse values
    Power whole, less, root, root_of_less;
    explicit Powers(double n) :
        whole(n), less(n - 1.0), root(1.0 / n), root_of_less(1.0 / (n - 1.0))
    {
    }
  };
  Powers powers1, powers2;
  Power ratio;    // n1/n2
  Vector3<double> square, inverse_square;
};

/* ---------------------------------------------------------------------- */

template <class Real> TALUS_INLINE Real SuperellipsoidSurface::gauge(const Vector3<Real> &x) const
{
  const Real u = magnitude(x.x) / half.x, v = magnitude(x.y) / half.y, w = magnitude(x.z) / half.z;
  if (is_ellipsoid()) return square_root(u * u + v * v + w * w);
  // in units of the largest, so that no power underflows
  const Real zero = splat<Real>(0.0), most = larger(larger(u, v), w);
  const Real unit = select(most > zero, most, splat<Real>(1.0));
  const Real s = powers2.whole(u / unit) + powers2.whole(v / unit);
  return most * powers1.root(ratio(s) + powers1.whole(w / unit));
}

/* The dual norm: with q = n/(n - 1), r = (|a m_x|^q2 + |b m_y|^q2)^(1/q2) and h = (r^q1 + |c m_z|^q1)^(1/q1) is the
   height along m, and its gradient the point there: rho = (r/h)^(q1-1), x = a rho (|a m_x|/r)^(q2-1). */

template <class Real>
TALUS_INLINE SuperellipsoidSurface::UnitPoint<Real>
SuperellipsoidSurface::unit_point_at(const Vector3<Real> &m, Real &height) const
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const Real u = half.x * magnitude(m.x), v = half.y * magnitude(m.y), w = half.z * magnitude(m.z);
  const Real pu = powers2.root_of_less(u), pv = powers2.root_of_less(v);
  const Real flat = u * pu + v * pv, flat_root = powers2.root(flat);
  const auto off_axis = flat_root > zero;
  const Real r = select(off_axis, flat / flat_root, zero);
  const Real alpha = select(off_axis, pu / flat_root, one),    // x/rho, y/rho
      beta = select(off_axis, pv / flat_root, zero);
  // r^(q2-1) is the root already
  const Real pr = exponent1 == exponent2 ? flat_root : powers1.root_of_less(r),
             pw = powers1.root_of_less(w);
  const Real all = r * pr + w * pw, root = powers1.root(all);
  height = all / root;
  const Real rho = pr / root;
  const auto has_radius = r > zero;
  return {rho * alpha,
          rho * beta,
          pw / root,
          rho,
          select(has_radius, u / r, one),
          select(has_radius, v / r, zero),
          r / height,
          w / height};
}

/* With F/n1 in the place of F: its gradient, and its second derivatives over the length of the gradient.
   In units of the half axes and with s = x/rho, t = y/rho
     F_x = rho^(n1-1) s^(n2-1),   F_xy = (n1-n2) rho^(n1-2) (s t)^(n2-1),
     F_xx = rho^(n1-2) ((n2-1) s^(n2-2) + (n1-n2) s^(2 n2-2)),   F_zz = (n1-1) z^(n1-2). */

template <class Real>
TALUS_INLINE PointWithNormal<Real> SuperellipsoidSurface::point(const UnitPoint<Real> &u,
                                                                const Vector3<Real> &from) const
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto with_sign = [&](Real value, Real of) { return select(of < zero, -value, value); };
  const double ia = 1.0 / half.x, ib = 1.0 / half.y, ic = 1.0 / half.z;
  const Vector3<Real> gradient{u.rho_power * u.x_power * ia, u.rho_power * u.y_power * ib,
                               u.z_power * ic};
  const Real inverse = 1.0 / size_of(gradient);
  PointWithNormal<Real> p;
  p.place = {with_sign(half.x * u.x, from.x), with_sign(half.y * u.y, from.y),
             with_sign(half.z * u.z, from.z)};
  p.normal = {with_sign(inverse * gradient.x, from.x), with_sign(inverse * gradient.y, from.y),
              with_sign(inverse * gradient.z, from.z)};
  p.height = inverse;    // place . gradient is F = 1
  // y^(n-2); of 0 the limit
  const auto divided = [&](Real of_power, Real y, double n) {
    return n == 2.0 ? one : select(y > zero, of_power / y, zero);
  };
  const double mixed = exponent1 - exponent2;
  const Real rho = inverse * divided(u.rho_power, u.rho, exponent1);
  const auto off_axis = u.rho > zero;
  const Real s = select(off_axis, u.x / u.rho, one), t = select(off_axis, u.y / u.rho, zero);
  const auto second = [&](Real of_power, Real y) {
    return rho *
           ((exponent2 - 1.0) * divided(of_power, y, exponent2) + mixed * (of_power * of_power));
  };
  p.xx = second(u.x_power, s) * (ia * ia);
  p.yy = second(u.y_power, t) * (ib * ib);
  p.zz = inverse * (exponent1 - 1.0) * divided(u.z_power, u.z, exponent1) * (ic * ic);
  p.xy = with_sign(with_sign(rho * (mixed * ia * ib) * u.x_power * u.y_power, from.x), from.y);
  return p;
}

template <class Real>
TALUS_INLINE PointWithNormal<Real>
SuperellipsoidSurface::at_normal(const Vector3<Real> &normal) const
{
  if (is_ellipsoid()) {
    const Vector3<Real> p{square.x * normal.x, square.y * normal.y, square.z * normal.z};
    const Real high = square_root(dot(p, normal));
    return ellipsoid_point((1.0 / high) * p, normal, high);
  }
  Real height;
  const UnitPoint<Real> u = unit_point_at(normal, height);
  PointWithNormal<Real> found = point(u, normal);
  found.normal = normal;
  found.height = height;
  return found;
}

template <class Real>
TALUS_INLINE PointWithNormal<Real> SuperellipsoidSurface::on_ray(const Vector3<Real> &x) const
{
  const Real scale = 1.0 / gauge(x);
  if (is_ellipsoid()) {
    const Vector3<Real> place = scale * x,
                        gradient{inverse_square.x * place.x, inverse_square.y * place.y,
                                 inverse_square.z * place.z};
    const Real high = 1.0 / size_of(gradient);
    return ellipsoid_point(place, high * gradient, high);
  }
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  UnitPoint<Real> p;
  p.x = scale * magnitude(x.x) / half.x;
  p.y = scale * magnitude(x.y) / half.y;
  p.z = scale * magnitude(x.z) / half.z;
  // in units of the larger one, so that no power underflows
  const Real most = larger(p.x, p.y);
  const auto off_axis = most > zero;
  const Real unit = select(off_axis, most, one), s = p.x / unit, t = p.y / unit;
  const Real ps = powers2.less(s), pt = powers2.less(t);
  const Real sum = s * ps + t * pt, root = powers2.root(sum);
  p.rho = select(off_axis, most * root, zero);
  p.x_power = select(off_axis, ps * root / sum, one);    // over root^(n2-1) = sum/root
  p.y_power = select(off_axis, pt * root / sum, zero);
  p.rho_power = powers1.less(p.rho);
  p.z_power = powers1.less(p.z);
  return point(p, x);
}

}    // namespace Talus

#endif
