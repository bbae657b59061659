// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Surfaces of large bodies as particles with a shape touch them, in the frame of the body; besides
// these a body may be a ball (Sphere) or a box (ConvexShape). See SurfaceVisitor.

#ifndef TALUS_SHAPE_SURFACE_H
#define TALUS_SHAPE_SURFACE_H

#include "base/vector3.h"
#include "body/shape/inward_wall.h"
#include "shape/geometry.h"

#include <memory>
#include <vector>

namespace Talus {

class Frustum;
class LargeBodyShape;
class MeshFeatures;
class MeshShape;

/// normal . x = offset. Particles are on the side of the normal (a unit vector); with two sides, on that
/// of their center. Like a sphere, a particle is pushed out up to a center one bounding radius behind it.
struct FlatSurface : Geometry {
  Vector3<double> normal;
  double offset;
  bool two_sided;
  int part;    ///< of its contacts, see SurfaceContact
};

/// A cylinder or cone, from outside.
struct RoundSurface : Geometry {
  const Frustum *body;
};

/// The inside of a body, see SurfaceVisitor::vessel().
struct VesselSurface : Geometry {
  const LargeBodyShape *body;
  std::vector<InwardWall> walls;    ///< of it
};

struct MeshSurface : Geometry {
  std::shared_ptr<const MeshShape> shape;    ///< has been told to look at all of itself
  std::shared_ptr<const MeshFeatures> features;
};

}    // namespace Talus

#endif
