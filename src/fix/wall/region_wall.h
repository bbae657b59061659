// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_FIX_WALL_REGION_WALL_H
#define TALUS_FIX_WALL_REGION_WALL_H

#include "base/linear_algebra.h"
#include "body/contact/wall_surface.h"
#include "system/regions/region_surface.h"

#include <vector>

namespace LAMMPS_NS {

class Domain;
class Region;

/// The surface of the region of a fix wall/gran/region: which spheres may touch it is found eight at a
/// time, what they touch the region is asked. It keeps the contacts that it has found last.
class RegionWall : public Talus::WallSurface {
 public:
  RegionWall() = default;
  /// In init() of the fix. `radii_vary`: then all particles may touch it in every step.
  RegionWall(Region &region, const Domain &domain, bool radii_vary);

  /// In each step.
  void place();
  /// It moves or changes its shape.
  bool is_dynamic() const { return dynamic; }
  /// Of others every particle may touch it in every step.
  bool is_bounded() const { return bounded; }
  /// Particles within this box are listed.
  void are_listed(const Eigen::AlignedBox3d &box);
  /// How far a point of the surface has gone at most since then.
  double displacement() const;

  bool touches(const Talus::Vector3<double> &center, double radius,
               Talus::SurfaceContact &contact) const override;
  int most_contacts() const override;
  bool thread_safe() const override { return false; }
  unsigned may_touch(const Talus::EightSpheres &spheres, bool listed) const override;
  int find(const Talus::Vector3<double> &center, double radius, Talus::SurfaceContact *found,
           Point *points) const override;

 private:
  bool is_inside(const Talus::Vector3<double> &center) const;
  int contacts_beside(const Talus::Vector3<double> &center, double radius) const;
  int contacts_at(const Talus::Vector3<double> &center, double radius) const;
  bool have_normals(int count) const;
  unsigned near_in_images(const Talus::Vector3<Talus::Vec8> &x, Talus::Vec8 reach,
                          bool listed) const;
  Talus::Vector3<double> velocity_at(const Talus::Vector3<double> &center, int contact) const;

  Region *region = nullptr;
  bool dynamic = false;          // it moves or changes its shape
  bool bounded = false;          // distances from it are known
  bool simple = false;           // and it is not made of others
  bool in_frame = false;         // it is asked in its own frame, see RegionInFrame
  Talus::RegionMotion motion;    // of this step, then
  Talus::RegionParts parts;      // if it is bounded
  Talus::PeriodicSpan span;
  std::vector<Talus::RegionPose> listed_poses;
  Eigen::AlignedBox3d listed_box;
};

}    // namespace LAMMPS_NS

#endif
