// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/superellipsoid.h"

#include "base/cube_root.h"
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
  return most * Power(1.0 / e)(1.0 + Power(e)(least / most));
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

Superellipsoid::Superellipsoid(const Vector &half, double n1, double n2,
                               SurfaceRadius surface_radius) :
    formula(half, n1, n2),
    radius_kind(surface_radius)
{
  for (const double axis : {half.x, half.y, half.z})
    if (!(axis > 0.0 && std::isfinite(axis)))
      throw std::runtime_error("the half axes must be larger than 0");
  check_exponent(n1, "n1");
  check_exponent(n2, "n2");
  outer = farthest(farthest(half.x, half.y, n2), half.z, n1);
  inner = std::min(std::min(half.x, half.y), half.z);
  least_curvature = 0.1 / outer;
  find_mass();
  curvature_by_volume = 1.0 / cube_root(volume_ * (0.75 / 3.14159265358979323846));
  find_least_radius();
}

void Superellipsoid::find_mass()
{
  const double e1 = 2.0 / n1(), e2 = 2.0 / n2();
  const double a = half_axes().x, b = half_axes().y, c = half_axes().z, abc = a * b * c;
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
  return formula.gauge(x);
}

Superellipsoid::Point Superellipsoid::at_normal(const Vector &normal) const
{
  return formula.at_normal(normal);
}

Superellipsoid::Point Superellipsoid::on_ray(const Vector &x) const
{
  return formula.on_ray(x);
}

Superellipsoid::Point Superellipsoid::nearest_pole() const
{
  const Vector &half = half_axes();
  if (inner == half.x) return at_normal({1.0, 0.0, 0.0});
  if (inner == half.y) return at_normal({0.0, 1.0, 0.0});
  return at_normal({0.0, 0.0, 1.0});
}

/* ---- what laws and others ask ----------------------------------------------------------------- */

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
  const Vector &half = half_axes();
  double most = 0.0;
  visit_octant(along_edge, [&](const Vector &x) {
    most = std::max(most, curvature_for_laws(on_ray({half.x * x.x, half.y * x.y, half.z * x.z})));
  });
  least_radius = 1.0 / most;
}

std::vector<HeldFace> Superellipsoid::held_faces() const
{
  const Vector &half = half_axes();
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
  const Vector &half = half_axes();
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
