// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/superellipsoid.h"

#include "base/power.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace Talus {
namespace {

using Vector = Vector3<double>;

/// The largest distance from the origin of |x/a|^n + |y/b|^n = 1: by Lagrange x^(n-2) ~ a^n.
double farthest(double a, double b, double n)
{
  const double most = std::max(a, b), least = std::min(a, b);
  if (n - 2.0 < 1.0e-6) return most;
  const double e = 2.0 * n / (n - 2.0);
  return most * power(1.0 + power(least / most, std::min(e, 1.0e6)), 1.0 / e);
}

double beta(double x, double y)
{
  return std::exp(std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y));
}

std::string number(double x)
{
  std::string text = std::to_string(x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

void check_exponent(double n, const std::string &name)
{
  if (n >= Superellipsoid::least_exponent && n <= Superellipsoid::largest_exponent) return;
  throw std::runtime_error("the exponent " + name + " is " + number(n) + " and must be between " +
                           number(Superellipsoid::least_exponent) + " (round) and " +
                           number(Superellipsoid::largest_exponent) + " (nearly a box)");
}

}    // namespace

Superellipsoid::Superellipsoid(const Vector &half_axes, double n1, double n2,
                               SurfaceRadius surface_radius) :
    half(half_axes),
    exponent1(n1), exponent2(n2), powers1(n1), powers2(n2), ratio(n1 / n2),
    radius_kind(surface_radius)
{
  for (const double axis : {half.x, half.y, half.z})
    if (!(axis > 0.0 && std::isfinite(axis)))
      throw std::runtime_error("the half axes must be larger than 0");
  check_exponent(n1, "n1");
  check_exponent(n2, "n2");
  square = {half.x * half.x, half.y * half.y, half.z * half.z};
  inverse_square = {1.0 / square.x, 1.0 / square.y, 1.0 / square.z};
  outer = farthest(farthest(half.x, half.y, n2), half.z, n1);
  inner = std::min(std::min(half.x, half.y), half.z);
  least_curvature = 0.1 / outer;
  find_mass();
  find_least_radius();
}

void Superellipsoid::find_mass()
{
  const double e1 = 2.0 / exponent1, e2 = 2.0 / exponent2;
  const double a = half.x, b = half.y, c = half.z, abc = a * b * c;
  volume_ = 2.0 * abc * e1 * e2 * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2);
  // integrals of (x/a)^2 (or (y/b)^2) and (z/c)^2
  const double across =
      0.5 * abc * e1 * e2 * beta(1.5 * e2, 0.5 * e2) * beta(0.5 * e1, 2.0 * e1 + 1.0);
  const double along =
      2.0 * abc * e1 * e2 * beta(0.5 * e2, 0.5 * e2 + 1.0) * beta(1.5 * e1, e1 + 1.0);
  moments = {across * b * b + along * c * c, across * a * a + along * c * c,
             across * (a * a + b * b)};
}

/* ---- points of the surface -------------------------------------------------------------------- */

double Superellipsoid::gauge(const Vector &x) const
{
  const double u = std::abs(x.x) / half.x, v = std::abs(x.y) / half.y, w = std::abs(x.z) / half.z;
  const double most = std::max(std::max(u, v), w);
  if (!(most > 0.0)) return 0.0;
  if (is_ellipsoid()) return std::sqrt(u * u + v * v + w * w);
  // in units of the largest, so that no power underflows
  const double s = powers2.whole(u / most) + powers2.whole(v / most);
  return most * powers1.root(ratio(s) + powers1.whole(w / most));
}

/* The dual norm: with q = n/(n - 1), r = (|a m_x|^q2 + |b m_y|^q2)^(1/q2) and h = (r^q1 + |c m_z|^q1)^(1/q1) is the
   height along m, and its gradient the point there: rho = (r/h)^(q1-1), x = a rho (|a m_x|/r)^(q2-1). */

Superellipsoid::UnitPoint Superellipsoid::unit_point_at(const Vector &m, double &height) const
{
  const double u = half.x * std::abs(m.x), v = half.y * std::abs(m.y), w = half.z * std::abs(m.z);
  UnitPoint p{};
  const double pu = powers2.root_of_less(u), pv = powers2.root_of_less(v);
  const double flat = u * pu + v * pv, flat_root = powers2.root(flat);
  const double r = flat_root > 0.0 ? flat / flat_root : 0.0;
  const double alpha = flat_root > 0.0 ? pu / flat_root : 1.0,    // x/rho, y/rho
      beta = flat_root > 0.0 ? pv / flat_root : 0.0;
  // r^(q2-1) is the root already
  const double pr = exponent1 == exponent2 ? flat_root : powers1.root_of_less(r),
               pw = powers1.root_of_less(w);
  const double all = r * pr + w * pw, root = powers1.root(all);
  height = all / root;
  p.rho = pr / root;
  p.z = pw / root;
  p.x = p.rho * alpha;
  p.y = p.rho * beta;
  p.x_power = r > 0.0 ? u / r : 1.0;
  p.y_power = r > 0.0 ? v / r : 0.0;
  p.rho_power = r / height;
  p.z_power = w / height;
  return p;
}

/* With F/n1 in the place of F: its gradient, and its second derivatives over the length of the gradient.
   In units of the half axes and with s = x/rho, t = y/rho
     F_x = rho^(n1-1) s^(n2-1),   F_xy = (n1-n2) rho^(n1-2) (s t)^(n2-1),
     F_xx = rho^(n1-2) ((n2-1) s^(n2-2) + (n1-n2) s^(2 n2-2)),   F_zz = (n1-1) z^(n1-2). */

Superellipsoid::Point Superellipsoid::point(const UnitPoint &u, const Vector &from) const
{
  const double sx = std::copysign(1.0, from.x), sy = std::copysign(1.0, from.y),
               sz = std::copysign(1.0, from.z);
  const Vector gradient{u.rho_power * u.x_power / half.x, u.rho_power * u.y_power / half.y,
                        u.z_power / half.z};
  const double size = length(gradient), inverse = 1.0 / size;
  Point p;
  p.place = {sx * half.x * u.x, sy * half.y * u.y, sz * half.z * u.z};
  p.normal = {sx * inverse * gradient.x, sy * inverse * gradient.y, sz * inverse * gradient.z};
  p.height = inverse;    // place . gradient is F = 1
  // y^(n-2); of 0 the limit
  const auto divided = [](double of_power, double y, double n) {
    if (n == 2.0) return 1.0;
    return y > 0.0 ? of_power / y : 0.0;
  };
  const double rho = divided(u.rho_power, u.rho, exponent1), mixed = exponent1 - exponent2;
  const double s = u.rho > 0.0 ? u.x / u.rho : 1.0, t = u.rho > 0.0 ? u.y / u.rho : 0.0;
  const double ia = 1.0 / half.x, ib = 1.0 / half.y, ic = 1.0 / half.z;
  const auto second = [&](double of_power, double y) {
    return inverse * rho *
           ((exponent2 - 1.0) * divided(of_power, y, exponent2) + mixed * of_power * of_power);
  };
  p.xx = second(u.x_power, s) * ia * ia;
  p.yy = second(u.y_power, t) * ib * ib;
  p.zz = inverse * (exponent1 - 1.0) * divided(u.z_power, u.z, exponent1) * ic * ic;
  p.xy = inverse * rho * mixed * u.x_power * u.y_power * sx * sy * ia * ib;
  return p;
}

/* Ellipsoids: with q = x^2/a^2 ... = 1 the normal is along x/a^2, and its length 1/height. */

Superellipsoid::Point Superellipsoid::ellipsoid_point(const Vector &place, const Vector &normal,
                                                      double height) const
{
  return {place,
          normal,
          height,
          height * inverse_square.x,
          height * inverse_square.y,
          height * inverse_square.z,
          0.0};
}

Superellipsoid::Point Superellipsoid::at_normal(const Vector &normal) const
{
  if (is_ellipsoid()) {
    const Vector p{square.x * normal.x, square.y * normal.y, square.z * normal.z};
    const double high = std::sqrt(dot(p, normal));
    return ellipsoid_point((1.0 / high) * p, normal, high);
  }
  double height;
  const UnitPoint u = unit_point_at(normal, height);
  Point found = point(u, normal);
  found.normal = normal;
  found.height = height;
  return found;
}

Superellipsoid::Point Superellipsoid::on_ray(const Vector &x) const
{
  const double scale = 1.0 / gauge(x);
  if (is_ellipsoid()) {
    const Vector place = scale * x, gradient{inverse_square.x * place.x, inverse_square.y * place.y,
                                             inverse_square.z * place.z};
    const double high = 1.0 / length(gradient);
    return ellipsoid_point(place, high * gradient, high);
  }
  UnitPoint p{};
  p.x = scale * std::abs(x.x) / half.x;
  p.y = scale * std::abs(x.y) / half.y;
  p.z = scale * std::abs(x.z) / half.z;
  p.x_power = 1.0;    // at the pole
  const double larger = std::max(p.x, p.y);
  if (larger > 0.0) {    // in units of it, so that no power underflows
    const double s = p.x / larger, t = p.y / larger;
    const double ps = powers2.less(s), pt = powers2.less(t);
    const double sum = s * ps + t * pt, root = powers2.root(sum);
    p.rho = larger * root;
    p.x_power = ps * root / sum;    // over root^(n2-1) = sum/root
    p.y_power = pt * root / sum;
  }
  p.rho_power = powers1.less(p.rho);
  p.z_power = powers1.less(p.z);
  return point(p, x);
}

Superellipsoid::Point Superellipsoid::nearest_pole() const
{
  if (inner == half.x) return at_normal({1.0, 0.0, 0.0});
  if (inner == half.y) return at_normal({0.0, 1.0, 0.0});
  return at_normal({0.0, 0.0, 1.0});
}

/* ---- what laws and others ask ----------------------------------------------------------------- */

double Superellipsoid::curvature_for_laws(const Point &at) const
{
  if (radius_kind == SurfaceRadius::VOLUME)
    return 1.0 / cube_root(volume_ * (0.75 / 3.14159265358979323846));
  const Vector &n = at.normal;
  Vector t = std::abs(n.x) < 0.6 ? Vector{0.0, -n.z, n.y} : Vector{-n.y, n.x, 0.0};
  t = (1.0 / length(t)) * t;
  const Vector u = cross(n, t);
  const double tt = at.curvature(t, t), uu = at.curvature(u, u), tu = at.curvature(t, u);
  const double curvature = radius_kind == SurfaceRadius::MEAN
                               ? 0.5 * (tt + uu)
                               : std::sqrt(std::max(tt * uu - tu * tu, 0.0));
  return std::max(curvature, least_curvature);
}

namespace {

/// Directions of a grid on a cube, -count ... count along each edge, one octant: visit(x, y, z).
template <class Visit> void visit_octant(int count, Visit visit)
{
  for (int i = 0; i <= count; i++)
    for (int j = 0; j <= count; j++) {
      const double s = static_cast<double>(i) / count, t = static_cast<double>(j) / count;
      visit(Vector{1.0, s, t});
      visit(Vector{s, 1.0, t});
      visit(Vector{s, t, 1.0});
    }
}

}    // namespace

void Superellipsoid::find_least_radius()
{
  constexpr int along_edge = 40;
  double most = 0.0;
  visit_octant(along_edge, [&](const Vector &x) {
    most = std::max(most, curvature_for_laws(on_ray({half.x * x.x, half.y * x.y, half.z * x.z})));
  });
  least_radius = 1.0 / most;
}

std::vector<HeldFace> Superellipsoid::held_faces() const
{
  std::vector<HeldFace> faces;
  for (int x = -1; x <= 1; x++)
    for (int y = -1; y <= 1; y++)
      for (int z = -1; z <= 1; z++) {
        if (!x && !y && !z) continue;
        const Point p = on_ray({half.x * x, half.y * y, half.z * z});
        faces.push_back({p.normal, {{p.place, 1.0}}});
      }
  return faces;
}

/* A grid on each side of a cube, projected onto the surface from the center. */

std::vector<Triangle> Superellipsoid::surface(int pieces) const
{
  std::vector<Triangle> triangles;
  const int count = std::max(2, pieces);
  for (int axis = 0; axis < 3; axis++)
    for (const double side : {1.0, -1.0}) {
      const auto corner = [&](int i, int j) {
        const double angle = 0.5 * 1.57079632679489661923;    // tangents of equal angles
        const double s = std::tan(angle * (2.0 * i / count - 1.0)),
                     t = std::tan(angle * (2.0 * j / count - 1.0)) * side;
        const Vector x = axis == 0   ? Vector{side, s, t}
                         : axis == 1 ? Vector{t, side, s}
                                     : Vector{s, t, side};
        return on_ray({half.x * x.x, half.y * x.y, half.z * x.z}).place;
      };
      for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
          const Vector a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                       d = corner(i, j + 1);
          triangles.push_back({{a, b, c}});
          triangles.push_back({{a, c, d}});
        }
    }
  return triangles;
}

}    // namespace Talus
