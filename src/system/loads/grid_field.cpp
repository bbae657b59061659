// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/grid_field.h"

#include "base/scaled_sum.h"
#include "system/loads/grains_in_fluid.h"

#include "atom.h"
#include "domain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace LAMMPS_NS;

namespace Talus {

GridField::GridField(LAMMPS *lmp, const double *lo, const double *hi, const int *cells,
                     double of_kernel) :
    Pointers(lmp),
    grid(lo, hi, cells, GrainsInFluid::periods_of(*domain)), width(of_kernel)
{
}

std::string GridField::problem() const
{
  if (domain->dimension != 3 || domain->triclinic)
    return "fields need 'dimension 3' and a box that is not triclinic";
  const std::string of_grid = grid.problem();
  if (!of_grid.empty()) return of_grid;
  for (int d = 0; d < 3; d++)
    if (width != 0.0 && !(width >= grid.edge[d]))
      return fmt::format(
          "width is {:.6g}, less than the edge {:.6g} of cells along {}: take a larger "
          "one, or 0 for particles that are in one cell each",
          width, grid.edge[d], "xyz"[d]);
  return "";
}

bool GridField::has(int i) const
{
  double x[3];
  return grid.find_place(atom->x[i], x);
}

template <class Visit>
void GridField::for_each_share(CoarseKernel &kernel, const double (&x)[3], Visit visit) const
{
  if (width == 0.0) {
    visit(grid.number_of(grid.cell_of(x[0], 0), grid.cell_of(x[1], 1), grid.cell_of(x[2], 2)),
          1.0 / grid.volume_of_cell());
    return;
  }
  for (const CoarseKernel::Share &share : kernel.of_point({x[0], x[1], x[2]}))
    visit(grid.number_of(share.cell[0], share.cell[1], share.cell[2]), share.weight);
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
    scales.emplace_back(largest * (1.0 + CellGrid::rounding) / grid.volume_of_cell());
  CoarseKernel::Ends ends{};
  for (int d = 0; d < 3; d++) {
    ends.first[d] = grid.goes_round[d] ? -CoarseKernel::endless : 0;
    ends.last[d] = grid.goes_round[d] ? CoarseKernel::endless : grid.cells[d] - 1;
  }
  const auto &lo = grid.lo, &edge = grid.edge;
  CoarseKernel kernel({lo[0], lo[1], lo[2]}, {edge[0], edge[1], edge[2]}, width, ends);

  const std::size_t count = static_cast<std::size_t>(grid.size()) * values;
  std::vector<ScaledSum> sums(count);
  std::vector<double> of_one(values);
  for (int i = 0; i < atom->nlocal; i++) {
    double x[3];
    if (!grid.find_place(atom->x[i], x)) continue;
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
