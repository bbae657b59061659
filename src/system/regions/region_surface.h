// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What RegionShape needs to know of a region of LAMMPS beyond what its contacts are: which particles
// cannot touch its surface for a while, how far that surface moves, and where its periodic images are.
//
// All lengths and positions are those of the simulation box.

#ifndef TALUS_SYSTEM_REGIONS_REGION_SURFACE_H
#define TALUS_SYSTEM_REGIONS_REGION_SURFACE_H

#include "base/linear_algebra.h"
#include "system/regions/convex_region.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Domain;
class LAMMPS;
class Region;
}    // namespace LAMMPS_NS

namespace Talus {

/// How a simple region that moves or turns stands, in the words of its command: x = point + turned
/// by `angle` about `axis` (x_0 - point) + displacement. `point` is the origin without `rotate`.
struct RegionMotion {
  double point[3] = {0.0, 0.0, 0.0}, axis[3] = {0.0, 0.0, 1.0};
  double displacement[3] = {0.0, 0.0, 0.0}, angle = 0.0;
  double cosine = 1.0, sine = 0.0;    ///< of the angle
  bool rotates = false;               ///< has `rotate`

  /// At rest.
  RegionMotion() = default;
  /// Now, after Region::prematch().
  explicit RegionMotion(const LAMMPS_NS::Region &region);

  /// Takes a point of the region at rest to where it is now, and back. The sums are those of
  /// Region::rotate(), in its order: so results have the bits of LAMMPS.
  void move(double (&x)[3]) const;
  void move_back(double (&x)[3]) const;

 private:
  void rotate(double (&x)[3], double sine_of_angle) const;
};

/// Where a region is that is moved and turned as a whole: x = rotation x_0 + shift.
class RegionPose {
 public:
  RegionPose() = default;
  explicit RegionPose(const RegionMotion &motion);

  /// Largest distance of a point that is inside the box from where the same point of the region was
  /// in the pose `then`.
  double largest_displacement(const RegionPose &then, const Eigen::AlignedBox3d &box) const;

  /// Where a point of the region is, and which point of the region is at x.
  void place_of(const double *x0, double *x) const;
  void origin_of(const double *x, double *x0) const;
  /// A vector of the region's frame in that of the simulation box.
  Vector3<double> turned(const Vector3<double> &v) const;
  Vector3<double> displacement() const { return {shift[0], shift[1], shift[2]}; }

 private:
  double rotation[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  double shift[3] = {0.0, 0.0, 0.0};
};

/// The surface has a distance that can be bounded: a convex simple region of constant shape, or a
/// union or intersection of those, to any depth. Of all others every particle may touch the surface in
/// every step.
bool has_distance(const LAMMPS_NS::Region &region);

/// The simple regions of which a region is made, or itself, and how each of them stands.
class RegionParts {
 public:
  RegionParts() = default;
  /// To be made in init() of the fix that uses it, because regions may be redefined between runs;
  /// of a region that has_distance().
  explicit RegionParts(LAMMPS_NS::Region &region) { collect(region); }

  /// In each step, after Region::prematch().
  void place();
  /// See RegionPose; of all parts, since they had the poses `then`.
  double largest_displacement(const std::vector<RegionPose> &then,
                              const Eigen::AlignedBox3d &box) const;

  /// See ConvexRegion; of all parts. A surface point of a union or intersection is one of its parts.
  unsigned near(const Vector3<Vec8> &x, Vec8 reach) const;

  const std::vector<RegionPose> &poses() const { return pose; }

 private:
  void collect(LAMMPS_NS::Region &region);

  std::vector<LAMMPS_NS::Region *> simple;
  std::vector<RegionPose> pose;
  std::vector<ConvexRegion> shape;
};

/// A region at rest that is as long as the box goes on behind the faces in which the box is
/// periodic. Particles stay a little beyond a face until neighbor lists are made; they are asked
/// about where their image is.
class PeriodicSpan {
 public:
  PeriodicSpan() = default;
  /// In init() of who asks. Regions without an extent in LAMMPS (`side out`, for one) have none, nor
  /// have those in a box that changes or is tilted.
  PeriodicSpan(const LAMMPS_NS::Region &region, const LAMMPS_NS::Domain &domain);

  bool is_empty() const { return !(period[0] > 0.0 || period[1] > 0.0 || period[2] > 0.0); }
  /// x if it is within the box, else its image there. Never on a face, where a region that ends has
  /// another side.
  Vector3<double> image_of(const Vector3<double> &x) const { return is_empty() ? x : wrapped(x); }
  /// Calls visit(y) for x, one point or eight, and for its images one period away.
  template <class Real, class Visit> void each_image(const Vector3<Real> &x, Visit visit) const
  {
    if (is_empty()) return visit(x);
    for (int k = 0; k < 27; k++) {
      const Vector3<double> shift{(k % 3 - 1) * period[0], (k / 3 % 3 - 1) * period[1],
                                  (k / 9 - 1) * period[2]};
      bool is_new = true;    // where there is no period, once
      for (int d = 0, rest = k; d < 3; d++, rest /= 3)
        is_new = is_new && (period[d] > 0.0 || rest % 3 == 1);
      if (is_new) visit(x + in_all_lanes<Real>(shift));
    }
  }

 private:
  Vector3<double> wrapped(Vector3<double> x) const;

  double low[3] = {0.0, 0.0, 0.0}, period[3] = {0.0, 0.0, 0.0};    // 0: none
};

/// Asks a simple region in its own frame: sine and cosine of a step are computed once, where LAMMPS
/// does it again for every question. Answers have its bits. With a motion at rest: as if it did not move.
class RegionInFrame {
 public:
  /// Both must exist as long as this does; `motion` that of the region, after prematch().
  RegionInFrame(LAMMPS_NS::Region &region, const RegionMotion &motion) :
      region(region), motion(motion)
  {
  }

  /// As Region::match() and Region::surface(): contacts are in region.contact.
  bool match(const double *x) const;
  int surface(const double *x, double cutoff) const;

 private:
  LAMMPS_NS::Region &region;
  const RegionMotion &motion;
};

}    // namespace Talus

#endif
