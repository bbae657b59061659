// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SHAPE_GEOMETRY_H
#define TALUS_SHAPE_GEOMETRY_H

namespace Talus {

/// What a particle with a shape may touch: another one, a sphere, a surface of a large body. Which
/// function finds the contacts of two of them is said in one table by their classes, see
/// collisions.h.
class Geometry {
 public:
  virtual ~Geometry() = default;

 protected:
  Geometry() = default;
  Geometry(const Geometry &) = default;
  Geometry &operator=(const Geometry &) = default;
};

/// A particle without a shape, in the frame that has its center as origin.
struct Sphere : Geometry {
  double radius = 0.0;    ///< length
};

}    // namespace Talus

#endif
