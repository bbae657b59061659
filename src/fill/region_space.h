// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The part of the simulation box that is in a region, as spheres find it that are to be whole
// within: faces of the region are walls, but for those on a periodic face of the box, and so are
// fixed faces of the box. Faces that are shrink-wrapped are none: the region may be beyond them, for the box
// grows with what is made there.

#ifndef TALUS_FILL_REGION_SPACE_H
#define TALUS_FILL_REGION_SPACE_H

#include "packing/random_numbers.h"
#include "packing/sphere_packing.h"

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class RegionSpace : public Talus::PackingSpace, protected Pointers {
 public:
  /// `command`: for messages. An error if there is no such region, or it cannot be used.
  /// Collective.
  RegionSpace(LAMMPS *lmp, const std::string &command, const std::string &region_id);

  bool contains(const Talus::Vector3<double> &x) const override;
  void find_walls(const Talus::Vector3<double> &x, double radius,
                  std::vector<std::pair<Talus::Vector3<double>, double>> &walls) const override;
  /// A sphere of this radius would be whole within.
  bool holds(const Talus::Vector3<double> &x, double radius) const;

  double volume() const;
  /// Not less than that.
  double volume_between_corners() const;
  /// Corners of what may have some of the region, where it is now; of all of the box where LAMMPS does not know
  /// how far the region extends.
  Talus::Vector3<double> low_corner() const { return {low[0], low[1], low[2]}; }
  Talus::Vector3<double> high_corner() const { return {high[0], high[1], high[2]}; }
  /// Somewhere between these corners.
  Talus::Vector3<double> draw(Talus::RandomNumbers &random) const override;

 private:
  bool is_periodic_face(const Talus::Vector3<double> &at, const Talus::Vector3<double> &n) const;

  class Region *region;
  double low[3], high[3];    // the corners
};

}    // namespace LAMMPS_NS

#endif
