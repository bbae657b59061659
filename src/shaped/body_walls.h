// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPED_BODY_WALLS_H
#define TALUS_SHAPED_BODY_WALLS_H

#include "body/shape/large_body_shape.h"
#include "shape/collide.h"

#include <memory>
#include <vector>

namespace Talus {

/// The surface of a large body as convex particles touch it, in the frame of the body: planes, a
/// cylinder from inside, a box or a ball from outside, or several of these.
class BodyWalls {
 public:
  /// Has no walls if the body is of another kind.
  explicit BodyWalls(const LargeBodyShape &body);

  int size() const
  {
    return static_cast<int>(flat.size() + round.size() + solid.size() + ball.size());
  }

  /// Contacts of a particle with wall 0 ... size()-1; returns whether there are any. Like a sphere,
  /// a particle is pushed out by a plane up to a center one bounding radius behind it.
  bool touch(int wall, const ConvexShape &shape, const Pose &pose, ConvexContacts &contacts) const;

 private:
  struct Flat {
    Vector3<double> normal;    ///< particles are where it points to
    double offset;
    bool two_sided;    ///< particles are on the side where their center is
  };
  struct Round {
    Vector3<double> point, axis;
    double radius;
  };
  struct Solid {
    std::shared_ptr<const ConvexShape> shape;
    Pose pose;
  };
  struct Ball {
    Vector3<double> center;
    double radius;
  };
  bool touch_flat(const Flat &wall, const ConvexShape &shape, const Pose &pose,
                  ConvexContacts &contacts) const;
  void add_flat(const Vector3<double> &normal, const Vector3<double> &point, bool two_sided);

  std::vector<Flat> flat;
  std::vector<Round> round;
  std::vector<Solid> solid;
  std::vector<Ball> ball;
};

}    // namespace Talus

#endif
