// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_BODY_WALLS_H
#define TALUS_SHAPED_BODY_WALLS_H

#include "body/shape/large_body_shape.h"
#include "shape/collide.h"

#include <functional>
#include <string>
#include <vector>

namespace Talus {

/// The surface of a large body as convex particles touch it, in the frame of the body: one wall, or
/// several (the faces of a box from inside).
class BodyWalls {
 public:
  /// The body must live as long as this. Has no walls where refusal() says why.
  explicit BodyWalls(const LargeBodyShape &body);

  /// "", or for people: which surfaces convex particles touch, for this is none of them.
  static std::string refusal(const LargeBodyShape &body);

  int size() const { return static_cast<int>(walls.size()); }
  /// Contacts tell which part they touch, as those of spheres do.
  bool has_parts() const { return parts; }

  struct Particle {
    const ConvexShape &shape;
    const Pose &pose;
    double force_exponent;    ///< see collide()
  };
  /// Contacts of a particle with wall 0 ... size()-1; returns whether there are any. Like a sphere,
  /// a particle is pushed out by a plane up to a center one bounding radius behind it.
  bool touch(int wall, const Particle &particle, ConvexContacts &contacts) const
  {
    return walls[wall](particle, contacts);
  }

 private:
  using Wall = std::function<bool(const Particle &, ConvexContacts &)>;
  void add_flat(const Vector3<double> &normal, const Vector3<double> &point, bool two_sided,
                int part = 0);
  void add_solid_box(const Vector3<double> &middle, const Vector3<double> &edges);

  bool parts;
  std::vector<Wall> walls;
};

}    // namespace Talus

#endif
