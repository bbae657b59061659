// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/grains_in_fluid.h"

#include "base/scaled_sum.h"
#include "system/host/particle_volume.h"
#include "system/loads/external_loads.h"
#include "system/loads/shape_shadows.h"

#include "atom.h"
#include "domain.h"
#include "force.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

constexpr double rounding = 1e-12;
/// Of laws: in cells smaller than grains there may be no fluid at all.
constexpr double least_porosity = 0.1;

double diameter_of(double volume)
{
  constexpr double pi = 3.14159265358979323846;
  return std::cbrt(6.0 / pi * volume);
}

Vector3<double> vector(const double *row)
{
  return {row[0], row[1], row[2]};
}

std::vector<int> numbers_by_place(const std::vector<OwnerExchange::Home> &homes, MPI_Comm ranks)
{
  int me;
  MPI_Comm_rank(ranks, &me);
  std::vector<int> numbers;
  for (std::size_t n = 0; n < homes.size(); n++) {
    if (homes[n].rank != me) continue;
    if (homes[n].place >= static_cast<int>(numbers.size())) numbers.resize(homes[n].place + 1);
    numbers[homes[n].place] = static_cast<int>(n);
  }
  return numbers;
}

}    // namespace

FluidCells::Periods GrainsInFluid::periods_of(const Domain &domain)
{
  FluidCells::Periods periods{};
  for (int d = 0; d < 3; d++) {
    if (!domain.periodicity[d]) continue;
    periods.begin[d] = domain.boxlo[d];
    periods.length[d] = domain.prd[d];
  }
  return periods;
}

std::string GrainsInFluid::reason_against(LAMMPS *lmp)
{
  if (!lmp->domain->box_exist) return "there is no box yet";
  if (lmp->domain->dimension != 3 || lmp->domain->triclinic)
    return "a fluid needs 'dimension 3' and a box that is not triclinic";
  if (!lmp->atom->radius_flag || !lmp->atom->rmass_flag)
    return "particles have no radius and mass of their own: use 'atom_style sphere'";
  if (lmp->force->ftm2v != 1.0)
    return "drag needs units in which force is mass times length over time squared: use 'units "
           "si', "
           "cgs, lj, micro or nano";
  return "";
}

GrainsInFluid::GrainsInFluid(LAMMPS *lmp, std::unique_ptr<FluidCells> all_cells,
                             std::vector<OwnerExchange::Home> homes, int group, MPI_Comm ranks) :
    Pointers(lmp),
    cells(std::move(all_cells)), own_cells(numbers_by_place(homes, ranks)),
    exchange(ranks, std::move(homes)), shares(*cells), periods(periods_of(*Pointers::domain)),
    group_bits(group)
{
}

bool GrainsInFluid::is_in_group(int i) const
{
  return (atom->mask[i] & group_bits) != 0;
}

std::string GrainsInFluid::problem_of_box() const
{
  const FluidCells::Periods now = periods_of(*domain);
  return now.begin == periods.begin && now.length == periods.length
             ? ""
             : "the period of the box is another one than when the cells were given: give them "
               "again";
}

/* Between two calls grains may have moved or not: they are asked, which costs little. */

void GrainsInFluid::update_shares()
{
  std::vector<GrainShares::Grain> grains(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const x = atom->x[i];
    grains[i] = {{x[0], x[1], x[2]}, atom->radius[i], is_in_group(i)};
  }
  shares.update(std::move(grains));
}

std::string GrainsInFluid::problem_of_places()
{
  update_shares();
  const int i = shares.first_outside();
  if (i < 0) return "";
  const double *const x = atom->x[i];
  return fmt::format(
      "particle {} at {:.6g} {:.6g} {:.6g} is outside of the cells of the fluid: give cells that "
      "cover the grains, points with a wider kernel, or a group of those in the fluid with the "
      "word group of the kernel",
      atom->tag[i], x[0], x[1], x[2]);
}

/* ---- from grains to cells ------------------------------------------------------------------- */

/* No share is larger than one, but for rounding. */

std::vector<double> GrainsInFluid::sum(int width, const Amounts &amounts)
{
  std::vector<double> largest(width, 0.0), of_one(width);
  for (int i = 0; i < atom->nlocal; i++)
    if (amounts(i, of_one.data()))
      for (int k = 0; k < width; k++) largest[k] = std::max(largest[k], std::fabs(of_one[k]));
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), width, MPI_DOUBLE, MPI_MAX, world);
  std::vector<SumScale> scales;
  for (const double bound : largest) scales.emplace_back(bound * (1.0 + rounding));

  update_shares();
  std::vector<ScaledSum> sums(shares.touched_cells().size() * width);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!amounts(i, of_one.data())) continue;
    shares.for_each(i, [&](int slot, double share) {
      const std::size_t first = static_cast<std::size_t>(slot) * width;
      if (first == sums.size()) sums.resize(first + width);
      for (int k = 0; k < width; k++) scales[k].add(share * of_one[k], sums[first + k]);
    });
  }
  const std::vector<ScaledSum> totals = exchange.to_owners(shares.touched_cells(), sums, width);
  std::vector<double> field(totals.size());
  for (std::size_t n = 0; n < totals.size(); n++)
    field[n] = scales[n % width].value(totals[n]) / cells->volume(own_cells[n / width]);
  return field;
}

std::vector<double> GrainsInFluid::find_solid(const ShapedParticles *shapes, bool moving)
{
  return sum(moving ? 4 : 1, [&](int i, double *amount) {
    if (!is_in_group(i)) return false;
    amount[0] = particle_volume(*atom, shapes, i);
    for (int d = 0; d < 3 && moving; d++) amount[1 + d] = amount[0] * atom->v[i][d];
    return true;
  });
}

std::vector<double> GrainsInFluid::take_exchange(ExternalLoads &loads, int partner)
{
  const std::vector<double> field = sum(3, [&](int i, double *amount) {
    const double *const impulse = loads.impulse_for_fields(partner, i);
    if (!impulse) return false;
    std::copy(impulse, impulse + 3, amount);
    return impulse[0] != 0.0 || impulse[1] != 0.0 || impulse[2] != 0.0;
  });
  for (int i = 0; i < atom->nlocal; i++)
    if (double *const impulse = loads.impulse_for_fields(partner, i))
      std::fill(impulse, impulse + 3, 0.0);
  return field;
}

std::vector<double> GrainsInFluid::sum_of(const std::vector<std::int64_t> &ids,
                                          const std::vector<double> &values)
{
  std::vector<double> of_particle(atom->nlocal, 0.0);
  std::size_t next = 0;
  for (int i = 0; i < atom->nlocal && next < ids.size(); i++)
    if (atom->tag[i] == ids[next]) of_particle[i] = values[next++];
  return sum(1, [&](int i, double *amount) {
    amount[0] = of_particle[i];
    return amount[0] != 0.0;
  });
}

/* ---- from cells to grains ------------------------------------------------------------------- */

/* Of all particles of this rank, 0 of those not in the group. */

std::vector<double> GrainsInFluid::values_at_grains(const std::vector<double> &of_cells, int width)
{
  update_shares();
  const std::vector<double> near = exchange.from_owners(shares.touched_cells(), of_cells, width);
  std::vector<double> values(static_cast<std::size_t>(atom->nlocal) * width, 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_in_group(i)) continue;
    double *const to = &values[static_cast<std::size_t>(i) * width];
    shares.for_each(i, [&](int slot, double share) {
      const double *const from = &near[static_cast<std::size_t>(slot) * width];
      for (int k = 0; k < width; k++) to[k] += share * from[k];
    });
  }
  return values;
}

std::vector<double> GrainsInFluid::solid_for(bool needed, const ShapedParticles *shapes)
{
  return needed ? find_solid(shapes, false) : std::vector<double>(num_cells(), 0.0);
}

/* Seen along the slip, or where there is none along x. */

void GrainsInFluid::tell_shape(const ShapedParticles *shapes, int i, const Vector3<double> &slip,
                               ShapeShadows &shadows, GrainInFluid &grain) const
{
  const int type = atom->type[i];
  if (!shapes || !shapes->is_shaped(type)) return;
  const ParticleShape &shape = *shapes->table().of(type);
  const double *const turned = shapes->orientations()[i];
  grain.sphericity = shadows.sphericity(type, shape);
  if (std::all_of(turned, turned + 4, [](double q) { return q == 0.0; })) return;    // none yet
  const Vector3<double> along = grain.speed > 0.0 ? slip : Vector3<double>{1.0, 0.0, 0.0};
  grain.crosswise = shadows.crosswise(type, shape, turned, along);
}

/* Pressure gradient and vorticity are 0 where there are none. */

std::vector<GrainsInFluid::FluidAtGrain>
GrainsInFluid::fluid_at_grains(const std::vector<double> &solid, const FluidFields &fields)
{
  const std::vector<double> *const vectors[] = {&fields.velocity, fields.pressure_gradient,
                                                fields.vorticity};
  std::vector<double> of_cells;
  int width = 1;
  for (const auto *field : vectors) width += field ? 3 : 0;
  for (int n = 0; n < num_cells(); n++) {
    of_cells.push_back(1.0 - solid[n]);
    for (const auto *field : vectors)
      if (field) of_cells.insert(of_cells.end(), &(*field)[3 * n], &(*field)[3 * n] + 3);
  }
  const std::vector<double> at_grains = values_at_grains(of_cells, width);
  std::vector<FluidAtGrain> found(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    const double *next = &at_grains[static_cast<std::size_t>(i) * width];
    found[i].porosity = std::clamp(*next++, least_porosity, 1.0);
    Vector3<double> *const to[] = {&found[i].velocity, &found[i].pressure_gradient,
                                   &found[i].vorticity};
    for (int k = 0; k < 3; k++) {
      if (!vectors[k]) continue;
      *to[k] = vector(next);
      next += 3;
    }
  }
  return found;
}

FluidLoads GrainsInFluid::find_loads(const ShapedParticles *shapes, const DragLaw &law,
                                     const LiftLaw &lift, const FluidFields &fields)
{
  const std::vector<FluidAtGrain> fluid =
      fluid_at_grains(solid_for(law.depends_on_porosity(), shapes), fields);
  const Vector3<double> hydrostatic =
      fields.gravity ? fields.density * vector(fields.gravity) : Vector3<double>{0.0, 0.0, 0.0};
  FluidLoads loads;
  ShapeShadows shadows;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_in_group(i)) continue;
    const FluidAtGrain &here = fluid[i];
    const double volume = particle_volume(*atom, shapes, i);
    const Vector3<double> slip = here.velocity - vector(atom->v[i]);
    GrainInFluid grain{diameter_of(volume), length(slip), here.porosity, fields.density,
                       fields.viscosity};
    if (law.depends_on_shape()) tell_shape(shapes, i, slip, shadows, grain);
    const double c = law.coefficient(grain);
    const std::int64_t tag = atom->tag[i];
    if (lift.any()) {
      const TurningGrain turning{grain.diameter, slip,           vector(atom->omega[i]),
                                 here.vorticity, fields.density, fields.viscosity};
      if (c > 0.0) loads.add_drag(tag, c, here.velocity + (1.0 / c) * lift.force(turning));
      if (lift.drags_rotation() && !(shapes && shapes->is_shaped(atom->type[i])))
        loads.add_rotation(tag, LiftLaw::rotation_coefficient(turning), 0.5 * here.vorticity);
    } else if (c > 0.0) {
      loads.add_drag(tag, c, here.velocity);
    }
    if (fields.pressure_gradient || fields.gravity)
      loads.add_force(tag, -volume * (here.pressure_gradient + hydrostatic));
  }
  return loads;
}

HeatLoads GrainsInFluid::find_heat(const ShapedParticles *shapes, const HeatLaw &law,
                                   const FluidHeat &fields)
{
  constexpr double pi = 3.14159265358979323846;
  const std::vector<double> solid = solid_for(law.depends_on_porosity(), shapes);
  std::vector<double> of_cells;
  for (int n = 0; n < num_cells(); n++) {
    const double *const u = &fields.velocity[3 * n];
    of_cells.insert(of_cells.end(), {1.0 - solid[n], u[0], u[1], u[2], fields.temperature[n]});
  }
  const std::vector<double> at_grains = values_at_grains(of_cells, 5);
  const double prandtl = fields.heat_capacity * fields.viscosity / fields.conductivity;

  HeatLoads loads;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_in_group(i)) continue;
    const double *const at = &at_grains[static_cast<std::size_t>(i) * 5];
    const double d = diameter_of(particle_volume(*atom, shapes, i));
    const double nusselt =
        law.nusselt({d, length(vector(at + 1) - vector(atom->v[i])),
                     std::clamp(at[0], least_porosity, 1.0), fields.density, fields.viscosity},
                    prandtl);
    loads.ids.push_back(atom->tag[i]);
    loads.flow.push_back(nusselt * pi * d * fields.conductivity * (at[4] - atom->temperature[i]));
  }
  return loads;
}

}    // namespace Talus
