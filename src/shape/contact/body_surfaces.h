// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_CONTACT_BODY_SURFACES_H
#define TALUS_SHAPE_CONTACT_BODY_SURFACES_H

#include "body/shape/large_body_shape.h"
#include "shape/contact/shape_table.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Talus {

class MeshShape;

/// A large body as particles with a shape touch it, in its frame: one surface or several, such as the
/// faces of a box from inside.
class BodySurfaces {
 public:
  /// Both must live as long as this.
  BodySurfaces(const LargeBodyShape &body, const ShapeTable &shapes);

  /// "", or for people: why some particles cannot touch this body, and the cure. Else all can.
  std::string refusal() const;

  /// Before touch(), in each step: follows a surface whose vertices move.
  void follow();

  int size() const { return static_cast<int>(surfaces.size()); }
  /// Contacts tell which part they touch, as those of spheres do.
  bool has_parts() const { return parts; }

  struct Particle {
    int type;
    const Shape &shape;    ///< that of its type
    const Pose &pose;      ///< in the frame of the body
    double force_exponent;
  };
  /// Contacts of a particle with surface 0 ... size()-1; returns whether there are any.
  bool touch(int surface, const Particle &particle, ShapeContacts &contacts) const
  {
    const Surface &touched = surfaces[surface];
    return touched.collision[particle.type](particle.shape, particle.pose, *touched.geometry,
                                            touched.pose, {particle.force_exponent}, contacts);
  }

 private:
  struct Surface {
    std::shared_ptr<const Geometry> geometry;
    Pose pose{};
    std::vector<Collisions::Collision> collision{};    ///< by type
  };
  class Listing;
  bool touches_all(int type) const;

  const ShapeTable &shapes;
  bool parts;
  std::vector<Surface> surfaces;
  std::shared_ptr<const MeshShape> moving;    // nullptr: no vertices move
  std::int64_t changes = 0;                   // of its surface that have been followed
};

}    // namespace Talus

#endif
