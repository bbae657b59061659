// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Cells of a fluid that are points with volumes: those of any mesh, tetrahedra or hexahedra. Their shape is not known; a
// cell of volume V counts as h = V^(1/3) long. The raw share of a grain at the distance r is
//
//   top hat    V min(1, max(0, 1 - (r - R)/(1.5 h)))      R the radius of the ball
//   Gaussian   V/b^3 exp(-r^2/b^2), r < 3 b               b^2 = width^2 + h^2/6: that of the Gaussian, and of a cube
//
// and shares are these over their sum. 1.5 h is more than from the center of a tetrahedron or a cube to its corners, so
// that grains much smaller than cells are always in some: a grain of which no cell has a share is outside.

#ifndef TALUS_FLUID_POINT_CELLS_H
#define TALUS_FLUID_POINT_CELLS_H

#include "fluid/fluid_cells.h"
#include "fluid/fluid_kernel.h"

#include <vector>

namespace Talus {

class PointCells : public FluidCells {
 public:
  struct Cell {
    double x[3];
    double volume;
  };
  /// At least one, in order (comes_before()), which the order of shares follows; volumes are above 0.
  PointCells(const FluidKernel &kernel, const std::vector<Cell> &cells, const Periods &periods);
  /// An order of cells that depends on nothing else.
  static bool comes_before(const Cell &a, const Cell &b);

  int size() const override { return static_cast<int>(cells.size()); }
  double volume(int cell) const override { return cells[cell].volume; }
  bool find_shares(const double *x, double radius, std::vector<Share> &shares) const override;
  int nearest_to(const double *x) const override;

 private:
  double square_of_distance(const double (&x)[3], int cell) const;
  double raw_share(double square, double ball, int cell) const;
  double fold(double x, int d) const;
  int bin_along(double x, int d) const;
  void sort_into_bins();
  template <class Visit> void for_each_near(const double (&x)[3], double reach, Visit visit) const;

  FluidKernel kernel;
  std::vector<Cell> cells;        // in the period of the box
  std::vector<double> lengths;    // h
  double longest = 0.0;
  Periods periods;
  // bins of equal size over a box around all points, or the period
  double begin[3], width_of_bin[3];
  int bins[3];
  std::vector<int> first, in_bins;    // cells of bin b: in_bins[first[b]] to before first[b+1]
};

}    // namespace Talus

#endif
