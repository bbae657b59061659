// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The surface of a wall of LAMMPS (fix wall/gran): the shape of a body whose owner moves it by itself,
// so that it is always asked in space. Beside what a shape tells, laws read how it is curved and how
// fast it is at each contact, and contacts with different parts of it are told apart by the numbers
// of the parts. See BodyContacts for who calls it.

#ifndef TALUS_BODY_CONTACT_WALL_SURFACE_H
#define TALUS_BODY_CONTACT_WALL_SURFACE_H

#include "base/vector3.h"
#include "body/shape/large_body_shape.h"

namespace Talus {

class WallSurface : public LargeBodyShape {
 public:
  /// A sphere has no more contacts with a wall than this.
  static constexpr int most_of_wall = 32;

  /// What laws read of it where a sphere touches it.
  struct Point {
    Vector3<double> velocity{0.0, 0.0, 0.0};
    double curvature = 0.0;    ///< 1/radius; 0: flat, < 0: hollow
    int part = -1;             ///< for reports, see ContactReport
  };
  /// Of surfaces with one contact at most: where touches_eight() has found it.
  virtual Point point(const Vector3<double> & /*center*/) const { return {}; }
  /// If not nullptr: velocity and curvature are these at all points.
  virtual const Point *everywhere() const { return nullptr; }

  /// Of surfaces with several, in the place of find_contacts(): contacts, at most most_of_wall, and
  /// their points. Their number, or -1 where contacts neither act nor end: behind the surface.
  virtual int find(const Vector3<double> & /*center*/, double /*radius*/,
                   SurfaceContact * /*found*/, Point * /*points*/) const
  {
    return 0;
  }

  /// Bits of those of eight spheres that may touch it. `listed`: radii are as wide as particles may
  /// go until they are listed again, and then may be beyond a periodic face.
  virtual unsigned may_touch(const EightSpheres &spheres, bool listed) const = 0;

  Vector3<double> reference_point() const override { return {0.0, 0.0, 0.0}; }
  /// may_touch() is asked instead.
  double distance_bound(const Vector3<double> & /*center*/) const override { return 0.0; }
};

/// What a step of a wall reads and writes besides.
struct WallStep {
  const WallSurface &surface;
  const double *masses = nullptr;    ///< of owned particles (mass); nullptr: as contacts feel them
  const double *temperature = nullptr;    ///< by local index, if heat is conducted
  double wall_temperature = 0.0;
  double *heat_flow = nullptr;    ///< by local index, added to (energy/time); or nullptr
};

}    // namespace Talus

#endif
