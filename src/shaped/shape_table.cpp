// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shaped/shape_table.h"

#include "packing/random_numbers.h"

#include <cmath>
#include <utility>

namespace Talus {
namespace {

FreeRotation rotation_of(const ConvexShape &shape, double density)
{
  const Eigen::Vector3d &unit = shape.principal_moments();
  return {{density * unit(0), density * unit(1), density * unit(2)},
          Eigen::Quaterniond(shape.given_frame().rotation)};
}

}    // namespace

ParticleShape::ParticleShape(ConvexShape its_shape, double density) :
    geometry(std::move(its_shape)), its_mass(density * geometry.volume()),
    free(rotation_of(geometry, density)), held(geometry)
{
}

Eigen::Quaterniond ParticleShape::new_orientation(std::int64_t id) const
{
  if (!random) return fixed;
  RandomNumbers numbers(seed);
  numbers.state ^= RandomNumbers(static_cast<std::uint64_t>(id)).draw();
  constexpr double two_pi = 6.283185307179586;
  const double u = numbers.uniform(), a = two_pi * numbers.uniform(),
               b = two_pi * numbers.uniform(), r = std::sqrt(1.0 - u), s = std::sqrt(u);
  return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

double ShapeTable::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &one : shapes)
    if (one) bytes += one->shape().memory_usage();
  return bytes;
}

}    // namespace Talus
