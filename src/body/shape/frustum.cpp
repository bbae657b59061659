// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/frustum.h"

#include "base/linear_algebra.h"
#include "body/shape/surface_visitor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus {
namespace {

enum Face { LATERAL, LOW_CAP, HIGH_CAP };

Vector3<double> any_normal_to(const Vector3<double> &axis)
{
  const Vector3<double> other =
      std::fabs(axis.x) < 0.6 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> n = cross(axis, other);
  return 1.0 / std::sqrt(dot(n, n)) * n;
}

/// From the nearest point of the segment a ... b to p, in two dimensions.
void from_segment(const double (&a)[2], const double (&b)[2], const double (&p)[2],
                  double (&away)[2])
{
  const double u = b[0] - a[0], v = b[1] - a[1], square = u * u + v * v;
  const double t =
      square > 0.0 ? std::clamp(((p[0] - a[0]) * u + (p[1] - a[1]) * v) / square, 0.0, 1.0) : 0.0;
  away[0] = p[0] - (a[0] + t * u);
  away[1] = p[1] - (a[1] + t * v);
}

}    // namespace

Frustum::Frustum(const Vector3<double> &center, const Vector3<double> &direction, double low_,
                 double high_, double length, bool in, bool no_caps) :
    middle(center),
    axis(direction), side(any_normal_to(direction)), low(low_), high(high_), half(0.5 * length),
    inside(in), infinite(std::isinf(length)), open(no_caps)
{
  const double slope = infinite ? 0.0 : (high - low) / length;
  normal_rho = 1.0 / std::sqrt(1.0 + slope * slope);
  normal_s = -slope * normal_rho;
}

Frustum::Meridian Frustum::meridian(const Vector3<double> &center) const
{
  const Vector3<double> d = center - middle;
  const double s = dot(d, axis);
  const Vector3<double> flat = d - s * axis;
  const double rho = std::sqrt(dot(flat, flat));
  return {rho, s, rho > 0.0 ? 1.0 / rho * flat : side};
}

void Frustum::depths(const Meridian &m, double (&depth)[3]) const
{
  constexpr double never = std::numeric_limits<double>::infinity();
  depth[LATERAL] = -((m.rho - 0.5 * (low + high)) * normal_rho + m.s * normal_s);
  depth[LOW_CAP] = infinite || low == 0.0 ? never : m.s + half;
  depth[HIGH_CAP] = infinite || high == 0.0 ? never : half - m.s;
}

Vector3<double> Frustum::inward(const Meridian &m, int face) const
{
  if (face == LOW_CAP) return axis;
  if (face == HIGH_CAP) return -axis;
  return -(normal_rho * m.away + normal_s * axis);
}

bool Frustum::touches(const Vector3<double> &center, double radius, SurfaceContact &contact) const
{
  if (open) return touches_open(center, radius, contact);
  if (!inside) return touches_from_outside(center, radius, contact);
  SurfaceContact found[3];
  const int count = touched_from_inside(center, radius, found);
  if (count) contact = found[0];
  return count > 0;
}

int Frustum::find_contacts(const Vector3<double> &center, double radius, NearParts /*parts*/,
                           SurfaceContact *found) const
{
  if (inside && !open) return touched_from_inside(center, radius, found);
  return touches(center, radius, *found) ? 1 : 0;
}

int Frustum::touched_from_inside(const Vector3<double> &center, double radius,
                                 SurfaceContact *found) const
{
  const Meridian m = meridian(center);
  double depth[3];
  depths(m, depth);
  int count = 0;
  for (int face = 0; face < 3; face++) {
    if (depth[face] <= -radius) return 0;
    if (depth[face] < radius) found[count++] = {inward(m, face), radius - depth[face], face};
  }
  sort_contacts(found, count);
  return count;
}

bool Frustum::touches_from_outside(const Vector3<double> &center, double radius,
                                   SurfaceContact &contact) const
{
  const Meridian m = meridian(center);
  double depth[3];
  depths(m, depth);
  const int nearest = static_cast<int>(std::min_element(depth, depth + 3) - depth);
  contact.part = 0;
  if (depth[nearest] >= 0.0 || infinite) {    // inside
    if (std::fabs(depth[nearest]) >= radius) return false;
    contact.normal = -inward(m, nearest);
    contact.overlap = radius + depth[nearest];
    return true;
  }
  double rho, s;
  from_outline(m, rho, s);
  const double distance = std::sqrt(rho * rho + s * s);
  if (distance >= radius) return false;
  // so near the rim that rounding hides the direction
  contact.normal =
      distance > 0.0 ? (rho / distance) * m.away + (s / distance) * axis : -inward(m, nearest);
  contact.overlap = radius - distance;
  return true;
}

void Frustum::from_lateral(const Meridian &m, double &rho, double &s) const
{
  if (infinite) {
    rho = m.rho - low;
    s = 0.0;
    return;
  }
  const double a[2] = {low, -half}, b[2] = {high, half}, p[2] = {m.rho, m.s};
  double away[2];
  from_segment(a, b, p, away);
  rho = away[0];
  s = away[1];
}

bool Frustum::touches_open(const Vector3<double> &center, double radius,
                           SurfaceContact &contact) const
{
  const Meridian m = meridian(center);
  double rho, s;
  from_lateral(m, rho, s);
  const double distance = std::sqrt(rho * rho + s * s);
  if (distance >= radius) return false;
  contact.part = 0;
  contact.normal =
      distance > 0.0 ? (rho / distance) * m.away + (s / distance) * axis : inward(m, LATERAL);
  contact.overlap = radius - distance;
  return true;
}

void Frustum::from_outline(const Meridian &m, double &rho, double &s) const
{
  const double corner[4][2] = {{0.0, -half}, {low, -half}, {high, half}, {0.0, half}};
  const double p[2] = {m.rho, m.s};
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; k++) {
    double away[2];
    from_segment(corner[k], corner[k + 1], p, away);
    const double square = away[0] * away[0] + away[1] * away[1];
    if (square >= least) continue;
    least = square;
    rho = away[0];
    s = away[1];
  }
}

double Frustum::distance_bound(const Vector3<double> &center) const
{
  const Meridian m = meridian(center);
  if (open) {
    double rho, s;
    from_lateral(m, rho, s);
    return std::sqrt(rho * rho + s * s);
  }
  double depth[3];
  depths(m, depth);
  const double least = std::min({depth[0], depth[1], depth[2]});
  if (least >= 0.0 || infinite || inside) return std::fabs(least);
  double rho, s;
  from_outline(m, rho, s);
  return std::sqrt(rho * rho + s * s);
}

/* Inside, faces go on beyond the rims. */

double Frustum::extent_from(const Vector3<double> &point) const
{
  if (inside || infinite) return LargeBodyShape::extent_from(point);
  return length(point - middle) + std::hypot(half, std::max(low, high));
}

void Frustum::tessellate(const Eigen::AlignedBox3d &visible, std::vector<Triangle> &triangles) const
{
  constexpr int sectors = 48;
  const Vector3<double> span = from_eigen(visible.sizes());
  const Vector3<double> center = from_eigen(visible.center());
  const double reach = std::sqrt(dot(span, span));
  const double shift = infinite ? dot(center - middle, axis) : 0.0;
  const double l = infinite ? 0.5 * reach : half;
  const Vector3<double> other = cross(axis, side);
  const Vector3<double> cap[2] = {middle + (shift - l) * axis, middle + (shift + l) * axis};
  const auto point = [&](int end, int sector) {
    const double a = 2.0 * std::acos(-1.0) * sector / sectors, r = end ? high : low;
    return cap[end] + r * (std::cos(a) * side + std::sin(a) * other);
  };
  for (int k = 0; k < sectors; k++) {
    if (low > 0.0) triangles.push_back({{point(0, k), point(0, k + 1), point(1, k)}});
    if (high > 0.0) triangles.push_back({{point(0, k + 1), point(1, k + 1), point(1, k)}});
    if (infinite || open) continue;
    if (low > 0.0) triangles.push_back({{cap[0], point(0, k + 1), point(0, k)}});
    if (high > 0.0) triangles.push_back({{cap[1], point(1, k), point(1, k + 1)}});
  }
}

void Frustum::visit_surfaces(SurfaceVisitor &visitor) const
{
  if (open) return;    // touched from both sides
  if (inside)
    visitor.vessel(*this, walls());
  else
    visitor.frustum(*this);
}

std::vector<InwardWall> Frustum::walls() const
{
  InwardWall lateral{InwardWall::Kind::ROUND, LATERAL, middle, axis, side};
  lateral.radius = 0.5 * (low + high);
  lateral.normal_away = normal_rho;
  lateral.normal_along = normal_s;
  std::vector<InwardWall> all{lateral};
  for (const int end : {0, 1}) {
    const Rim at = rim(end);
    if (!infinite && at.radius > 0.0)
      all.push_back({InwardWall::Kind::FLAT, end ? HIGH_CAP : LOW_CAP, at.center, at.axis});
  }
  return all;
}

}    // namespace Talus
