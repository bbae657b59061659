// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Calls that exchange what grains and a fluid do to each other.

#include "coupling/fluid.h"

#include "coupling/calls.h"
#include "coupling/particles.h"
#include "exchange/large_messages.h"
#include "system/host/particles_by_id.h"
#include "system/loads/external_loads.h"

#include "fmt/format.h"
#include "lammps.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;

namespace Talus {

PartnerFluid &fluid_with_cells(talus_partner &partner, bool inside)
{
  PartnerFluid &fluid = fluid_of(partner);
  if (!fluid.grains)
    throw Refusal("the fluid has no cells: call talus_set_fluid_grid() or talus_set_fluid_cells()");
  std::string problem = GrainsInFluid::reason_against(&partner.instance());
  if (problem.empty()) problem = fluid.grains->problem_of_box();
  if (!problem.empty()) throw Refusal(problem);
  if (inside) partner.refuse_if(fluid.grains->problem_of_places());
  return fluid;
}

namespace {

std::string problem_of(const char *what, const double *given, int count, int rank)
{
  if (count && !given) return fmt::format("{} is NULL on rank {}", what, rank);
  for (int k = 0; k < count; k++)
    if (!std::isfinite(given[k]))
      return fmt::format("{}[{}] is no finite number on rank {}", what, k, rank);
  return "";
}

/// `width` numbers for each cell that this rank owns.
std::vector<double> field_of(talus_partner &partner, const PartnerFluid &fluid, const char *what,
                             const double *given, int width)
{
  const int count = width * fluid.num_cells;
  if (fluid.whole) return partner.numbers_of(what, given, count);
  int me;
  MPI_Comm_rank(partner.world(), &me);
  partner.refuse_if(problem_of(what, given, count, me));
  return count ? std::vector<double>(given, given + count) : std::vector<double>();
}

/// Of columns of a table of the owned cells to those who have them.
void give_columns(const talus_partner &partner, const PartnerFluid &fluid, double *to,
                  const std::vector<double> &table, int width, int first, int count)
{
  std::vector<double> columns;
  columns.reserve(table.size() / width * count);
  for (std::size_t row = 0; row < table.size(); row += width)
    for (int k = 0; k < count; k++) columns.push_back(table[row + first + k]);
  if (fluid.whole) {
    columns.resize(static_cast<std::size_t>(fluid.num_cells) * count);
    broadcast(columns.data(), columns.size(), MPI_DOUBLE, 0, partner.world());
  }
  partner.give(to, columns);
}

const PartnerFluid &fluid_with_law(talus_partner &partner)
{
  const PartnerFluid &fluid = fluid_with_cells(partner, true);
  if (!fluid.has_law) throw Refusal("there is no law of drag: call talus_set_drag_law() before");
  return fluid;
}

double above_zero(talus_partner &partner, const char *what, double given)
{
  const double value = partner.number_of(what, given);
  if (!(value > 0.0)) throw Refusal(fmt::format("{} is {:.6g}, expected more than 0", what, value));
  return value;
}

/// Volume that moves becomes the velocity.
void divide_by_solid(std::vector<double> &table)
{
  for (std::size_t row = 0; row < table.size(); row += 4)
    for (int d = 1; d < 4; d++)
      table[row + d] = table[row] > 0.0 ? table[row + d] / table[row] : 0.0;
}

}    // namespace

int call_get_grains(talus_partner *partner, double *solid, double *velocity, double *exchange)
{
  return partner->collective("talus_get_grains", [&] {
    const bool with_solid = partner->is_given(solid != nullptr),
               with_velocity = partner->is_given(velocity != nullptr),
               with_exchange = partner->is_given(exchange != nullptr);
    const PartnerFluid &fluid = fluid_with_cells(*partner, with_solid || with_velocity);
    if (with_solid || with_velocity) {
      std::vector<double> table =
          fluid.grains->find_solid(partner->system().shapes(), with_velocity);
      if (with_velocity) divide_by_solid(table);
      const int width = with_velocity ? 4 : 1;
      if (with_solid) give_columns(*partner, fluid, solid, table, width, 0, 1);
      if (with_velocity) give_columns(*partner, fluid, velocity, table, width, 1, 3);
    }
    if (with_exchange)
      give_columns(
          *partner, fluid, exchange,
          fluid.grains->take_exchange(partner->system().external_loads(), partner->number()), 3, 0,
          3);
  });
}

int call_put_fluid(talus_partner *partner, const double *velocity, const double *pressure_gradient,
                   const double *gravity, const double *vorticity, double *coefficient)
{
  return partner->collective("talus_put_fluid", [&] {
    const PartnerFluid &fluid = fluid_with_law(*partner);
    const bool with_gradient = partner->is_given(pressure_gradient != nullptr),
               with_gravity = partner->is_given(gravity != nullptr),
               with_vorticity = partner->is_given(vorticity != nullptr);
    if (fluid.lift.needs_vorticity() && !with_vorticity)
      throw Refusal("vorticity is NULL, and lift in shear needs it: give the curl of the velocity");
    const std::vector<double> velocities = field_of(*partner, fluid, "velocity", velocity, 3);
    std::vector<double> gradients, curls, acceleration;
    if (with_gradient)
      gradients = field_of(*partner, fluid, "pressure_gradient", pressure_gradient, 3);
    if (with_vorticity) curls = field_of(*partner, fluid, "vorticity", vorticity, 3);
    if (with_gravity) acceleration = partner->numbers_of("gravity", gravity, 3);

    const FluidLoads found = fluid.grains->find_loads(
        partner->system().shapes(), fluid.law, fluid.lift,
        {velocities, with_gradient ? &gradients : nullptr, with_vorticity ? &curls : nullptr,
         fluid.density, fluid.viscosity, with_gravity ? acceleration.data() : nullptr});
    ExternalLoads &loads = loads_of(*partner);
    const ParticlesById dragged(&partner->instance(), found.ids),
        pushed(&partner->instance(), found.pushed), turned(&partner->instance(), found.turned);
    partner->refuse_if(loads.problem_of_drag(dragged, found.coefficient.data()));
    loads.put_drag(partner->number(), dragged, found.coefficient.data(), found.velocity.data());
    loads.put_forces(partner->number(), pushed, found.force.data(), nullptr);
    loads.put_rotational_drag(partner->number(), turned, found.spin_coefficient.data(),
                              found.omega.data());
    if (partner->is_given(coefficient != nullptr))
      give_columns(*partner, fluid, coefficient, fluid.grains->sum_of(found.ids, found.coefficient),
                   1, 0, 1);
  });
}

int call_put_fluid_heat(talus_partner *partner, const char *law, const double *velocity,
                        const double *temperature, double conductivity, double heat_capacity,
                        double *exchange)
{
  return partner->collective("talus_put_fluid_heat", [&] {
    const PartnerFluid &fluid = fluid_with_law(*partner);
    const std::string name = partner->text_of("law", law);
    const auto &names = HeatLaw::names();
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end())
      throw Refusal("law: unknown law of heat '" + name + "', expected " + names[0] + " or " +
                    names[1]);
    const double k = above_zero(*partner, "conductivity", conductivity),
                 capacity = above_zero(*partner, "heat_capacity", heat_capacity);
    require_temperatures(*partner);
    const std::vector<double> velocities = field_of(*partner, fluid, "velocity", velocity, 3),
                              temperatures =
                                  field_of(*partner, fluid, "temperature", temperature, 1);
    const HeatLoads found = fluid.grains->find_heat(
        partner->system().shapes(), HeatLaw(static_cast<int>(known - names.begin())),
        {velocities, temperatures, fluid.density, fluid.viscosity, k, capacity});
    loads_of(*partner).put_heat(partner->number(), ParticlesById(&partner->instance(), found.ids),
                                found.flow.data());
    if (partner->is_given(exchange != nullptr))
      give_columns(*partner, fluid, exchange, fluid.grains->sum_of(found.ids, found.flow), 1, 0, 1);
  });
}

}    // namespace Talus
