// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Grains in a fluid that a partner computes (talus.h): what grains are and give on its cells, and what its fields do to
// grains. Both ways go through the same shares (fluid/fluid_cells.h), so that
//
//   field of a cell = sum over grains of share * amount / volume of the cell
//   fluid at a grain = sum over its cells of share * value
//
// and nothing is lost between grains and cells. Every rank knows all cells, which are found by their numbers, and has the
// values of its own. Fields have the same bits on any number of ranks, whatever the division of grains and cells.

#ifndef TALUS_SYSTEM_LOADS_GRAINS_IN_FLUID_H
#define TALUS_SYSTEM_LOADS_GRAINS_IN_FLUID_H

#include "base/linear_algebra.h"
#include "exchange/owner_exchange.h"
#include "fluid/drag_law.h"
#include "fluid/fluid_cells.h"
#include "fluid/grain_shares.h"
#include "fluid/heat_law.h"
#include "fluid/lift_law.h"

#include "pointers.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Talus {

class ExternalLoads;
class ShapedParticles;
class ShapeShadows;

/// What the cells of this rank have, in the order of places, 3 each. Gradient of the pressure, vorticity: nullptr for none.
struct FluidFields {
  const std::vector<double> &velocity, *pressure_gradient, *vorticity;
  double density, viscosity;
  const double *gravity;    ///< of the buoyancy; nullptr: that is in the gradient, or left out
};

/// Of particles of this rank with drag, by ID, forces on them: none, or 3 each, and drag of their rotation. Lift L is in the
/// velocity of drag, u + L/c, so that its impulses are counted with those of drag.
struct FluidLoads {
  std::vector<std::int64_t> ids;
  std::vector<double> coefficient, velocity;
  std::vector<std::int64_t> pushed;
  std::vector<double> force;
  std::vector<std::int64_t> turned;
  std::vector<double> spin_coefficient, omega;

  void add_drag(std::int64_t id, double c, const Vector3<double> &u)
  {
    ids.push_back(id);
    coefficient.push_back(c);
    velocity.insert(velocity.end(), {u.x, u.y, u.z});
  }
  void add_force(std::int64_t id, const Vector3<double> &f)
  {
    pushed.push_back(id);
    force.insert(force.end(), {f.x, f.y, f.z});
  }
  void add_rotation(std::int64_t id, double c, const Vector3<double> &of_fluid)
  {
    turned.push_back(id);
    spin_coefficient.push_back(c);
    omega.insert(omega.end(), {of_fluid.x, of_fluid.y, of_fluid.z});
  }
};

/// What the cells of this rank have for heat, in the order of places: velocity 3 each.
struct FluidHeat {
  const std::vector<double> &velocity, &temperature;
  double density, viscosity, conductivity, heat_capacity;    ///< the last one per mass
};

/// Power into particles of this rank, by ID.
struct HeatLoads {
  std::vector<std::int64_t> ids;
  std::vector<double> flow;
};

class GrainsInFluid : protected LAMMPS_NS::Pointers {
 public:
  /// Of the box as it is now.
  static FluidCells::Periods periods_of(const LAMMPS_NS::Domain &domain);
  /// "" or why this instance cannot, for messages; the same on all ranks.
  static std::string reason_against(LAMMPS_NS::LAMMPS *lmp);

  /// Collective, the same cells and homes on all ranks. `group`: bits of the grains that are in the fluid.
  GrainsInFluid(LAMMPS_NS::LAMMPS *lmp, std::unique_ptr<FluidCells> all_cells,
                std::vector<OwnerExchange::Home> homes, int group, MPI_Comm ranks);

  /// Of this rank.
  int num_cells() const { return exchange.num_owned(); }

  // ---- between runs

  /// To be asked first: "", or why the box is another one than that of the cells; and of this rank, which grain is
  /// outside of them.
  std::string problem_of_box() const;
  std::string problem_of_places();
  /// Collective. Solid fraction of the cells of this rank, and with `moving` the volume that moves, per volume and
  /// time, 3 each behind it.
  std::vector<double> find_solid(const ShapedParticles *shapes, bool moving);
  /// Collective. Impulse of the drag that this partner has put, since the last call, per volume of cells (3 each). That
  /// of grains which have left the cells, or the group, counts too.
  std::vector<double> take_exchange(ExternalLoads &loads, int partner);
  /// Collective. What these fields do to grains with their present velocities.
  FluidLoads find_loads(const ShapedParticles *shapes, const DragLaw &law, const LiftLaw &lift,
                        const FluidFields &fields);
  /// Collective. What this fluid gives grains with their present velocities and temperatures, which they have.
  HeatLoads find_heat(const ShapedParticles *shapes, const HeatLaw &law, const FluidHeat &fields);
  /// Collective. Sum per volume of the cells of this rank of what particles have, by ID, in the order of particles.
  std::vector<double> sum_of(const std::vector<std::int64_t> &ids,
                             const std::vector<double> &values);

 private:
  /// amounts(i, values) says what a particle has, and returns whether it counts.
  using Amounts = std::function<bool(int i, double *values)>;

  bool is_in_group(int i) const;
  void update_shares();
  void tell_shape(const ShapedParticles *shapes, int i, const Vector3<double> &slip,
                  ShapeShadows &shadows, GrainInFluid &grain) const;
  struct FluidAtGrain {
    double porosity;
    Vector3<double> velocity{}, pressure_gradient{}, vorticity{};
  };
  std::vector<FluidAtGrain> fluid_at_grains(const std::vector<double> &solid,
                                            const FluidFields &fields);
  std::vector<double> solid_for(bool needed, const ShapedParticles *shapes);
  std::vector<double> sum(int width, const Amounts &amounts);
  std::vector<double> values_at_grains(const std::vector<double> &of_cells, int width);

  std::unique_ptr<FluidCells> cells;
  std::vector<int> own_cells;    // number of each place
  OwnerExchange exchange;
  GrainShares shares;
  FluidCells::Periods periods;
  int group_bits;
};

}    // namespace Talus

#endif
