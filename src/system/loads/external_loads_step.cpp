// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/loads/external_loads.h"

#include "base/in_parallel.h"
#include "system/host/fix_list.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

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

void add_to_row(double factor, const double *row, double *to)
{
  for (int d = 0; d < 3; d++) to[d] += factor * row[d];
}

}    // namespace

/* ---- what moves particles ------------------------------------------------------------------- */

ExternalLoads::Kick ExternalLoads::kick_of(Fix &integrator, Moment moment) const
{
  const bool in_step = moment == Moment::STEP;
  const auto *const talus_fix = SystemFix::of(&integrator);
  Kick kick{integrator.groupbit, talus_fix, nullptr, 0.0, 0.0, 0.0, nullptr, false, false};
  if (talus_fix) {
    kick.gravity = talus_fix->gravity_besides_forces();
    kick.rigid = talus_fix->places_particles() &&
                 !(system.shapes() && system.shapes()->command() == &integrator);
  } else if (integrator.rigid_flag) {
    int unused;
    kick.rigid = true;
    kick.body = static_cast<const int *>(integrator.extract("body", unused));
  }
  const double dt = update->dt;
  const Kicks kicks = talus_fix ? talus_fix->kicks() : Kicks{0.5, 0.5};
  const bool twice = kicks.after > 0.0;
  kick.time = dt * (!twice ? talus_fix->next_kick_in_steps() : in_step ? 1.0 : 0.5);
  kick.has_read = twice && kick.rigid && !in_step;
  if (in_step) {
    kick.at_start = kicks.before * dt;
    kick.at_end = kicks.after * dt;
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
  if (what.empty()) return;
  if (moment == Moment::BETWEEN_STEPS && !update->first_update) return;    // there are no sums yet
  if (moment != Moment::STEP) take_back();
  constexpr int ahead = 12;
  find_kicks(moment);
  const ParticleState particles = system.step().particles();
  const int last = atom->nlocal - 1;
  in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      const int soon = std::min(i + ahead, last);
      if (what[soon]) particles.prefetch_for_contact(particles.place(soon));
      if (what[i]) act_on(i, particles, moment);
    }
  });
}

/* Drag that begins a step is counted when the forces that end it are there. */

void ExternalLoads::act_on(int i, const ParticleState &particles, Moment moment)
{
  const Kick *const kick = kick_of(i);
  const bool has_read = kick && kick->has_read;
  if (moment == Moment::BETWEEN_STEPS && has_read) return;
  if (moment == Moment::STEP && has(i, DUE) && kick) count_drag(i, kick->at_start);
  unset(i, ADDED | DUE);
  if (has(i, HEAT) && moment == Moment::STEP) atom->heatflow[i] += rest[i].heat;
  if (has(i, IN_SUMS) && !has_read) add(i, particles, kick, moment);
}

/* There may be an act between steps before they are there. */

void ExternalLoads::sums_begin_anew()
{
  for (int i = 0; i < static_cast<int>(what.size()); i++) unset(i, ADDED | DUE);
}

/* Between steps, what was added to these sums. */

void ExternalLoads::take_back()
{
  find_kicks(Moment::BETWEEN_STEPS);
  const ParticleState particles = system.step().particles();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has(i, ADDED)) continue;
    const Kick *const kick = kick_of(i);
    if (kick && kick->has_read) continue;
    if (has(i, DRAG)) add_to_row(-1.0, loads[i].drag, particles.f(i));
    if (has(i, FORCE)) add_to_row(-1.0, loads[i].force, particles.f(i));
    if (has(i, SPIN) && kick && !kick->rigid)
      add_to_row(-1.0, rest[i].spin_drag, particles.torque(i));
    if (has(i, TORQUE)) add_to_row(-1.0, rest[i].torque, particles.torque(i));
    unset(i, ADDED);
  }
}

/* Particles that nothing moves bear drag, but their forces stay as they are. */

void ExternalLoads::add(int i, const ParticleState &particles, const Kick *kick, Moment moment)
{
  Load &load = loads[i];
  double *const f = particles.f(i);
  double sum[3] = {f[0], f[1], f[2]};
  if (has(i, FORCE)) add_to_row(1.0, load.force, sum);
  if (has(i, DRAG)) {
    find_drag(i, particles.v(i), sum, kick);
    if (moment == Moment::STEP) count_drag(i, kick ? kick->at_end : update->dt);
    add_to_row(1.0, load.drag, sum);
  }
  if (!kick) return;
  std::copy(sum, sum + 3, f);
  if (has(i, TORQUE)) add_to_row(1.0, rest[i].torque, particles.torque(i));
  if (has(i, SPIN) && !kick->rigid) {
    find_spin_drag(i, particles.w(i), particles.torque(i), *kick);
    add_to_row(1.0, rest[i].spin_drag, particles.torque(i));
  }
  set(i, ADDED | (has(i, DRAG) ? DUE : 0U));
}

void ExternalLoads::find_drag(int i, const double *v, const double *force_row, const Kick *kick)
{
  Load &load = loads[i];
  const double c = load.coefficient, *const u = load.fluid_velocity;
  const bool present = !kick || kick->rigid;
  const double time = present ? 0.0 : kick->time * force->ftm2v, per_mass = time / atom->rmass[i];
  const double implicit = c / (1.0 + per_mass * c);
  const double *const g = present ? nullptr : kick->gravity;
  for (int d = 0; d < 3; d++)
    load.drag[d] = implicit * (u[d] - (v[d] + (per_mass * force_row[d] + (g ? time * g[d] : 0.0))));
  if (domain->dimension == 2) load.drag[2] = 0.0;
}

/* In three dimensions, of spheres. */

void ExternalLoads::find_spin_drag(int i, const double *omega, const double *torque_row,
                                   const Kick &kick)
{
  Rest &own = rest[i];
  const double radius = atom->radius[i],
               per_inertia = kick.time * force->ftm2v / (0.4 * atom->rmass[i] * radius * radius);
  const double c = own.spin_coefficient, implicit = c / (1.0 + per_inertia * c);
  for (int d = 0; d < 3; d++)
    own.spin_drag[d] = implicit * (own.fluid_omega[d] - (omega[d] + per_inertia * torque_row[d]));
}

}    // namespace Talus
