// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/external_loads.h"

#include "base/in_parallel.h"
#include "system/fix_list.h"
#include "system/granular_system.h"
#include "system/system_shapes.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

constexpr const char *fix_id = "TALUS_LOADS";

void copy_row(const double *from, double *to)
{
  std::copy(from, from + 3, to);
}

void add_to_row(double factor, const double *row, double *to)
{
  for (int d = 0; d < 3; d++) to[d] += factor * row[d];
}

bool is_zero(const double *row)
{
  return row[0] == 0.0 && row[1] == 0.0 && row[2] == 0.0;
}

}    // namespace

bool ExternalLoads::Load::is_idle() const
{
  return bits() == 0 && is_zero(for_particles) && is_zero(for_fields);
}

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
  std::vector<Load> kept = std::move(loads);
  if (fix) modify->delete_fix(fix_id);
  modify->add_fix(std::string(fix_id) + " all EXTERNAL_LOADS");
  loads = std::move(kept);
  return true;
}

void ExternalLoads::drop_fix()
{
  fix = nullptr;
  loads = {};
}

bool ExternalLoads::any_has(unsigned some) const
{
  int mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal && !loads.empty(); i++)
    if (loads[i].has(some)) mine = 1;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all != 0;
}

bool ExternalLoads::any() const
{
  return any_has(FORCE | TORQUE | DRAG | HEAT);
}

std::string ExternalLoads::needs_arrays() const
{
  if (system.pipeline().keeps_omega() || !any_has(TORQUE)) return "";
  return "it turns particles and the contacts between them do not";
}

/* ---- what is put ---------------------------------------------------------------------------- */

void ExternalLoads::make_room()
{
  if (loads.empty()) loads.resize(std::max(atom->nmax, 1), Load{});
}

void ExternalLoads::release_if_idle()
{
  const auto end = loads.begin() + std::min<std::size_t>(loads.size(), atom->nlocal);
  if (std::all_of(loads.begin(), end, [](const Load &load) { return load.is_idle(); })) loads = {};
}

void ExternalLoads::put_forces(const ParticlesById &particles, const double *force,
                               const double *torque)
{
  if (particles.size()) make_room();
  for (Load &load : loads) load.unset(FORCE | TORQUE);
  particles.for_each([&](std::size_t k, int i) {
    if (force) copy_row(force + 3 * k, loads[i].force);
    if (torque) copy_row(torque + 3 * k, loads[i].torque);
    loads[i].set((force ? FORCE : 0U) | (torque ? TORQUE : 0U));
  });
  act(Moment::BETWEEN_STEPS);
  release_if_idle();
}

void ExternalLoads::put_drag(const ParticlesById &particles, const double *coefficient,
                             const double *fluid_velocity)
{
  if (particles.size()) make_room();
  for (Load &load : loads) load.unset(DRAG);
  particles.for_each([&](std::size_t k, int i) {
    loads[i].coefficient = coefficient[k];
    copy_row(fluid_velocity + 3 * k, loads[i].fluid_velocity);
    loads[i].set(DRAG);
  });
  act(Moment::BETWEEN_STEPS);
  release_if_idle();
}

void ExternalLoads::put_heat(const ParticlesById &particles, const double *flow)
{
  if (particles.size()) make_room();
  for (Load &load : loads) load.unset(HEAT);
  particles.for_each([&](std::size_t k, int i) {
    loads[i].heat = flow[k];
    loads[i].set(HEAT);
  });
  release_if_idle();
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
    problem = "particle " + std::to_string(atom->tag[i]) +
              " belongs to a clump, whose drag is taken at the present velocity, and coefficient " +
              "times time step is " + std::to_string(ratio) +
              " of its mass, expected 1 or less: use a smaller time step";
  });
  return problem;
}

void ExternalLoads::clear()
{
  if (loads.empty()) return;
  for (Load &load : loads) {
    load.unset(FORCE | TORQUE | DRAG | HEAT);
    for (double *impulse : {load.for_particles, load.for_fields})
      std::fill(impulse, impulse + 3, 0.0);
  }
  act(Moment::BETWEEN_STEPS);
  release_if_idle();
}

void ExternalLoads::take_impulses(const ParticlesById &particles, double *impulse)
{
  if (loads.empty()) return;
  particles.for_each([&](std::size_t k, int i) {
    double *const row = loads[i].for_particles;
    copy_row(row, impulse + 3 * k);
    std::fill(row, row + 3, 0.0);
  });
}

/* ---- what moves particles ------------------------------------------------------------------- */

ExternalLoads::Kick ExternalLoads::kick_of(Fix &integrator, Moment moment) const
{
  const double dt = update->dt;
  const auto *const talus_fix = SystemFix::of(&integrator);
  Kick kick{integrator.groupbit, talus_fix, nullptr, dt, 0.0, dt, nullptr, false, false};
  const bool twice = !talus_fix || talus_fix->kicks().after > 0.0;
  if (talus_fix) {
    kick.time = kick.at_start = dt * talus_fix->next_kick_in_steps();
    kick.gravity = talus_fix->gravity_besides_forces();
    kick.rigid = talus_fix->places_particles() && talus_fix != system.shapes();
  } else if (integrator.rigid_flag) {
    int unused;
    kick.rigid = true;
    kick.body = static_cast<const int *>(integrator.extract("body", unused));
  }
  if (twice) {
    const bool in_step = moment == Moment::STEP;
    kick.at_start = 0.5 * dt;
    kick.at_end = in_step ? 0.5 * dt : 0.0;
    kick.time = in_step ? dt : 0.5 * dt;
    kick.has_read = kick.rigid && !in_step;
  }
  return kick;
}

/* Fix move of LAMMPS gives velocities. */

void ExternalLoads::find_kicks(Moment moment)
{
  kicks.clear();
  frozen_bits = 0;
  for (Fix *one : fix_list(*modify)) {
    if (utils::strmatch(one->style, "^freeze")) frozen_bits |= one->groupbit;
    const auto *const talus_fix = SystemFix::of(one);
    const bool moves = talus_fix ? talus_fix->integrates()
                                 : one->time_integrate && std::strcmp(one->style, "move") != 0;
    if (moves) kicks.push_back(kick_of(*one, moment));
  }
}

const ExternalLoads::Kick *ExternalLoads::kick_of(int i) const
{
  if (atom->mask[i] & frozen_bits) return nullptr;
  for (const Kick &kick : kicks) {
    if (!(atom->mask[i] & kick.group_bits)) continue;
    if (kick.talus_fix ? kick.talus_fix->moves_particle(i) : !kick.body || kick.body[i] >= 0)
      return &kick;
  }
  return nullptr;
}

/* ---- a step --------------------------------------------------------------------------------- */

void ExternalLoads::act(Moment moment)
{
  if (loads.empty()) return;
  find_kicks(moment);
  const ParticleState particles = system.particles();
  in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++)
      if (loads[i].bits()) act_on(i, particles, moment);
  });
}

/* The impulse that has begun a step is counted when the forces that end it are there. */

void ExternalLoads::act_on(int i, const ParticleState &particles, Moment moment)
{
  Load &load = loads[i];
  const Kick *const kick = kick_of(i);
  const bool has_read = kick && kick->has_read;
  if (moment == Moment::BETWEEN_STEPS && has_read) return;
  if (moment == Moment::STEP && load.has(PENDING)) {
    add_to_row(1.0, load.pending, load.for_particles);
    add_to_row(1.0, load.pending, load.for_fields);
  }
  if (moment == Moment::BETWEEN_STEPS && load.has(OTHERS)) {
    copy_row(load.others_force, particles.f(i));
    if (particles.keeps_omega()) copy_row(load.others_torque, particles.torque(i));
  }
  load.unset(OTHERS | PENDING);
  if (load.has(HEAT) && moment == Moment::STEP) atom->heatflow[i] += load.heat;
  if (load.has(FORCE | TORQUE | DRAG) && !has_read) add(i, load, particles, kick, moment);
}

void ExternalLoads::add(int i, Load &load, const ParticleState &particles, const Kick *kick,
                        Moment moment) const
{
  const bool flat = domain->dimension == 2;
  double *const f = particles.f(i);
  copy_row(f, load.others_force);
  double sum[3], drag[3] = {0.0, 0.0, 0.0};
  copy_row(f, sum);
  if (load.has(FORCE)) add_to_row(1.0, load.force, sum);
  if (load.has(DRAG)) {
    find_drag(i, load, particles.v(i), sum, kick, drag);
    if (flat) drag[2] = 0.0;
    const double at_end = kick ? kick->at_end : moment == Moment::STEP ? update->dt : 0.0;
    add_to_row(at_end, drag, load.for_particles);
    add_to_row(at_end, drag, load.for_fields);
    for (int d = 0; d < 3; d++) load.pending[d] = kick ? kick->at_start * drag[d] : 0.0;
    load.set(PENDING);
    add_to_row(1.0, drag, sum);
  }
  if (particles.keeps_omega()) {
    double *const torque = particles.torque(i);
    copy_row(torque, load.others_torque);
    for (int d = flat ? 2 : 0; d < 3 && kick && load.has(TORQUE); d++) torque[d] += load.torque[d];
  }
  load.set(OTHERS);
  for (int d = 0; d < (flat ? 2 : 3) && kick; d++) f[d] = sum[d];
}

void ExternalLoads::find_drag(int i, const Load &load, const double *v, const double *force_row,
                              const Kick *kick, double *drag) const
{
  const double c = load.coefficient, *const u = load.fluid_velocity;
  const bool present = !kick || kick->rigid;
  const double time = present ? 0.0 : kick->time, per_mass = time * force->ftm2v / atom->rmass[i];
  const double implicit = c / (1.0 + per_mass * c);
  for (int d = 0; d < 3; d++) {
    const double fall = !present && kick->gravity ? time * force->ftm2v * kick->gravity[d] : 0.0;
    drag[d] = implicit * (u[d] - (v[d] + (per_mass * force_row[d] + fall)));
  }
}

/* ---- what travels with particles ------------------------------------------------------------ */

void ExternalLoads::grow(int most)
{
  if (!loads.empty()) loads.resize(most, Load{});
}

void ExternalLoads::copy(int from, int to)
{
  if (!loads.empty()) loads[to] = loads[from];
}

void ExternalLoads::forget(int i)
{
  if (!loads.empty()) loads[i] = Load{};
}

/* One number of those that bear nothing. */

int ExternalLoads::pack(int i, double *to) const
{
  if (loads.empty() || loads[i].is_idle()) {
    to[0] = -1.0;
    return 1;
  }
  std::memcpy(to, &loads[i], sizeof(Load));
  return size_packed;
}

int ExternalLoads::unpack(int i, const double *from)
{
  if (from[0] < 0.0) {
    forget(i);
    return 1;
  }
  make_room();
  std::memcpy(&loads[i], from, sizeof(Load));
  return size_packed;
}

}    // namespace Talus
