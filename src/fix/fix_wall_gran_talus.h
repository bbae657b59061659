// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// fix wall/gran/talus: the accelerated variant of fix wall/gran, planes and cylinders. Words,
// output and restart data: fix wall/gran of LAMMPS. Errors: those of LAMMPS.

#ifndef LMP_FIX_WALL_GRAN_TALUS_H
#define LMP_FIX_WALL_GRAN_TALUS_H

#include "fix/fix_wall_gran_accelerated.h"
#include "system/lammps_compat.h"

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
  void begin_run() override;
  void add_contacts() override;
  void report_contacts() override;
  std::string what_only_stock_does() const override;
  std::string what_reads_arrays() override
  {
    return "";
  }

 private:
  /// Vector from the wall to a particle, and the radius of the wall there: 0 for planes, negative
  /// on the inside of a cylinder; which of the planes, or -1.
  struct Gap {
    double d[3] = {0.0, 0.0, 0.0}, radius = 0.0;
    int part = -1;
  };
  bool is_cylinder() const
  {
    return wallstyle > 2;
  }
  double phase() const;    // of the oscillation
  double displacement() const;
  Gap gap(const double *x, double radius) const;
  double distance(const double *x) const;
  double radius_of_cylinder() const;
  void place();
  void find_candidates(double moved);
  void clear_history(int i);
  void add_contacts_of(Talus::WallBatch &batch, const Talus::ParticleState &particles, int begin,
                       int end);

  std::vector<Talus::WallBatch> batches;      // by thread
  std::vector<std::pair<int, int>> ranges;    // of candidates, of the last step
  double now[2] = {0.0, 0.0};                 // planes at lo and hi in this step
  double velocity[3] = {0.0, 0.0, 0.0};
  double listed_at = 0.0;    // displacement() when candidates were found
};

}    // namespace LAMMPS_NS

#endif
