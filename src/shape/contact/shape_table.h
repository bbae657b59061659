// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_CONTACT_SHAPE_TABLE_H
#define TALUS_SHAPE_CONTACT_SHAPE_TABLE_H

#include "body/motion/free_rotation.h"
#include "shape/collisions.h"
#include "shape/face_stiffness.h"
#include "shape/shape.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace Talus {

/// What all particles of a type have in common. Orientations lead from the frame in which the script
/// gives the shape to space; that of the shape itself follows.
class ParticleShape {
 public:
  /// `density`: mass/length^3.
  ParticleShape(std::shared_ptr<const Shape> particle_shape, double density);

  const Shape &shape() const { return *geometry; }
  double mass() const { return particle_mass; }
  const FreeRotation &rotation() const { return free; }
  const FaceStiffness &faces() const { return held; }
  /// Largest speed of a point of the box around it, in the frame of the shape, that turns with omega
  /// (the same frame).
  double fastest_by_turning(const Vector3<double> &omega) const;
  /// Of the shape, for a particle with its center of mass at x.
  Pose pose(const Vector3<double> &x, const Eigen::Quaterniond &orientation) const
  {
    Pose whole;
    whole.position = x;
    whole.rotation = orientation.toRotationMatrix() * geometry->given_frame().rotation;
    return whole;
  }

  /// What new particles of the type have, by ID; of unit length.
  Eigen::Quaterniond new_orientation(std::int64_t id) const;
  void set_fixed(const Eigen::Quaterniond &orientation) { fixed = orientation; }
  /// Uniform among all rotations (Shoemake, Graphics Gems III, 1992), from seed and ID alone.
  void set_random(std::uint64_t random_seed)
  {
    random = true;
    seed = random_seed;
  }

 private:
  std::shared_ptr<const Shape> geometry;
  double particle_mass;
  FreeRotation free;
  FaceStiffness held;
  Vector3<double> half_width{0.0, 0.0, 0.0};    ///< of the box around it
  Eigen::Quaterniond fixed = Eigen::Quaterniond::Identity();
  bool random = false;
  std::uint64_t seed = 0;
};

/// By type, from 1; types without a shape are spheres.
class ShapeTable {
 public:
  /// `collisions`: must live as long as this.
  explicit ShapeTable(const Collisions &collision_table) : collisions(&collision_table) {}

  void set(int type, std::shared_ptr<const ParticleShape> shape);
  /// nullptr of spheres.
  const ParticleShape *of(int type) const
  {
    return type < static_cast<int>(shapes.size()) ? shapes[type].get() : nullptr;
  }
  double bounding_radius(int type) const
  {
    return of(type) ? of(type)->shape().bounding_radius() : 0.0;
  }
  /// Of the largest sphere inside; `radius`: of a sphere.
  double radius_inside(int type, double radius) const
  {
    return of(type) ? of(type)->shape().inscribed_radius() : radius;
  }
  bool is_empty() const { return shapes.empty(); }
  /// What finds the contacts of particles of two types; nothing of two spheres.
  const Collisions::Collision &collision(int i, int j) const
  {
    return of_types[shapes.size() * row(i) + row(j)];
  }
  /// The same of a type with a shape and a surface of a large body.
  Collisions::Collision collision(int type, const Geometry &surface) const
  {
    return collisions->find(of(type)->shape(), surface);
  }
  /// How contacts of two shapes are found.
  NarrowPhase method() const { return narrow_phase; }
  void set_method(NarrowPhase method) { narrow_phase = method; }
  int last_type() const { return static_cast<int>(shapes.size()) - 1; }
  double memory_usage() const;

 private:
  /// Of of_types: 0 of spheres.
  std::size_t row(int type) const { return of(type) ? static_cast<std::size_t>(type) : 0; }

  const Collisions *collisions;
  std::vector<std::shared_ptr<const ParticleShape>> shapes;
  std::vector<Collisions::Collision> of_types;
  NarrowPhase narrow_phase = NarrowPhase::FEATURES;
};

}    // namespace Talus

#endif
