// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/cell_grid.h"

#include <algorithm>
#include <cmath>

namespace Talus {

CellGrid::CellGrid(const double *from, const double *to, const int *number,
                   const FluidCells::Periods &of_box) :
    periods(of_box)
{
  for (int d = 0; d < 3; d++) {
    lo[d] = from[d];
    hi[d] = to[d];
    cells[d] = number[d];
    edge[d] = (hi[d] - lo[d]) / cells[d];
    goes_round[d] =
        periods.length[d] > 0.0 && hi[d] - lo[d] >= periods.length[d] * (1.0 - rounding);
  }
}

std::string CellGrid::problem() const
{
  double count = 1.0;
  for (int d = 0; d < 3; d++) {
    const std::string axis(1, "xyz"[d]);
    if (cells[d] < 1)
      return "cells along " + axis + " are " + std::to_string(cells[d]) + ", expected 1 or more";
    if (!(hi[d] > lo[d])) return "hi is not larger than lo along " + axis;
    if (periods.length[d] > 0.0 && hi[d] - lo[d] > periods.length[d] * (1.0 + rounding))
      return "the grid is longer than the period of the box along " + axis;
    count *= cells[d];
  }
  constexpr double most = 1e8;
  return count > most ? "the grid has more than 1e8 cells" : "";
}

double CellGrid::place(const double *x, int d) const
{
  const double period = periods.length[d];
  if (!(period > 0.0)) return x[d];
  const double inside = x[d] - period * std::floor((x[d] - lo[d]) / period);
  return goes_round[d] ? std::clamp(inside, lo[d], hi[d]) : inside;
}

bool CellGrid::find_place(const double *x, double (&place_of_x)[3]) const
{
  for (int d = 0; d < 3; d++) {
    place_of_x[d] = place(x, d);
    if (!(place_of_x[d] >= lo[d] && place_of_x[d] <= hi[d])) return false;
  }
  return true;
}

int CellGrid::cell_of(double place, int d) const
{
  return static_cast<int>(std::clamp(std::floor((place - lo[d]) / edge[d]), 0.0, cells[d] - 1.0));
}

int CellGrid::offset_of(int cell, int d) const
{
  const int at = goes_round[d] ? (cell % cells[d] + cells[d]) % cells[d] : cell;
  return d == 0 ? at : (d == 1 ? at * cells[0] : at * cells[1] * cells[0]);
}

int CellGrid::number_of(int x, int y, int z) const
{
  return offset_of(x, 0) + offset_of(y, 1) + offset_of(z, 2);
}

}    // namespace Talus
