// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/grid_cells.h"

#include "fluid/ball_parts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

void normalize(std::vector<double> &weights)
{
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  for (double &weight : weights) weight /= sum;
}

}    // namespace

GridCells::GridCells(const FluidKernel &of_grains, const double *lo, const double *hi,
                     const int *cells, const Periods &periods) :
    kernel(of_grains),
    grid(lo, hi, cells, periods)
{
}

std::string GridCells::problem(const FluidKernel &kernel, const double *lo, const double *hi,
                               const int *cells, const Periods &periods)
{
  std::string of_grid = CellGrid(lo, hi, cells, periods).problem();
  if (!of_grid.empty()) return of_grid;
  const double longest = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  return kernel.width > longest ? "the kernel is wider than the grid is long" : "";
}

void GridCells::reach(double from, double to, int d, Axis &axis) const
{
  if (grid.goes_round[d]) {
    const auto cell = [this, d](double x) { return std::floor((x - grid.lo[d]) / grid.edge[d]); };
    axis.first = static_cast<int>(cell(from));
    axis.count = static_cast<int>(cell(to) - cell(from)) + 1;
  } else {
    axis.first = grid.cell_of(from, d);
    axis.count = std::max(grid.cell_of(to, d) - axis.first, 0) + 1;
  }
  axis.offsets.clear();
  axis.values.clear();
  for (int k = 0; k < axis.count; k++) axis.offsets.push_back(grid.offset_of(axis.first + k, d));
}

bool GridCells::find_shares(const double *given, double radius, std::vector<Share> &shares) const
{
  shares.clear();
  double x[3];
  if (!grid.find_place(given, x)) return false;
  if (kernel.shape == FluidKernel::Shape::GAUSSIAN)
    spread_gaussian(x, shares);
  else
    divide_ball(x, kernel.ball(radius), shares);
  return true;
}

/* Parts in cells are differences of those below their faces. The first and the last face are those of the grid, or
   beyond the ball. */

void GridCells::divide_ball(const double (&x)[3], double radius, std::vector<Share> &shares) const
{
  thread_local Axis axes[3];    // memory is kept: there are many grains
  thread_local std::vector<double> below;
  constexpr double beyond = 2.0;
  for (int d = 0; d < 3; d++) {
    Axis &axis = axes[d];
    reach(x[d] - radius, x[d] + radius, d, axis);
    for (int k = 0; k <= axis.count; k++) {
      const int cell = axis.first + k;
      const double face = grid.lo[d] + cell * grid.edge[d];
      const bool of_grid = !grid.goes_round[d] && (cell == 0 || cell == grid.cells[d]);
      const bool outer = !of_grid && (k == 0 || k == axis.count);
      axis.values.push_back(outer ? (k ? beyond : -beyond) : (face - x[d]) / radius);
    }
  }
  const auto &[along_x, along_y, along_z] = axes;
  const int nx = along_x.count, ny = along_y.count, nz = along_z.count;
  if (nx == 1 && ny == 1 && nz == 1) {
    shares.push_back({along_x.offsets[0] + along_y.offsets[0] + along_z.offsets[0], 1.0});
    return;
  }
  below.clear();
  for (const double c : along_z.values)
    for (const double b : along_y.values)
      for (const double a : along_x.values) below.push_back(ball_below(a, b, c));
  const int row = nx + 1, layer = row * (ny + 1);
  double sum = 0.0;
  for (int k = 0; k < nz; k++)
    for (int j = 0; j < ny; j++)
      for (int i = 0; i < nx; i++) {
        const double *const at = &below[k * layer + j * row + i], *const over = at + layer;
        const double part = ((over[row + 1] - over[row]) - (over[1] - over[0])) -
                            ((at[row + 1] - at[row]) - (at[1] - at[0]));
        constexpr double smallest = 1e-14;    // what is less is rounding
        if (part < smallest) continue;
        sum += part;
        shares.push_back({along_x.offsets[i] + along_y.offsets[j] + along_z.offsets[k], part});
      }
  for (Share &share : shares) share.weight /= sum;
}

void GridCells::spread_gaussian(const double (&x)[3], std::vector<Share> &shares) const
{
  thread_local Axis axes[3];
  for (int d = 0; d < 3; d++) {
    Axis &axis = axes[d];
    const double out = FluidKernel::cut * kernel.width, from = x[d] - out, to = x[d] + out;
    reach(from, to, d, axis);
    if (axis.count == 1) {
      axis.values.push_back(1.0);
      continue;
    }
    const auto below = [&](int k) {
      const double face = grid.lo[d] + (axis.first + k) * grid.edge[d];
      return std::erf((std::clamp(face, from, to) - x[d]) / kernel.width);
    };
    double before = below(0);
    for (int k = 0; k < axis.count; k++) {
      const double next = below(k + 1);
      axis.values.push_back(std::max(next - before, 0.0));
      before = next;
    }
    normalize(axis.values);
  }
  const auto &[along_x, along_y, along_z] = axes;
  for (int k = 0; k < along_z.count; k++)
    for (int j = 0; j < along_y.count; j++) {
      const int offset = along_z.offsets[k] + along_y.offsets[j];
      for (int i = 0; i < along_x.count; i++)
        shares.push_back({offset + along_x.offsets[i],
                          along_x.values[i] * along_y.values[j] * along_z.values[k]});
    }
}

int GridCells::nearest_to(const double *x) const
{
  int number = 0;
  for (int d = 0; d < 3; d++) number += grid.offset_of(grid.cell_of(grid.place(x, d), d), d);
  return number;
}

}    // namespace Talus
