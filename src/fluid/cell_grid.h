// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A regular grid along the axes that another program gives: a box with cells of one size, numbered along x fastest. In a
// direction with a period a place is taken in the period that begins where the grid does; where the grid fills it, cells go
// on at the other side.

#ifndef TALUS_FLUID_CELL_GRID_H
#define TALUS_FLUID_CELL_GRID_H

#include "fluid/fluid_cells.h"

#include <string>

namespace Talus {

struct CellGrid {
  /// Corners (length), numbers of cells along x, y, z.
  CellGrid(const double *from, const double *to, const int *number,
           const FluidCells::Periods &of_box);

  /// "" or what is wrong with it, for messages: to be asked before anything else.
  std::string problem() const;

  int size() const { return cells[0] * cells[1] * cells[2]; }
  double volume_of_cell() const { return edge[0] * edge[1] * edge[2]; }
  double place(const double *x, int d) const;
  /// Returns whether it is in the grid.
  bool find_place(const double *x, double (&place_of_x)[3]) const;
  /// Along an axis, of a place; the nearest one if it is outside.
  int cell_of(double place, int d) const;
  /// What a cell along an axis adds to the number of a cell, and that number. It may be beyond the end where the grid goes round.
  int offset_of(int cell, int d) const;
  int number_of(int x, int y, int z) const;

  static constexpr double rounding = 1e-12;
  double lo[3], hi[3], edge[3];
  int cells[3];
  FluidCells::Periods periods;
  bool goes_round[3];    ///< it fills a period
};

}    // namespace Talus

#endif
