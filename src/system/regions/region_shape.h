// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The surface of a region of LAMMPS, as fix wall/gran/region sees it: which spheres may touch it is found
// eight at a time, what they touch the region is asked. The region keeps the contacts that it has
// found last in its own arrays, so one thread asks it.
//
//   at the start of a run      take(): regions may be deleted and defined again between runs
//   every step                 place(), of one that moves by itself
//
// Lengths and positions are those of the simulation box.

#ifndef TALUS_SYSTEM_REGIONS_REGION_SHAPE_H
#define TALUS_SYSTEM_REGIONS_REGION_SHAPE_H

#include "base/linear_algebra.h"
#include "body/shape/large_body_shape.h"
#include "system/regions/region_surface.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Domain;
class Region;
}    // namespace LAMMPS_NS

namespace Talus {

class RegionShape : public LargeBodyShape {
 public:
  /// What moves it. BODY: a region that moves is asked as if it did not, and how it moves is a matter of the
  /// body (fix large/body); it has the deepest max_contacts contacts, and is flat. ITSELF: it is asked as it
  /// stands, with contacts in the order of LAMMPS, and tells its velocity and curvature (fix wall/gran/region).
  enum class MovedBy { BODY, ITSELF };
  RegionShape(MovedBy what, LAMMPS_NS::Region &region, const LAMMPS_NS::Domain &domain);

  void take(LAMMPS_NS::Region &now, const LAMMPS_NS::Domain &domain);
  const std::string &region_id() const { return id; }
  /// Why a region cannot be a body, or "". `moves`: the body has a motion of its own.
  static std::string refusal(const LAMMPS_NS::Region &region, bool moves);

  // ---- of one that moves by itself

  void place();
  /// It moves or changes its shape.
  bool is_dynamic() const { return dynamic; }
  /// Of others every particle may touch it in every step.
  bool has_distance() const { return bounded; }
  /// Particles within this box are listed; and how far a point of the surface has gone at most since.
  void are_listed(const Eigen::AlignedBox3d &box);
  double displacement() const;
  /// A particle has touched it at more points than LAMMPS expects of it (tmax) since place(): those beyond
  /// were left out, and the fix ends the run as the stock one does.
  bool had_too_many_contacts() const { return too_many; }

  // LargeBodyShape
  bool touches(const Vector3<double> &center, double radius,
               SurfaceContact &contact) const override;
  /// A region does not know more; is_near() is asked.
  double distance_bound(const Vector3<double> & /*center*/) const override { return 0.0; }
  Vector3<double> reference_point() const override { return middle; }
  int most_contacts() const override;
  bool thread_safe() const override { return false; }
  bool describes_surface() const override { return by_itself; }
  int find_contacts(const Vector3<double> &center, double radius, NearParts parts,
                    SurfaceContact *found) const override;
  unsigned may_touch_eight(const EightSpheres &spheres) const override;
  bool is_near(const Vector3<double> &center, double reach,
               std::vector<NearPart> &parts) const override;

 private:
  // of a point of the span, see PeriodicSpan
  bool is_inside(const Vector3<double> &at) const;
  int contacts_at(const Vector3<double> &at, double radius) const;
  int contacts_beside(const Vector3<double> &at, double radius) const;
  bool have_normals(int count) const;
  int find_in_order(const Vector3<double> &center, double radius, SurfaceContact *found) const;
  void describe(const Vector3<double> &center, int k, SurfaceContact &contact) const;
  Vector3<double> velocity_at(const Vector3<double> &center, int k) const;

  const bool by_itself;
  LAMMPS_NS::Region *region = nullptr;
  std::string id;
  Vector3<double> middle{0.0, 0.0, 0.0};
  bool dynamic = false;     // it moves or changes its shape, by itself
  bool bounded = false;     // distances from it are known
  bool simple = false;      // and it is not made of others
  bool in_frame = false;    // it is asked in its own frame, see RegionInFrame
  RegionMotion motion;      // of this step, then
  RegionParts parts;        // if it is bounded
  PeriodicSpan span;
  std::vector<RegionPose> listed_poses;
  Eigen::AlignedBox3d listed_box;
  mutable std::vector<SurfaceContact> all_of_body;    // see max_contacts
  mutable bool too_many = false;
};

}    // namespace Talus

#endif
