// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall_batch.h"

#include "base/simd.h"
#include "material/contact_spec.h"
#include "material/run_laws.h"

#include "gran_sub_mod.h"
#include "granular_model.h"

#include <algorithm>

namespace Talus {

void WallLaw::take(const Model &model)
{
  const ContactSpec spec = spec_of_model(model);
  table.reset(1);
  table.set(1, 1, spec.law, contact_coefficients(spec, spec, FrictionMix::MINIMUM));
  table.finish();
  history_index = stock_history_of({&model}).value();
  // that a contact has begun comes first
  if (model.beyond_contact && law().has_history() && history_index != std::vector<int>{-1})
    history_index.insert(history_index.begin(), -1);
}

double WallLaw::pulloff_distance(double radius, double wall_radius) const
{
  const double inverse = 1.0 / radius + (wall_radius != 0.0 ? 1.0 / wall_radius : 0.0);
  return pulloff_distance_of(law(), row(), 1.0 / inverse);
}

/* No lane may ever hold what is not finite. */

WallBatch::WallBatch()
{
  batch.clear();
  for (Row &row : rows) row = {{{1.0, 1.0, 1.0, 1.0}}, {{1.0, 1.0, 1.0, 0.0}}, {}};
}

/* What follows from what was put in, eight at a time. Behind the last contact are old ones, with the
   motion of the last particle. */

void WallBatch::set_lanes(const ParticleState &particles)
{
  const Vec8 zero{}, one = splat<Vec8>(1.0);
  for (int k = 0; k < end(); k += lanes) {
    const EightRows geometry = to_lanes([&](int q) -> Record & { return rows[k + q].geometry; }),
                    sizes = to_lanes([&](int q) -> Record & { return rows[k + q].sizes; }),
                    wall = to_lanes([&](int q) -> Record & { return rows[k + q].wall_velocity; });
    const Vec8 length = geometry.number[3], r = sizes.number[0], curvature = sizes.number[2];
    const ParticleState::Motion motion = particles.motion_at(
        [&](int q) { return particles.place(atoms[std::min(k + q, filled - 1)]); }, r, true);
    const Vec8 v[3] = {motion.velocity.x, motion.velocity.y, motion.velocity.z};
    const Vec8 omega[3] = {motion.omega.x, motion.omega.y, motion.omega.z};
    for (int d = 0; d < 3; d++) {
      store(&batch.normal[d][k], geometry.number[d] / length);
      store(&batch.velocity[d][k], v[d] - wall.number[d]);
      store(&batch.relative_omega[d][k], omega[d]);
      store(&batch.surface_rotation[d][k], r * omega[d]);
    }
    store(&radius[k], r);
    store(&batch.overlap[k], r - length);
    store(&batch.inverse_mass[k], one / sizes.number[1]);
    const Vec8 flat = one / r;
    store(&batch.inverse_radius[k], select(curvature == zero, flat, flat + one / curvature));
    store(&batch.temperature_difference[k], sizes.number[3]);
  }
  for (int k = 0; account && k < filled; k++) set_change(k, particles.change(atoms[k]));
}

/* The velocity of the wall is that of the time of the positions. */

void WallBatch::set_change(int k, const ChangeRecord *change)
{
  for (int d = 0; d < 3; d++) {
    const double of_velocity = change ? change->c[d] : 0.0,
                 of_rotation = change ? change->c[4 + d] : 0.0;
    batch.velocity_change[d][k] = of_velocity;
    batch.rotation_change[d][k] = of_rotation;
    batch.omega_change[d][k] = of_rotation / radius[k];
  }
}

void WallBatch::compute(const ParticleState &particles)
{
  if (!filled) return;
  set_lanes(particles);
  run_laws(batch, 0, 0, end(), {law->table, dt, true, account});
  for (int k = 0; k < filled; k++)
    for (std::size_t n = 0; histories[k] && n < law->history_index.size(); n++)
      if (law->history_index[n] >= 0) histories[k][n] = batch.history[law->history_index[n]][k];
  if (account) add_to_account();
  set_torques();
  keep_forces();
  const auto eight = [](const Lanes &of, int k) {
    return EightRows{{load8(&of[0][k]), load8(&of[1][k]), load8(&of[2][k]), Vec8{}}};
  };
  for (int k = 0; k < filled; k += lanes) {
    const EightRows torques = eight(torque, k);
    particles.add_at([&](int q) { return particles.place(atoms[k + q]); },
                     std::min(lanes, filled - k), eight(batch.force, k), &torques);
  }
}

void WallBatch::set_torques()
{
  const bool twists = law->law().twists();
  for (int d = 0; d < 3; d++)
    for (int k = 0; k < end(); k += lanes) {
      const Vec8 of_force = -load8(&radius[k]) * load8(&batch.torque_per_radius[d][k]);
      store(&torque[d][k], twists ? of_force + load8(&batch.twisting_torque[d][k]) : of_force);
    }
}

void WallBatch::keep_forces()
{
  const std::size_t n = kept / ContactBatch::width;
  if (n == last.size()) last.emplace_back();
  LastForces &forces = last[n];
  std::copy_n(atoms, filled, forces.atoms);
  const auto copy = [this](const Lanes &from, Lanes &to) {
    for (int d = 0; d < 3; d++)
      for (int k = 0; k < end(); k += lanes) store(&to[d][k], load8(&from[d][k]));
  };
  copy(batch.force, forces.force);
  copy(batch.torque_per_radius, forces.torque_per_radius);
  if (law->law().twists()) copy(batch.twisting_torque, forces.twisting_torque);
  kept += filled;
}

void WallBatch::add_to_account()
{
  for (int k = 0; k < filled; k++) {
    const EnergyByCause contact_work = work_of_lane(batch, k);
    work += contact_work;
    add_work(*account, atoms[k], contact_work, 1.0);
  }
}

/* A contact that began behind the step has no forces. */

void WallBatch::find_last(int k, ContactReport &found)
{
  if (reported == kept) return;
  const LastForces &forces = last[reported / ContactBatch::width];
  const int lane = static_cast<int>(reported % ContactBatch::width);
  if (forces.atoms[lane] != atoms[k]) return;
  reported++;
  found.force = lane_of(forces.force, lane);
  found.torque_per_radius = lane_of(forces.torque_per_radius, lane);
  if (law->law().twists()) found.twisting_torque = lane_of(forces.twisting_torque, lane);
}

void WallBatch::report(const ParticleState &particles, ContactData requested,
                       const std::function<void(const ContactReport &)> &visit)
{
  set_lanes(particles);
  for (int k = 0; k < filled; k++) {
    HistoryValues history{};
    for (std::size_t n = 0; histories[k] && n < law->history_index.size(); n++)
      if (law->history_index[n] >= 0) history[law->history_index[n]] = histories[k][n];
    const ContactState<double> state = state_of_lane(batch, k);
    ContactReport found;
    found.i = atoms[k];
    found.part = parts[k];
    found.normal = state.normal;
    found.overlap = state.overlap;
    report_contact(law->law(), law->row(), state, dt, history, requested, found);
    find_last(k, found);
    found.set_arms_of_spheres(radius[k], 0.0);
    visit(found);
  }
  filled = 0;
}

WallBatch::Result WallBatch::result(int k) const
{
  Result found;
  found.atom = atoms[k];
  found.heat_flow = law->law().conducts_heat() ? batch.heat_flow[k] : 0.0;
  for (int d = 0; d < 3; d++) {
    found.force[d] = batch.force[d][k];
    found.torque[d] = torque[d][k];
    found.separation[d] = rows[k].geometry.c[d];
  }
  return found;
}

}    // namespace Talus
