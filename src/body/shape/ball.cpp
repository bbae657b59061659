// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/ball.h"

#include "body/shape/surface_visitor.h"

#include <cmath>

namespace Talus {

Ball::Ball(const Vector3<double> &c, double radius, bool in) : middle(c), size(radius), inside(in)
{
}

bool Ball::touches(const Vector3<double> &center, double radius, SurfaceContact &contact) const
{
  const Vector3<double> away = center - middle;
  const double distance = std::sqrt(dot(away, away));
  const double height = inside ? size - distance : distance - size;
  if (std::fabs(height) >= radius || distance == 0.0) return false;
  contact.normal = (inside ? -1.0 : 1.0) / distance * away;
  contact.overlap = radius - height;
  contact.part = 0;
  return true;
}

double Ball::distance_bound(const Vector3<double> &center) const
{
  const Vector3<double> away = center - middle;
  return std::fabs(std::sqrt(dot(away, away)) - size);
}

double Ball::extent_from(const Vector3<double> &point) const
{
  return length(point - middle) + size;
}

void Ball::tessellate(const Eigen::AlignedBox3d & /*visible*/,
                      std::vector<Triangle> &triangles) const
{
  constexpr int rings = 12, sectors = 24;
  const double pi = std::acos(-1.0);
  const auto point = [&](int ring, int sector) {
    const double a = pi * ring / rings, b = 2.0 * pi * sector / sectors;
    return middle + size * Vector3<double>{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b),
                                           std::cos(a)};
  };
  for (int i = 0; i < rings; i++)
    for (int j = 0; j < sectors; j++) {
      if (i > 0) triangles.push_back({{point(i, j), point(i + 1, j), point(i, j + 1)}});
      if (i < rings - 1)
        triangles.push_back({{point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)}});
    }
}

void Ball::visit_surfaces(SurfaceVisitor &visitor) const
{
  if (inside)
    visitor.vessel(*this,
                   {{InwardWall::Kind::BALL, 0, middle, {0.0, 0.0, 1.0}, {}, 1.0, 0.0, size}});
  else
    visitor.ball(middle, size);
}

}    // namespace Talus
