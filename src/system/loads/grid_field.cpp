// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/grid_field.h"

#include "base/scaled_sum.h"

#include "atom.h"
#include "domain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

constexpr double rounding = 1e-12;

}    // namespace

GridField::GridField(LAMMPS *lmp, const double *from, const double *to, const int *number,
                     double of_kernel) :
    Pointers(lmp),
    width(of_kernel)
{
  for (int d = 0; d < 3; d++) {
    lo[d] = from[d];
    hi[d] = to[d];
    cells[d] = number[d];
    edge[d] = (hi[d] - lo[d]) / cells[d];
    goes_round[d] = domain->periodicity[d] && hi[d] - lo[d] >= domain->prd[d] * (1.0 - rounding);
  }
}

std::string GridField::problem() const
{
  if (domain->dimension != 3 || domain->triclinic)
    return "fields need 'dimension 3' and a box that is not triclinic";
  double count = 1.0;
  for (int d = 0; d < 3; d++) {
    const char axis = "xyz"[d];
    if (cells[d] < 1)
      return fmt::format("cells along {} are {}, expected 1 or more", axis, cells[d]);
    if (!(hi[d] > lo[d])) return fmt::format("hi is not larger than lo along {}", axis);
    if (domain->periodicity[d] && hi[d] - lo[d] > domain->prd[d] * (1.0 + rounding))
      return fmt::format("the grid is longer than the period of the box along {}", axis);
    if (width != 0.0 && !(width >= edge[d]))
      return fmt::format(
          "width is {:.6g}, less than the edge {:.6g} of cells along {}: take a larger "
          "one, or 0 for particles that are in one cell each",
          width, edge[d], axis);
    count *= cells[d];
  }
  constexpr double most = 1e8;
  return count > most ? "the grid has more than 1e8 cells" : "";
}

/* In periods as the grid. */

std::array<double, 3> GridField::place_of(int i) const
{
  std::array<double, 3> x{};
  for (int d = 0; d < 3; d++) {
    x[d] = atom->x[i][d];
    if (!domain->periodicity[d]) continue;
    const double period = domain->prd[d];
    x[d] -= period * std::floor((x[d] - lo[d]) / period);
    if (goes_round[d] && x[d] > hi[d]) x[d] = hi[d];    // rounding
  }
  return x;
}

bool GridField::contains(const std::array<double, 3> &x) const
{
  for (int d = 0; d < 3; d++)
    if (!(x[d] >= lo[d] && x[d] <= hi[d])) return false;
  return true;
}

bool GridField::has(int i) const
{
  return contains(place_of(i));
}

std::size_t GridField::number_of(const int (&cell)[3]) const
{
  int in_grid[3];
  for (int d = 0; d < 3; d++) {
    const int n = cells[d];
    in_grid[d] = goes_round[d] ? (cell[d] % n + n) % n : cell[d];
  }
  return (static_cast<std::size_t>(in_grid[2]) * cells[1] + in_grid[1]) * cells[0] + in_grid[0];
}

template <class Visit>
void GridField::for_each_share(CoarseKernel &kernel, const std::array<double, 3> &x,
                               Visit visit) const
{
  if (width == 0.0) {
    int cell[3];
    for (int d = 0; d < 3; d++)
      cell[d] = std::min(static_cast<int>((x[d] - lo[d]) / edge[d]), cells[d] - 1);
    visit(number_of(cell), 1.0 / volume_of_cell());
    return;
  }
  for (const CoarseKernel::Share &share : kernel.of_point({x[0], x[1], x[2]}))
    visit(number_of(share.cell), share.weight);
}

/* No weight is larger than one over the volume of a cell. */

std::vector<double> GridField::largest_amounts(int values, const Amounts &amounts) const
{
  std::vector<double> largest(values, 0.0), of_one(values);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has(i)) continue;
    amounts(i, of_one.data());
    for (int k = 0; k < values; k++) largest[k] = std::max(largest[k], std::fabs(of_one[k]));
  }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), values, MPI_DOUBLE, MPI_MAX, world);
  return largest;
}

std::vector<double> GridField::smear(int values, const Amounts &amounts) const
{
  std::vector<SumScale> scales;
  for (const double largest : largest_amounts(values, amounts))
    scales.emplace_back(largest * (1.0 + rounding) / volume_of_cell());
  CoarseKernel::Ends ends{};
  for (int d = 0; d < 3; d++) {
    ends.first[d] = goes_round[d] ? -CoarseKernel::endless : 0;
    ends.last[d] = goes_round[d] ? CoarseKernel::endless : cells[d] - 1;
  }
  CoarseKernel kernel({lo[0], lo[1], lo[2]}, {edge[0], edge[1], edge[2]}, width, ends);

  const std::size_t count = static_cast<std::size_t>(cells[0]) * cells[1] * cells[2] * values;
  std::vector<ScaledSum> sums(count);
  std::vector<double> of_one(values);
  for (int i = 0; i < atom->nlocal; i++) {
    const std::array<double, 3> x = place_of(i);
    if (!contains(x)) continue;
    amounts(i, of_one.data());
    for_each_share(kernel, x, [&](std::size_t cell, double weight) {
      for (int k = 0; k < values; k++) scales[k].add(weight * of_one[k], sums[values * cell + k]);
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(2 * count), MPI_INT64_T, MPI_SUM,
                world);
  std::vector<double> field(count);
  for (std::size_t n = 0; n < count; n++) field[n] = scales[n % values].value(sums[n]);
  return field;
}

}    // namespace Talus
