// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/shape_table.h"

#include "packing/random_numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace Talus {
namespace {

FreeRotation rotation_of(const Shape &shape, double density)
{
  const Eigen::Vector3d unit = shape.principal_moments();
  return {{density * unit(0), density * unit(1), density * unit(2)},
          Eigen::Quaterniond(shape.given_frame().rotation)};
}

}    // namespace

ParticleShape::ParticleShape(std::shared_ptr<const Shape> particle_shape, double density) :
    geometry(std::move(particle_shape)), particle_mass(density * geometry->volume()),
    free(rotation_of(*geometry, density)), held(*geometry)
{
  for (const Triangle &part : geometry->surface(3))
    for (const Vector3<double> &p : part.corner)
      half_width = {std::max(half_width.x, std::abs(p.x)), std::max(half_width.y, std::abs(p.y)),
                    std::max(half_width.z, std::abs(p.z))};
}

double ParticleShape::fastest_by_turning(const Vector3<double> &omega) const
{
  double fastest = 0.0;
  for (const double y : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0})    // opposite corners are as fast
      fastest = std::max(fastest,
                         length(cross(omega, {half_width.x, y * half_width.y, z * half_width.z})));
  return fastest;
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

void ShapeTable::set(int type, std::shared_ptr<const ParticleShape> shape)
{
  if (type >= static_cast<int>(shapes.size())) shapes.resize(type + 1);
  shapes[type] = std::move(shape);
  const Sphere sphere;
  const auto geometry_of = [&](std::size_t k) -> const Geometry & {
    if (shapes[k]) return shapes[k]->shape();
    return sphere;
  };
  of_types.clear();
  for (std::size_t i = 0; i < shapes.size(); i++)
    for (std::size_t j = 0; j < shapes.size(); j++)
      of_types.push_back(collisions->find(geometry_of(i), geometry_of(j)));
}

double ShapeTable::memory_usage() const
{
  double bytes = 0.0;
  for (const auto &one : shapes)
    if (one) bytes += one->shape().memory_usage();
  return bytes;
}

}    // namespace Talus
