// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_REGIONS_REGION_SHAPE_H
#define TALUS_SYSTEM_REGIONS_REGION_SHAPE_H

#include "body/shape/large_body_shape.h"
#include "system/regions/region_surface.h"

#include <string>

namespace LAMMPS_NS {

class Domain;
class Region;

/// The surface of a region of LAMMPS, seen from where its particles are, as fix wall/gran/region
/// sees it. A region that moves is asked as if it did not: how it moves is a matter of the body.
/// The region keeps its contacts in its own arrays, so one thread asks it.
class RegionShape : public Talus::LargeBodyShape {
 public:
  RegionShape(Region *region, const char *id, const Domain &domain);

  /// Regions may be deleted and defined again between runs: tell the shape at the start of each.
  const std::string &region_id() const { return id; }
  void replace(Region *now, const Domain &domain);

  /// Why a region cannot be a body, or "". `moves`: the body has a motion of its own.
  static std::string refusal(Region &region, bool moves);

  bool touches(const Talus::Vector3<double> &center, double radius,
               Talus::SurfaceContact &contact) const override;
  double distance_bound(const Talus::Vector3<double> &center) const override;
  Talus::Vector3<double> reference_point() const override { return middle; }
  int most_contacts() const override { return max_contacts; }
  bool thread_safe() const override { return false; }
  int find_contacts(const Talus::Vector3<double> &center, double radius, Talus::NearParts parts,
                    Talus::SurfaceContact *found) const override;
  bool is_near(const Talus::Vector3<double> &center, double reach,
               std::vector<Talus::NearPart> &parts) const override;

 private:
  Region *region = nullptr;
  std::string id;
  Talus::Vector3<double> middle{0.0, 0.0, 0.0};
  Talus::PeriodicSpan span;
};

}    // namespace LAMMPS_NS

#endif
