// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/ball_parts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

constexpr double pi = 3.14159265358979323846;

double root(double square)
{
  return std::sqrt(std::max(square, 0.0));
}

double arc_cosine(double cosine)
{
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

/* A part of the ball beyond planes is bounded by pieces of these and a piece of the sphere, with the solid angle S. By the
   theorem of Gauss 3 V = S - sum of distance times area of the pieces, and by that of Gauss and Bonnet

     S = 2 pi - sum of exterior angles - sum of p times the angle of the arc on the plane at p

   Two planes at right angles at p and q meet on the sphere with the exterior angle of cosine
   -p q/sqrt((1 - p^2)(1 - q^2)). */

double exterior_angle(double p, double q)
{
  return arc_cosine(-p * q / root((1.0 - p * p) * (1.0 - q * q)));
}

/// Of the ball where x >= p.
double beyond(double p)
{
  if (p >= 1.0) return 0.0;
  if (p <= -1.0) return 4.0 / 3.0 * pi;
  return pi / 3.0 * (1.0 - p) * (1.0 - p) * (2.0 + p);
}

/// And y >= q.
double beyond(double p, double q)
{
  if (p >= 1.0 || q >= 1.0) return 0.0;
  if (p <= -1.0) return beyond(q);
  if (q <= -1.0) return beyond(p);
  if (p < 0.0) return beyond(q) - beyond(-p, q);
  if (q < 0.0) return beyond(p) - beyond(p, -q);
  if (p * p + q * q >= 1.0) return 0.0;
  double sum = 2.0 * pi - 2.0 * exterior_angle(p, q);
  const double half = root(1.0 - p * p - q * q);
  const auto take_plane = [&](double at, double other) {    // its piece: a segment of a disc
    const double square = 1.0 - at * at, arc = 2.0 * arc_cosine(other / root(square));
    sum -= at * arc + at * (0.5 * square * arc - other * half);
  };
  take_plane(p, q);
  take_plane(q, p);
  return sum / 3.0;
}

/// And z >= r.
double beyond(double p, double q, double r)
{
  if (p >= 1.0 || q >= 1.0 || r >= 1.0) return 0.0;
  if (p <= -1.0) return beyond(q, r);
  if (q <= -1.0) return beyond(p, r);
  if (r <= -1.0) return beyond(p, q);
  if (p < 0.0) return beyond(q, r) - beyond(-p, q, r);
  if (q < 0.0) return beyond(p, r) - beyond(p, -q, r);
  if (r < 0.0) return beyond(p, q) - beyond(p, q, -r);
  if (p * p + q * q + r * r >= 1.0) return 0.0;
  double sum = 2.0 * pi - exterior_angle(p, q) - exterior_angle(q, r) - exterior_angle(r, p);
  const auto take_plane = [&](double at, double u,
                              double v) {    // the corner of a disc beyond u and v
    const double square = 1.0 - at * at, radius = root(square),
                 arc = std::max(arc_cosine(u / radius) - std::asin(std::min(v / radius, 1.0)), 0.0),
                 along_u = root(square - u * u) - v, along_v = root(square - v * v) - u;
    sum -= at * arc + at * 0.5 * (square * arc - u * along_u - v * along_v);
  };
  take_plane(p, q, r);
  take_plane(q, r, p);
  take_plane(r, p, q);
  return sum / 3.0;
}

}    // namespace

double ball_below(double a, double b, double c)
{
  return beyond(-a, -b, -c);
}

}    // namespace Talus
