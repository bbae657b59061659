// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fluid/point_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace Talus {
namespace {

constexpr double soft_edge = 1.5;    // of the top hat, in lengths of the cell

}    // namespace

bool PointCells::comes_before(const Cell &a, const Cell &b)
{
  return std::tie(a.x[2], a.x[1], a.x[0], a.volume) < std::tie(b.x[2], b.x[1], b.x[0], b.volume);
}

PointCells::PointCells(const FluidKernel &of_grains, const std::vector<Cell> &given,
                       const Periods &of_box) :
    kernel(of_grains),
    cells(given), periods(of_box)
{
  for (Cell &cell : cells) {
    for (int d = 0; d < 3; d++) cell.x[d] = fold(cell.x[d], d);
    lengths.push_back(std::cbrt(cell.volume));
    longest = std::max(longest, lengths.back());
  }
  sort_into_bins();
}

double PointCells::fold(double x, int d) const
{
  const double period = periods.length[d];
  return period > 0.0 ? x - period * std::floor((x - periods.begin[d]) / period) : x;
}

/* ---- bins ----------------------------------------------------------------------------------- */

int PointCells::bin_along(double x, int d) const
{
  const double bin = std::floor((x - begin[d]) / width_of_bin[d]);
  return static_cast<int>(std::clamp(bin, 0.0, bins[d] - 1.0));
}

/* As long as the longest cell, or as many as there are cells. */

void PointCells::sort_into_bins()
{
  double end[3], volume = 1.0;
  for (int d = 0; d < 3; d++) {
    begin[d] = periods.begin[d];
    end[d] = begin[d] + periods.length[d];
    if (periods.length[d] > 0.0) continue;
    const auto [lowest, highest] = std::minmax_element(
        cells.begin(), cells.end(), [d](const Cell &a, const Cell &b) { return a.x[d] < b.x[d]; });
    begin[d] = lowest->x[d];
    end[d] = std::max(highest->x[d], begin[d] + longest);
  }
  for (int d = 0; d < 3; d++) volume *= end[d] - begin[d];
  const double least = std::max(longest, std::cbrt(volume / static_cast<double>(cells.size())));
  for (int d = 0; d < 3; d++) {
    bins[d] = std::max(1, static_cast<int>((end[d] - begin[d]) / least));
    width_of_bin[d] = (end[d] - begin[d]) / bins[d];
  }
  const auto bin_of = [&](const Cell &cell) {
    return (bin_along(cell.x[2], 2) * bins[1] + bin_along(cell.x[1], 1)) * bins[0] +
           bin_along(cell.x[0], 0);
  };
  first.assign(static_cast<std::size_t>(bins[0]) * bins[1] * bins[2] + 1, 0);
  for (const Cell &cell : cells) first[bin_of(cell) + 1]++;
  for (std::size_t b = 1; b < first.size(); b++) first[b] += first[b - 1];
  std::vector<int> next(first.begin(), first.end() - 1);
  in_bins.resize(cells.size());
  for (int n = 0; n < size(); n++) in_bins[next[bin_of(cells[n])]++] = n;
}

/* Each bin once, across a period too. */

template <class Visit>
void PointCells::for_each_near(const double (&x)[3], double reach, Visit visit) const
{
  int from[3], count[3];
  for (int d = 0; d < 3; d++) {
    const double low = std::floor((x[d] - reach - begin[d]) / width_of_bin[d]),
                 high = std::floor((x[d] + reach - begin[d]) / width_of_bin[d]);
    if (periods.length[d] > 0.0) {
      count[d] = static_cast<int>(std::min(high - low + 1.0, static_cast<double>(bins[d])));
      from[d] = static_cast<int>(low - bins[d] * std::floor(low / bins[d]));
    } else {
      from[d] = static_cast<int>(std::clamp(low, 0.0, bins[d] - 1.0));
      count[d] = static_cast<int>(std::clamp(high, 0.0, bins[d] - 1.0)) - from[d] + 1;
    }
  }
  for (int k = 0; k < count[2]; k++)
    for (int j = 0; j < count[1]; j++)
      for (int i = 0; i < count[0]; i++) {
        const int bin = ((from[2] + k) % bins[2] * bins[1] + (from[1] + j) % bins[1]) * bins[0] +
                        (from[0] + i) % bins[0];
        for (int at = first[bin]; at < first[bin + 1]; at++) visit(in_bins[at]);
      }
}

/* ---- shares --------------------------------------------------------------------------------- */

double PointCells::square_of_distance(const double (&x)[3], int cell) const
{
  double square = 0.0;
  for (int d = 0; d < 3; d++) {
    double along = std::fabs(x[d] - cells[cell].x[d]);
    if (periods.length[d] > 0.0) along = std::min(along, std::fabs(periods.length[d] - along));
    square += along * along;
  }
  return square;
}

double PointCells::raw_share(double square, double ball, int cell) const
{
  const double volume = cells[cell].volume, h = lengths[cell];
  if (kernel.shape == FluidKernel::Shape::GAUSSIAN) {
    const double width = kernel.width * kernel.width + h * h / 6.0;
    if (square >= FluidKernel::cut * FluidKernel::cut * width) return 0.0;
    return volume / (width * std::sqrt(width)) * std::exp(-square / width);
  }
  return volume * std::clamp(1.0 - (std::sqrt(square) - ball) / (soft_edge * h), 0.0, 1.0);
}

bool PointCells::find_shares(const double *given, double radius, std::vector<Share> &shares) const
{
  shares.clear();
  const double x[3] = {fold(given[0], 0), fold(given[1], 1), fold(given[2], 2)},
               ball = kernel.ball(radius),
               reach = kernel.shape == FluidKernel::Shape::GAUSSIAN
                           ? FluidKernel::cut *
                                 std::sqrt(kernel.width * kernel.width + longest * longest / 6.0)
                           : ball + soft_edge * longest;
  for_each_near(x, reach, [&](int cell) {
    const double share = raw_share(square_of_distance(x, cell), ball, cell);
    if (share > 0.0) shares.push_back({cell, share});
  });
  double sum = 0.0;
  for (const Share &share : shares) sum += share.weight;
  for (Share &share : shares) share.weight /= sum;
  return !shares.empty();
}

/* Few grains ask. */

int PointCells::nearest_to(const double *given) const
{
  const double x[3] = {fold(given[0], 0), fold(given[1], 1), fold(given[2], 2)};
  int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (int cell = 0; cell < size(); cell++)
    if (const double square = square_of_distance(x, cell); square < least) {
      least = square;
      nearest = cell;
    }
  return nearest;
}

}    // namespace Talus
