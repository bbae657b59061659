// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BODY_SHAPE_SURFACE_VISITOR_H
#define TALUS_BODY_SHAPE_SURFACE_VISITOR_H

#include "base/vector3.h"
#include "body/shape/inward_wall.h"

#include <memory>
#include <vector>

namespace Talus {

class Frustum;
class LargeBodyShape;
class MeshShape;

/// Is told of what surfaces a large body consists, in its frame. They live as long as the body; of a
/// body that consists of several, such as a box from inside, each touches for itself.
class SurfaceVisitor {
 public:
  /// A plane; particles are on the side of its normal (a unit vector), or with two sides on that of
  /// their center. `part`: see SurfaceContact.
  virtual void flat(const Vector3<double> &normal, const Vector3<double> &point, bool two_sided,
                    int part) = 0;
  /// From outside; lengths of edges along x, y, z.
  virtual void box(const Vector3<double> &center, const Vector3<double> &edges) = 0;
  virtual void ball(const Vector3<double> &center, double radius) = 0;
  /// A cylinder or cone from outside.
  virtual void frustum(const Frustum &body) = 0;
  /// The inside of a body whose walls are flat or curved inward, such as a drum or a cone:
  /// find_contacts() finds those near a sphere of any radius.
  virtual void vessel(const LargeBodyShape &body, const std::vector<InwardWall> &walls) = 0;
  virtual void mesh(std::shared_ptr<const MeshShape> mesh) = 0;

 protected:
  ~SurfaceVisitor() = default;
};

}    // namespace Talus

#endif
