// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Values on a distributed grid of LAMMPS, added to by ranks whose particles are near: also to
// cells that others own. LAMMPS' grids talk to fixes only, so this is one, though no script ever
// sees it.

#ifndef TALUS_COMPUTE_GRID_SUM_H
#define TALUS_COMPUTE_GRID_SUM_H

#include "fix.h"
#include "grid3d.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class GridSum : public Fix {
 public:
  /// `reach`: how far outside its sub-domain a rank adds (length). The box is that of now.
  GridSum(LAMMPS *lmp, const int (&cells)[3], int values, double reach);

  int setmask() override { return 0; }
  Grid3d *lammps_grid() const { return grid.get(); }
  /// First and last cell of each direction: owned, and those that may be added to.
  const int *owned_lo() const { return in_lo; }
  const int *owned_hi() const { return in_hi; }
  const int *lo() const { return out_lo; }
  const int *hi() const { return out_hi; }

  void clear();
  bool has(const int (&cell)[3]) const;
  double *at(int x, int y, int z) { return &data[num_values * offset(x, y, z)]; }
  /// Collective: owned cells then have what all ranks have added.
  void add_up();

  void pack_reverse_grid(int, void *, int, int *) override;
  void unpack_reverse_grid(int, void *, int, int *) override;
  double memory_usage() override;

 private:
  std::size_t offset(int x, int y, int z) const;

  int num_values;
  std::unique_ptr<Grid3d> grid;
  int in_lo[3], in_hi[3], out_lo[3], out_hi[3];
  std::vector<double> data, send_buffer, receive_buffer;
};

}    // namespace LAMMPS_NS

#endif
