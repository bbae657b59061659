// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What particles have, as a field on a grid that another program gives (fluid/cell_grid.h). A particle whose center is in the grid is smeared over its cells with the kernel of
// compute coarse/grid (coarse_kernel.h), or all of it is in the cell of its center with width 0. All
// that it has is in cells of the grid: at a border the kernel is cut and what is left of it scaled up;
// along a period that the grid fills it goes on at the other side. Sums have the same bits on any
// number of ranks.

#ifndef TALUS_SYSTEM_LOADS_GRID_FIELD_H
#define TALUS_SYSTEM_LOADS_GRID_FIELD_H

#include "fluid/cell_grid.h"
#include "system/loads/coarse_kernel.h"

#include "pointers.h"

#include <functional>
#include <string>
#include <vector>

namespace Talus {

class GridField : protected LAMMPS_NS::Pointers {
 public:
  /// Corners (length), numbers of cells, width of the kernel (length). The box is that of now.
  GridField(LAMMPS_NS::LAMMPS *lmp, const double *lo, const double *hi, const int *cells,
            double width);

  /// "" or what is wrong with the grid, for messages; the same on all ranks. To be asked first.
  std::string problem() const;

  /// The center of an owned particle is in the grid (local index).
  bool has(int i) const;
  /// amounts(i, values) says what an owned particle has. Returns the sums of all ranks over the volume
  /// of a cell: `values` numbers for each cell, along x fastest. Collective; memory of 24 bytes for
  /// each number.
  using Amounts = std::function<void(int, double *)>;
  std::vector<double> smear(int values, const Amounts &amounts) const;

 private:
  std::vector<double> largest_amounts(int values, const Amounts &amounts) const;
  /// visit(cell, weight) for those that a particle at x is in.
  template <class Visit>
  void for_each_share(CoarseKernel &kernel, const double (&x)[3], Visit visit) const;

  CellGrid grid;
  double width;
};

}    // namespace Talus

#endif
