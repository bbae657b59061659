// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Fields of particles on a grid of the partner.

#include "coupling/calls.h"
#include "coupling/partner.h"

#include "system/host/particle_volume.h"
#include "system/loads/external_loads.h"
#include "system/loads/grid_field.h"

#include "atom.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

GridField grid_of(talus_partner &partner, const double *lo, const double *hi, const int *cells,
                  double width)
{
  const std::vector<double> first = partner.numbers_of("lo", lo, 3),
                            last = partner.numbers_of("hi", hi, 3);
  partner.refuse_if(partner.lives_here() && !cells ? "cells is NULL" : "");
  std::vector<std::int64_t> given(3);
  if (partner.lives_here()) std::copy(cells, cells + 3, given.begin());
  given = partner.integers_of("cells", given.data(), 3);
  const int number[3] = {static_cast<int>(given[0]), static_cast<int>(given[1]),
                         static_cast<int>(given[2])};
  const double of_kernel = partner.number_of("width", width);
  const GridField grid(&partner.instance(), first.data(), last.data(), number, of_kernel);
  const std::string problem = grid.problem();
  if (!problem.empty()) throw Refusal(problem);
  return grid;
}

/// Those columns of a table, in order.
std::vector<double> columns_of(const std::vector<double> &table, int width, int first, int count)
{
  std::vector<double> columns;
  columns.reserve(table.size() / width * count);
  for (std::size_t at = first; at < table.size(); at += width)
    columns.insert(columns.end(), table.begin() + static_cast<std::int64_t>(at),
                   table.begin() + static_cast<std::int64_t>(at) + count);
  return columns;
}

}    // namespace

/* Impulses of particles outside of the grid stay. */

int call_get_field(talus_partner *partner, const double *lo, const double *hi, const int *cells,
                   double width, double *solid, double *momentum, double *exchange)
{
  return partner->collective("talus_get_field", [&] {
    const GridField grid = grid_of(*partner, lo, hi, cells, width);
    const Atom &atom = *partner->instance().atom;
    if (!atom.radius_flag || !atom.rmass_flag)
      throw Refusal("particles have no radius and mass of their own: use 'atom_style sphere'");
    const ShapedParticles *const shapes = partner->system().shapes();
    ExternalLoads &loads = partner->system().external_loads();
    const bool with_solid = partner->has("solid", solid),
               with_momentum = partner->has("momentum", momentum),
               with_exchange = partner->has("exchange", exchange);

    const int of_momentum = with_solid ? 1 : 0, of_exchange = of_momentum + (with_momentum ? 3 : 0),
              width_of_table = of_exchange + (with_exchange ? 3 : 0);
    if (width_of_table == 0) return;
    const std::vector<double> table = grid.smear(width_of_table, [&](int i, double *amount) {
      if (with_solid) amount[0] = particle_volume(atom, shapes, i);
      for (int d = 0; d < 3 && with_momentum; d++)
        amount[of_momentum + d] = atom.rmass[i] * atom.v[i][d];
      const double *const impulse =
          with_exchange ? loads.impulse_for_fields(partner->number(), i) : nullptr;
      for (int d = 0; d < 3 && with_exchange; d++)
        amount[of_exchange + d] = impulse ? impulse[d] : 0.0;
    });
    for (int i = 0; i < atom.nlocal && with_exchange; i++)
      if (double *const impulse = loads.impulse_for_fields(partner->number(), i);
          impulse && grid.has(i))
        std::fill(impulse, impulse + 3, 0.0);
    if (with_solid) partner->give(solid, columns_of(table, width_of_table, 0, 1));
    if (with_momentum) partner->give(momentum, columns_of(table, width_of_table, of_momentum, 3));
    if (with_exchange) partner->give(exchange, columns_of(table, width_of_table, of_exchange, 3));
  });
}

}    // namespace Talus
