// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Geometry of a large body: a body that spans sub-domains, is known to every rank and never becomes
// a ghost. Derive from this class to add a shape of your own. Lengths are in the units of the
// caller; no function may change the object, all may be called from several threads.

#ifndef TALUS_BODY_LARGE_BODY_SHAPE_H
#define TALUS_BODY_LARGE_BODY_SHAPE_H

#include "contact/vector3.h"

namespace Talus {

/// Where a sphere touches a body.
struct SurfaceContact {
  Vector3<double> normal;    ///< unit vector from the body to the centre of the sphere
  double overlap;            ///< radius minus distance of the centre from the surface, > 0
};

class LargeBodyShape {
 public:
  virtual ~LargeBodyShape() = default;

  /// Does the sphere touch the body? Fills `contact` only if it does. Called for every candidate
  /// particle in every step.
  virtual bool touches(const Vector3<double> &centre, double radius,
                       SurfaceContact &contact) const = 0;

  /// A lower bound of the distance at which touches() measures the surface, for the broad phase: a
  /// sphere further away than its radius plus the skin is not looked at until the next rebuild.
  virtual double distance_bound(const Vector3<double> &centre) const = 0;

  /// Point about which torques on the body are taken.
  virtual Vector3<double> reference_point() const = 0;
};

}    // namespace Talus

#endif
