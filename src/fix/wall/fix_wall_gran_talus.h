// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix wall/gran/talus: the accelerated variant of fix wall/gran, planes and cylinders. Words,
// output and restart data: fix wall/gran of LAMMPS. Errors: those of LAMMPS.

#ifndef LMP_FIX_WALL_GRAN_TALUS_H
#define LMP_FIX_WALL_GRAN_TALUS_H

#include "fix/wall/fix_wall_gran_accelerated.h"
#include "fix/wall/wall_cylinder.h"
#include "fix/wall/wall_planes.h"
#include "system/host/lammps_compat.h"

#include "fix_wall_gran.h"

namespace LAMMPS_NS {

class FixWallGranTalus : public Talus::AcceleratedWall<FixWallGran> {
 public:
  FixWallGranTalus(LAMMPS *lmp, int narg, char **arg) : AcceleratedWall(lmp, narg, arg, "wall/gran")
  {
  }

#if TALUS_HOST_DRAWS_GRAN_WALLS
  int image(int *&, double **&) override;
#endif

 protected:
  bigint stock_size(const double * /*data*/) const override
  {
    return 1 + size_history;
  }
  const Talus::LargeBodyShape &begin_run() override;
  void place() override;
  void are_listed() override
  {
    listed_at = gone();
  }
  double displacement() const override;
  std::string what_only_stock_does() const override;
  std::string what_reads_arrays() override
  {
    return "";
  }

  // the arrays
  int count(int i) const override
  {
    return wall_law.touches(history_one[i]) ? 1 : 0;
  }
  int read(int i, int k, Talus::HistoryValues &values) const override;
  void clear(int i) override;
  void add(int i, int part, const Talus::HistoryValues &values) override;

 private:
  bool is_cylinder() const
  {
    return wallstyle > 2;
  }
  double phase() const;    // of the oscillation
  double gone() const;     // by the planes, along their normals

  Talus::WallPlanes planes;
  Talus::WallCylinder cylinder;
  double listed_at = 0.0;    // gone() when candidates were found
};

}    // namespace LAMMPS_NS

#endif
