// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a wall needs to know of a region of LAMMPS beyond what its contacts are: which particles
// cannot touch its surface for a while, and how far that surface moves.
//
// All lengths and positions are those of the simulation box.

#ifndef TALUS_FIX_REGION_SURFACE_H
#define TALUS_FIX_REGION_SURFACE_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
class Region;
}    // namespace LAMMPS_NS

namespace Talus {

/// A box with sides along the axes; empty while lo > hi.
struct AxisBox {
  double lo[3] = {1.0e300, 1.0e300, 1.0e300}, hi[3] = {-1.0e300, -1.0e300, -1.0e300};

  bool is_empty() const { return lo[0] > hi[0]; }
  void add(const double *x);
  void widen(double by);
};

/// Where a region is that is moved and turned as a whole: x = rotation x_0 + shift.
class RegionPose {
 public:
  RegionPose() = default;
  /// Now, after Region::prematch().
  explicit RegionPose(LAMMPS_NS::Region &region);

  /// Largest distance of a point that is inside the box from where the same point of the region was
  /// in the pose `then`.
  double largest_displacement(const RegionPose &then, const AxisBox &box) const;

  /// Where a point of the region is, and which point of the region is at x.
  void place_of(const double *x0, double *x) const;
  void origin_of(const double *x, double *x0) const;
  /// A vector of the region's frame in that of the simulation box; in place.
  void turn(double *vector) const;

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
  /// In init() of who asks, for regions may be defined anew; of a region that has_distance().
  explicit RegionParts(LAMMPS_NS::Region &region) { collect(region); }

  /// In each step, after Region::prematch().
  void place();
  /// See RegionPose; of all parts, since they had the poses `then`.
  double largest_displacement(const std::vector<RegionPose> &then, const AxisBox &box) const;

  const std::vector<LAMMPS_NS::Region *> &regions() const { return simple; }
  const std::vector<RegionPose> &poses() const { return pose; }

 private:
  void collect(LAMMPS_NS::Region &region);

  std::vector<LAMMPS_NS::Region *> simple;
  std::vector<RegionPose> pose;
};

/// How a simple region that moves or turns stands, in the words of its command: x = point + turned
/// by `angle` about `axis` (x_0 - point) + displacement. `point` is the origin without `rotate`.
struct RegionTurn {
  double point[3] = {0.0, 0.0, 0.0}, axis[3] = {0.0, 0.0, 1.0};
  double displacement[3] = {0.0, 0.0, 0.0}, angle = 0.0;

  /// Now, after Region::prematch().
  explicit RegionTurn(const LAMMPS_NS::Region &region);
};

/// Made of other regions.
bool is_composite(const LAMMPS_NS::Region &region);

/// "" if the variables that move a region, or shape it, depend on the time alone; else the name of
/// one that may depend on particles. Of a region that changes its shape all variables of the script
/// are asked.
std::string variable_that_may_read_particles(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::Region &region);

/// While it exists, a simple region answers as it was before it moved.
class RegionAtRest {
 public:
  explicit RegionAtRest(LAMMPS_NS::Region &region);
  ~RegionAtRest();
  RegionAtRest(const RegionAtRest &) = delete;
  RegionAtRest &operator=(const RegionAtRest &) = delete;

 private:
  LAMMPS_NS::Region &region;
  const int dynamic, turns;
};

/// Asks a simple region in its own frame: the pose of a step is computed once, where the host does
/// it again, with a sine and a cosine, for every question. Answers differ by rounding.
class RegionInFrame {
 public:
  /// Both must exist as long as this does; `pose` that of the region, after prematch().
  RegionInFrame(LAMMPS_NS::Region &region, const RegionPose &pose) : region(region), pose(pose) {}

  /// As Region::match() and Region::surface(): contacts are in region.contact.
  bool match(const double *x) const;
  int surface(const double *x, double cutoff) const;

 private:
  LAMMPS_NS::Region &region;
  const RegionPose &pose;
};

/// While it exists, a region that has_distance() is asked for its closed surface in place of its
/// contacts: open faces count as closed, and both sides are seen.
class ClosedSurface {
 public:
  /// Must exist as long as this does.
  explicit ClosedSurface(const RegionParts &parts);
  ~ClosedSurface();
  ClosedSurface(const ClosedSurface &) = delete;
  ClosedSurface &operator=(const ClosedSurface &) = delete;

  /// Whether the surface may be closer to x than `reach`; true for all that are.
  bool is_near(const double *x, double reach) const;

 private:
  struct Settings {
    int interior, openflag, dynamic, rotateflag, open_faces[6];
  };
  const RegionParts &parts;
  std::vector<Settings> before;    // of each part
};

}    // namespace Talus

#endif
