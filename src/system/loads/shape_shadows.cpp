// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/shape_shadows.h"

#include <cmath>

namespace Talus {

const ShapeShadows::Surface &ShapeShadows::surface_of(int type, const ParticleShape &particle)
{
  if (type >= static_cast<int>(by_type.size())) by_type.resize(type + 1);
  Surface &surface = by_type[type];
  if (!surface.faces.empty()) return surface;
  constexpr int pieces = 12;    // of an arc of 90 degrees
  constexpr double pi = 3.14159265358979323846;
  double volume = 0.0, area = 0.0;
  for (const Triangle &one : particle.shape().surface(pieces)) {
    const Vector3<double> face =
        0.5 * cross(one.corner[1] - one.corner[0], one.corner[2] - one.corner[0]);
    volume += dot(one.corner[0], face) / 3.0;
    area += length(face);
    surface.faces.push_back(face);
  }
  const double exact = particle.shape().volume(), radius = std::cbrt(0.75 / pi * exact),
               enlarged = std::pow(exact / volume, 2.0 / 3.0);
  for (Vector3<double> &face : surface.faces) face = 0.5 * enlarged / (pi * radius * radius) * face;
  surface.sphericity = 4.0 * pi * radius * radius / (area * enlarged);
  return surface;
}

double ShapeShadows::sphericity(int type, const ParticleShape &shape)
{
  return surface_of(type, shape).sphericity;
}

double ShapeShadows::crosswise(int type, const ParticleShape &shape, const double *quaternion,
                               const Vector3<double> &direction)
{
  const Pose pose =
      shape.pose({0.0, 0.0, 0.0}, {quaternion[0], quaternion[1], quaternion[2], quaternion[3]});
  const Vector3<double> seen = pose.direction_in_body(direction);
  double sum = 0.0;
  for (const Vector3<double> &face : surface_of(type, shape).faces)
    sum += std::fabs(dot(face, seen));
  return length(seen) / sum;
}

}    // namespace Talus
