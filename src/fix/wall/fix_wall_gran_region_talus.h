// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix wall/gran/region/talus: the accelerated variant of fix wall/gran/region. Words, output and
// restart data: fix wall/gran/region of LAMMPS. Errors: those of LAMMPS.

#ifndef LMP_FIX_WALL_GRAN_REGION_TALUS_H
#define LMP_FIX_WALL_GRAN_REGION_TALUS_H

#include "fix/wall/fix_wall_gran_accelerated.h"
#include "system/regions/region_shape.h"

#include "fix_wall_gran_region.h"

namespace LAMMPS_NS {

class FixWallGranRegionTalus : public Talus::AcceleratedWall<FixWallGranRegion> {
 public:
  FixWallGranRegionTalus(LAMMPS *lmp, int narg, char **arg) :
      AcceleratedWall(lmp, narg, arg, "wall/gran/region")
  {
  }
  void write_restart(FILE *file) override;
  void post_force(int vflag) override;

 protected:
  bigint stock_size(const double *data) const override;
  const Talus::LargeBodyShape &begin_run() override;
  void place() override { surface->place(); }
  bool is_bounded() const override { return surface->has_distance(); }
  void are_listed() override;
  double displacement() const override { return surface->displacement(); }
  std::string what_only_stock_does() const override;
  std::string what_reads_arrays() override;

  // the arrays
  int count(int i) const override { return ncontact[i]; }
  int read(int i, int k, Talus::HistoryValues &values) const override;
  void clear(int i) override { ncontact[i] = 0; }
  void add(int i, int part, const Talus::HistoryValues &values) override;

 private:
  std::unique_ptr<Talus::RegionShape> surface;    // of this run
};

}    // namespace LAMMPS_NS

#endif
