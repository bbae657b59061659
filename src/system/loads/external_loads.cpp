// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/external_loads.h"

#include "system/host/fix_list.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "modify.h"

#include <algorithm>
#include <cstring>
#include <tuple>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

constexpr const char *fix_id = "TALUS_LOADS";

void copy_row(const double *from, double *to)
{
  std::copy(from, from + 3, to);
}

void clear_row(double *row)
{
  std::fill(row, row + 3, 0.0);
}

bool is_zero(const double *row)
{
  return row[0] == 0.0 && row[1] == 0.0 && row[2] == 0.0;
}

}    // namespace

/* ---- the fix -------------------------------------------------------------------------------- */

std::string ExternalLoads::reason_against() const
{
  if (!domain->box_exist) return "there is no box yet";
  if (!atom->tag_enable) return "particles have no IDs: remove 'atom_modify id no'";
  if (!atom->radius_flag || !atom->rmass_flag || !atom->torque_flag)
    return "particles have no radius and mass of their own: use 'atom_style sphere'";
  return "";
}

/* LAMMPS calls fixes in the order of their definition. */

bool ExternalLoads::make_fix()
{
  if (!reason_against().empty()) return false;
  const std::vector<Fix *> fixes = fix_list(*modify);
  const auto acts_on_forces = [this](Fix *one) {
    return (modify->get_fix_mask(one) & FixConst::POST_FORCE) != 0;
  };
  const auto place = std::find(fixes.begin(), fixes.end(), fix);
  if (fix && std::none_of(place + 1, fixes.end(), acts_on_forces)) return false;
  const auto kept =
      std::make_tuple(std::move(what), std::move(loads), std::move(rest), std::move(layers));
  if (fix) modify->delete_fix(fix_id);
  modify->add_fix(std::string(fix_id) + " all EXTERNAL_LOADS");
  std::tie(what, loads, rest, layers) = kept;
  set_maxexchange();
  return true;
}

void ExternalLoads::drop_fix()
{
  fix = nullptr;
  resize(0);
}

bool ExternalLoads::any_has(unsigned some) const
{
  int mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal && !what.empty(); i++)
    if (has(i, some)) mine = 1;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all != 0;
}

bool ExternalLoads::any() const
{
  return any_has(KINDS);
}

std::string ExternalLoads::needs_arrays() const
{
  if (system.pipeline().keeps_omega() || !any_has(TORQUE | SPIN)) return "";
  return "it turns particles and the contacts between them do not";
}

/* ---- what is put ---------------------------------------------------------------------------- */

bool ExternalLoads::is_idle(int i) const
{
  return what[i] == 0 && is_zero(loads[i].impulse) && is_zero(rest[i].for_particles) &&
         is_zero(rest[i].for_fields) &&
         std::all_of(layers.begin(), layers.end(),
                     [i](const Layer &layer) { return is_idle(layer[i]); });
}

void ExternalLoads::resize(std::size_t size)
{
  what.resize(size, 0);
  loads.resize(size, Load{});
  rest.resize(size, Rest{});
  for (Layer &layer : layers) layer.resize(size, Part{});
  if (size) return;
  what.shrink_to_fit();
  loads.shrink_to_fit();
  rest.shrink_to_fit();
  for (Layer &layer : layers) layer.shrink_to_fit();
}

void ExternalLoads::make_room()
{
  if (what.empty()) resize(std::max(atom->nmax, 1));
}

void ExternalLoads::release_if_idle()
{
  const int size = std::min(static_cast<int>(what.size()), atom->nlocal);
  for (int i = 0; i < size; i++)
    if (!is_idle(i)) return;
  resize(0);
}

/* put(k, where) for those that are to have some from now on, which returns the kinds. Lists may be those of all
   particles, or of this rank's: all take the place if one does. */

template <class Put>
void ExternalLoads::replace(int partner, unsigned kinds, const ParticlesById &particles, Put put)
{
  int any = particles.size() > 0;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any && place_of(partner) < 0) return;
  const int layer = take_place(partner);
  if (particles.size()) make_room();
  if (what.empty()) return;
  const bool in_sums = (kinds & IN_SUMS) != 0;
  if (in_sums) take_back();    // by what was put before
  unset_kinds(layer, kinds);
  particles.for_each([&](std::size_t k, int i) { set_kinds(layer, i, put(k, place(layer, i))); });
  for (int i = 0; i < atom->nlocal; i++) add_up(i);
  if (in_sums) act(Moment::BETWEEN_STEPS);
  release_if_idle();
}

void ExternalLoads::put_forces(int partner, const ParticlesById &particles, const double *force,
                               const double *torque)
{
  const bool flat = domain->dimension == 2;
  replace(partner, FORCE | TORQUE, particles, [&](std::size_t k, const Place &to) {
    if (force) copy_row(force + 3 * k, to.force);
    if (torque) copy_row(torque + 3 * k, to.torque);
    if (flat) to.force[2] = to.torque[0] = to.torque[1] = 0.0;
    return (force ? FORCE : 0U) | (torque ? TORQUE : 0U);
  });
}

void ExternalLoads::put_drag(int partner, const ParticlesById &particles, const double *coefficient,
                             const double *fluid_velocity)
{
  replace(partner, DRAG, particles, [&](std::size_t k, const Place &to) {
    *to.coefficient = coefficient[k];
    copy_row(fluid_velocity + 3 * k, to.fluid_velocity);
    return DRAG;
  });
}

void ExternalLoads::put_rotational_drag(int partner, const ParticlesById &particles,
                                        const double *coefficient, const double *fluid_omega)
{
  replace(partner, SPIN, particles, [&](std::size_t k, const Place &to) {
    *to.spin_coefficient = coefficient[k];
    copy_row(fluid_omega + 3 * k, to.fluid_omega);
    return SPIN;
  });
}

void ExternalLoads::put_heat(int partner, const ParticlesById &particles, const double *flow)
{
  replace(partner, HEAT, particles, [&](std::size_t k, const Place &to) {
    *to.heat = flow[k];
    return HEAT;
  });
}

/* With less than the sphere's part of the clump's mass, the sum over spheres is less than the mass. */

std::string ExternalLoads::problem_of_drag(const ParticlesById &particles,
                                           const double *coefficient)
{
  find_kicks(Moment::STEP);
  std::string problem;
  particles.for_each([&](std::size_t k, int i) {
    const Kick *const kick = kick_of(i);
    if (!problem.empty() || !kick || !kick->rigid) return;
    const double ratio = coefficient[k] * kick->time * force->ftm2v / atom->rmass[i];
    if (ratio <= 1.0) return;
    problem = fmt::format(
        "particle {} belongs to a clump, whose drag is taken at the present velocity, "
        "and coefficient times time step is {:.6g} of its mass, expected 1 or less: use "
        "a smaller time step",
        atom->tag[i], ratio);
  });
  return problem;
}

void ExternalLoads::clear(int partner)
{
  const int layer = place_of(partner);
  if (layer < 0) return;
  for (int i = 0; i < static_cast<int>(what.size()); i++)
    for (double *const count : {counts_of(layer, i).for_particles, counts_of(layer, i).for_fields})
      clear_row(count);
  replace(partner, KINDS, ParticlesById(lmp, {}), [](std::size_t, const Place &) { return 0U; });
  drop_place(layer);
}

/* For both counts: steps sum one only. */

void ExternalLoads::settle_impulse(int i)
{
  for (double *sum : {rest[i].for_particles, rest[i].for_fields})
    for (int d = 0; d < 3; d++) sum[d] += loads[i].impulse[d];
  clear_row(loads[i].impulse);
}

void ExternalLoads::take_impulses(int partner, const ParticlesById &particles, double *impulse)
{
  const int layer = place_of(partner);
  if (what.empty() || layer < 0) return;
  particles.for_each([&](std::size_t k, int i) {
    double *const count = counts_of(layer, i).for_particles;
    copy_row(count, impulse + 3 * k);
    clear_row(count);
  });
}

double *ExternalLoads::impulse_for_fields(int partner, int i)
{
  const int layer = place_of(partner);
  return what.empty() || layer < 0 ? nullptr : counts_of(layer, i).for_fields;
}

/* ---- what travels with particles ------------------------------------------------------------ */

void ExternalLoads::grow(int most)
{
  if (!what.empty()) resize(most);
}

void ExternalLoads::copy(int from, int to)
{
  if (what.empty()) return;
  what[to] = what[from];
  loads[to] = loads[from];
  rest[to] = rest[from];
  for (Layer &layer : layers) layer[to] = layer[from];
}

void ExternalLoads::forget(int i)
{
  if (what.empty()) return;
  what[i] = 0;
  loads[i] = Load{};
  rest[i] = Rest{};
  for (Layer &layer : layers) layer[i] = Part{};
}

/* One number of those that bear nothing. */

int ExternalLoads::pack(int i, double *to) const
{
  if (what.empty() || is_idle(i)) {
    to[0] = -1.0;
    return 1;
  }
  to[0] = what[i];
  std::memcpy(to + 1, &loads[i], sizeof(Load));
  std::memcpy(to + 1 + sizeof(Load) / sizeof(double), &rest[i], sizeof(Rest));
  double *next = to + size_packed;
  for (const Layer &layer : layers) {
    std::memcpy(next, &layer[i], sizeof(Part));
    next += size_part;
  }
  return most_packed();
}

int ExternalLoads::unpack(int i, const double *from)
{
  if (from[0] < 0.0) {
    forget(i);
    return 1;
  }
  make_room();
  what[i] = static_cast<unsigned char>(from[0]);
  std::memcpy(&loads[i], from + 1, sizeof(Load));
  std::memcpy(&rest[i], from + 1 + sizeof(Load) / sizeof(double), sizeof(Rest));
  const double *next = from + size_packed;
  for (Layer &layer : layers) {
    std::memcpy(&layer[i], next, sizeof(Part));
    next += size_part;
  }
  return most_packed();
}

double ExternalLoads::memory_usage() const
{
  return static_cast<double>(what.capacity() + loads.capacity() * sizeof(Load) +
                             rest.capacity() * (sizeof(Rest) + layers.size() * sizeof(Part)));
}

}    // namespace Talus
