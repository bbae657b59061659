// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Cells of a fluid that are those of a grid (fluid/cell_grid.h). A grain is in it if its center is. Both kernels are
// integrated exactly over cells: the ball of the top hat is cut by their faces (fluid/ball_parts.h), the Gaussian is a product
// of error functions, each up to 3 widths.

#ifndef TALUS_FLUID_GRID_CELLS_H
#define TALUS_FLUID_GRID_CELLS_H

#include "fluid/cell_grid.h"
#include "fluid/fluid_kernel.h"

#include <string>

namespace Talus {

class GridCells : public FluidCells {
 public:
  /// Corners (length) and numbers of cells along x, y, z; numbers of cells run along x fastest.
  GridCells(const FluidKernel &kernel, const double *lo, const double *hi, const int *cells,
            const Periods &periods);

  /// "" or what is wrong with these, for messages. To be asked before a grid is made of them.
  static std::string problem(const FluidKernel &kernel, const double *lo, const double *hi,
                             const int *cells, const Periods &periods);

  int size() const override { return grid.size(); }
  double volume(int) const override { return grid.volume_of_cell(); }
  bool find_shares(const double *x, double radius, std::vector<Share> &shares) const override;
  int nearest_to(const double *x) const override;

 private:
  /// Cells along one axis that a kernel reaches: the first one, before the grid goes round; what each adds to the number
  /// of a cell; and values of cells, or of the faces between them.
  struct Axis {
    int first, count;
    std::vector<int> offsets;
    std::vector<double> values;
  };
  void reach(double from, double to, int d, Axis &axis) const;
  void divide_ball(const double (&x)[3], double radius, std::vector<Share> &shares) const;
  void spread_gaussian(const double (&x)[3], std::vector<Share> &shares) const;

  FluidKernel kernel;
  CellGrid grid;
};

}    // namespace Talus

#endif
