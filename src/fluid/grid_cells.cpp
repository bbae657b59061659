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

GridCells::Range GridCells::range(double from, double to, int d) const
{
  double first = std::floor((from - lo[d]) / edge[d]), last = std::floor((to - lo[d]) / edge[d]);
  if (!goes_round[d]) {
    first = std::clamp(first, 0.0, cells[d] - 1.0);
    last = std::clamp(last, first, cells[d] - 1.0);
  }
  return {static_cast<int>(first), static_cast<int>(last - first) + 1};
}

int GridCells::number_of(int x, int y, int z) const
{
  int at[3] = {x, y, z};
  for (int d = 0; d < 3; d++)
    if (goes_round[d]) at[d] = (at[d] % cells[d] + cells[d]) % cells[d];
  return (at[2] * cells[1] + at[1]) * cells[0] + at[0];
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
  Range ranges[3];
  std::vector<double> faces[3];
  constexpr double beyond = 2.0;
  for (int d = 0; d < 3; d++) {
    const Range of_axis = ranges[d] = range(x[d] - radius, x[d] + radius, d);
    for (int k = 0; k <= of_axis.count; k++) {
      const int cell = of_axis.first + k;
      const double face = lo[d] + cell * edge[d];
      const bool of_grid = !goes_round[d] && (cell == 0 || cell == cells[d]);
      const bool outer = !of_grid && (k == 0 || k == of_axis.count);
      faces[d].push_back(outer ? (k ? beyond : -beyond) : (face - x[d]) / radius);
    }
  }
  const int nx = ranges[0].count, ny = ranges[1].count, nz = ranges[2].count;
  if (nx == 1 && ny == 1 && nz == 1) {
    shares.push_back({number_of(ranges[0].first, ranges[1].first, ranges[2].first), 1.0});
    return;
  }
  std::vector<double> below;
  for (const double c : faces[2])
    for (const double b : faces[1])
      for (const double a : faces[0]) below.push_back(ball_below(a, b, c));
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
        shares.push_back(
            {number_of(ranges[0].first + i, ranges[1].first + j, ranges[2].first + k), part});
      }
  for (Share &share : shares) share.weight /= sum;
}

void GridCells::spread_gaussian(const double (&x)[3], std::vector<Share> &shares) const
{
  Range ranges[3];
  std::vector<double> along[3];
  for (int d = 0; d < 3; d++) {
    const double reach = FluidKernel::cut * kernel.width, from = x[d] - reach, to = x[d] + reach;
    const Range of_axis = ranges[d] = range(from, to, d);
    const auto below = [&](double face) {
      return std::erf((std::clamp(face, from, to) - x[d]) / kernel.width);
    };
    for (int k = 0; k < of_axis.count && of_axis.count > 1; k++) {
      const double face = lo[d] + (of_axis.first + k) * edge[d];
      along[d].push_back(std::max(below(face + edge[d]) - below(face), 0.0));
    }
    if (of_axis.count == 1) along[d].push_back(1.0);
    normalize(along[d]);
  }
  for (int k = 0; k < ranges[2].count; k++)
    for (int j = 0; j < ranges[1].count; j++)
      for (int i = 0; i < ranges[0].count; i++)
        shares.push_back({number_of(ranges[0].first + i, ranges[1].first + j, ranges[2].first + k),
                          along[0][i] * along[1][j] * along[2][k]});
}

int GridCells::nearest_to(const double *x) const
{
  int at[3];
  for (int d = 0; d < 3; d++) {
    const double cell = std::floor((place(x, d) - lo[d]) / edge[d]);
    at[d] = static_cast<int>(std::clamp(cell, 0.0, cells[d] - 1.0));
  }
  return number_of(at[0], at[1], at[2]);
}

}    // namespace Talus
