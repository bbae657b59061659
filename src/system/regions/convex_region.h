// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A simple convex region of LAMMPS where it stands in a step: the inner side of some planes and of at
// most one sphere, cylinder or cone. The depth of a point is how far it is inside of the nearest of
// these, or minus how far it is outside of the farthest: no point of the surface is nearer than
// |depth|. That tells, for eight points at a time, which cannot touch; how the others touch, LAMMPS
// is asked itself.
//
// Lengths and positions are those of the simulation box. The region must have constant shape.

#ifndef TALUS_SYSTEM_REGIONS_CONVEX_REGION_H
#define TALUS_SYSTEM_REGIONS_CONVEX_REGION_H

#include "base/vector3.h"

#include <vector>

namespace LAMMPS_NS {
class Region;
}    // namespace LAMMPS_NS

namespace Talus {

class RegionPose;
struct CornersOfRegion;
struct RoundRegion;

class ConvexRegion {
 public:
  /// Region styles block, cone, cylinder, plane, prism, sphere.
  static bool includes(const LAMMPS_NS::Region &region);
  /// Of those styles; as it was before it moved, and is not asked again.
  explicit ConvexRegion(const LAMMPS_NS::Region &region);

  /// In each step, of a region that moves.
  void place(const RegionPose &pose);

  /// Bits of the points that may be nearer to the surface than `reach`; all that are have theirs,
  /// but for rounding. Open faces count as closed, and both sides are seen.
  unsigned near(const Vector3<Vec8> &x, Vec8 reach) const;

 private:
  /// Inside: normal x >= offset; a unit vector.
  struct Plane {
    Vector3<double> normal;
    double offset;
  };
  /// Inside: distance from the line through `point` along `axis` <= radius + slope s, where s is
  /// the way along the axis from the point. Of a sphere the axis is 0.
  struct Round {
    Vector3<double> point, axis;
    double radius, slope, cosine;    // of the angle between surface and axis
  };
  void add_plane(const Vector3<double> &point, const Vector3<double> &normal);
  void add_planes(const CornersOfRegion &corners);
  void add_round(const RoundRegion &shape);
  Vec8 depth(const Vector3<Vec8> &x) const;

  std::vector<Plane> planes_at_rest, planes;
  std::vector<Round> rounds_at_rest, rounds;    // one or none
};

}    // namespace Talus

#endif
