// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/grid_cells.h"

#include "fluid/ball_parts.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

constexpr double rounding = 1e-12, most_cells = 1e8;

void normalize(std::vector<double> &weights)
{
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  for (double &weight : weights) weight /= sum;
}

}    // namespace

GridCells::GridCells(const FluidKernel &of_grains, const double *from, const double *to,
                     const int *number, const Periods &of_box) :
    kernel(of_grains),
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

std::string GridCells::problem(const FluidKernel &kernel, const double *lo, const double *hi,
                               const int *cells, const Periods &periods)
{
  double count = 1.0, longest = 0.0;
  for (int d = 0; d < 3; d++) {
    const std::string axis(1, "xyz"[d]);
    if (cells[d] < 1)
      return "cells along " + axis + " are " + std::to_string(cells[d]) + ", expected 1 or more";
    if (!(hi[d] > lo[d])) return "hi is not larger than lo along " + axis;
    if (periods.length[d] > 0.0 && hi[d] - lo[d] > periods.length[d] * (1.0 + rounding))
      return "the grid is longer than the period of the box along " + axis;
    count *= cells[d];
    longest = std::max(longest, hi[d] - lo[d]);
  }
  if (kernel.width > longest) return "the kernel is wider than the grid is long";
  return count > most_cells ? "the grid has more than 1e8 cells" : "";
}

/* In the period that begins where the grid does. */

double GridCells::place(const double *x, int d) const
{
  const double period = periods.length[d];
  if (!(period > 0.0)) return x[d];
  const double inside = x[d] - period * std::floor((x[d] - lo[d]) / period);
  return goes_round[d] ? std::clamp(inside, lo[d], hi[d]) : inside;
}

void GridCells::reach(double from, double to, int d, Axis &axis) const
{
  double first = std::floor((from - lo[d]) / edge[d]), last = std::floor((to - lo[d]) / edge[d]);
  if (!goes_round[d]) {
    first = std::clamp(first, 0.0, cells[d] - 1.0);
    last = std::clamp(last, first, cells[d] - 1.0);
  }
  axis.first = static_cast<int>(first);
  axis.count = static_cast<int>(last - first) + 1;
  axis.offsets.clear();
  axis.values.clear();
  for (int k = 0; k < axis.count; k++) axis.offsets.push_back(offset_of(axis.first + k, d));
}

int GridCells::offset_of(int cell, int d) const
{
  const int at = goes_round[d] ? (cell % cells[d] + cells[d]) % cells[d] : cell;
  return d == 0 ? at : (d == 1 ? at * cells[0] : at * cells[1] * cells[0]);
}

bool GridCells::find_shares(const double *given, double radius, std::vector<Share> &shares) const
{
  shares.clear();
  double x[3];
  for (int d = 0; d < 3; d++) {
    x[d] = place(given, d);
    if (!(x[d] >= lo[d] && x[d] <= hi[d])) return false;
  }
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
      const double face = lo[d] + cell * edge[d];
      const bool of_grid = !goes_round[d] && (cell == 0 || cell == cells[d]);
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
      const double face = lo[d] + (axis.first + k) * edge[d];
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
  for (int d = 0; d < 3; d++) {
    const double cell = std::floor((place(x, d) - lo[d]) / edge[d]);
    number += offset_of(static_cast<int>(std::clamp(cell, 0.0, cells[d] - 1.0)), d);
  }
  return number;
}

}    // namespace Talus
