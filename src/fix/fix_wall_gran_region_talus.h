// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix wall/gran/region/talus: the accelerated variant of fix wall/gran/region. Words, output and
// restart data: fix wall/gran/region of LAMMPS. Errors: those of LAMMPS.

#ifndef LMP_FIX_WALL_GRAN_REGION_TALUS_H
#define LMP_FIX_WALL_GRAN_REGION_TALUS_H

#include "fix/fix_wall_gran_accelerated.h"
#include "fix/region_surface.h"

#include "fix_wall_gran_region.h"

namespace LAMMPS_NS {

class FixWallGranRegionTalus : public Talus::AcceleratedWall<FixWallGranRegion> {
 public:
  FixWallGranRegionTalus(LAMMPS *lmp, int narg, char **arg) :
      AcceleratedWall(lmp, narg, arg, "wall/gran/region")
  {
  }

 protected:
  void begin_run() override;
  void add_contacts() override;
  void report_contacts() override;
  std::string what_only_stock_does() const override { return ""; }
  std::string what_reads_arrays() override;

 private:
  double displacement() const;
  bool is_inside(const Talus::Vector3<double> &center);
  int find_contacts(const Talus::Vector3<double> &center, double reach);
  int contacts_at(const Talus::Vector3<double> &center, double reach);
  bool have_normals(int count) const;
  double reach_of(double radius);
  unsigned near(const Talus::SphereLanes &spheres, double margin);
  unsigned near_in_images(const Talus::Vector3<Talus::Vec8> &x, Talus::Vec8 reach, bool later);
  void find_candidates(double moved, const Talus::ParticleState &particles);
  void begin_step();
  void add_contacts_of_candidates(const Talus::ParticleState &particles);
  void add_contacts_of(int i, const Talus::ParticleState &particles);
  void add_contact(int i, int ic, const Talus::ParticleState &particles);
  void find_wall_velocity(const double *position, int ic);
  void clear_history(int i, const Talus::ParticleState &particles);
  bool match_history(int i, int nc);

  bool dynamic = false;          // the region moves or changes its shape
  bool bounded = false;          // distances from it are known
  bool simple = false;           // and it is not made of others
  bool in_frame = false;         // it is asked in its own frame, see RegionInFrame
  Talus::RegionMotion motion;    // of this step, then
  Talus::RegionParts parts;      // if it is bounded
  Talus::PeriodicSpan span;
  std::vector<Talus::RegionPose> listed_poses;
  Talus::AxisBox listed_box;    // around all that particles of the group can touch
  Talus::WallBatch batch;
  double velocity[3] = {0.0, 0.0, 0.0};
};

}    // namespace LAMMPS_NS

#endif
