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
  for (int d = 0; d < 3; d++) std::fill(separation[d], separation[d] + ContactBatch::width, 1.0);
  for (double *lane : {distance, radius, mass, wall_radius})
    std::fill(lane, lane + ContactBatch::width, 1.0);
}

void WallBatch::add(const Contact &c)
{
  const int k = filled++;
  atoms[k] = c.atom;
  parts[k] = c.part;
  histories[k] = c.history;
  distance[k] = c.distance;
  radius[k] = c.radius;
  mass[k] = c.mass;
  wall_radius[k] = c.wall_radius;
  for (int d = 0; d < 3; d++) {
    separation[d][k] = c.separation[d];
    batch.velocity[d][k] = c.velocity[d] - c.wall_velocity[d];
    batch.relative_omega[d][k] = c.omega[d];
  }
  batch.temperature_difference[k] = c.temperature_difference;
  if (account) set_change(k, c);
  if (!c.history) return;
  for (std::size_t n = 0; n < law->history_index.size(); n++)
    if (law->history_index[n] >= 0) batch.history[law->history_index[n]][k] = c.history[n];
}

/* What follows from what was put in, eight at a time. */

void WallBatch::set_lanes(int end)
{
  const Vec8 zero{}, one = splat<Vec8>(1.0);
  for (int k = 0; k < end; k += lanes) {
    const Vec8 r = load8(&radius[k]), length = load8(&distance[k]), wall = load8(&wall_radius[k]);
    for (int d = 0; d < 3; d++) {
      store(&batch.normal[d][k], load8(&separation[d][k]) / length);
      store(&batch.surface_rotation[d][k], r * load8(&batch.relative_omega[d][k]));
    }
    store(&batch.overlap[k], r - length);
    store(&batch.inverse_mass[k], one / load8(&mass[k]));
    const Vec8 flat = one / r;
    store(&batch.inverse_radius[k], select(wall == zero, flat, flat + one / wall));
  }
}

/* The velocity of the wall is that of the time of the positions. */

void WallBatch::set_change(int k, const Contact &c)
{
  for (int d = 0; d < 3; d++) {
    const double of_velocity = c.change ? c.change->c[d] : 0.0,
                 of_rotation = c.change ? c.change->c[4 + d] : 0.0;
    batch.velocity_change[d][k] = of_velocity;
    batch.rotation_change[d][k] = of_rotation;
    batch.omega_change[d][k] = of_rotation / c.radius;
  }
}

/* Lanes behind the last contact hold old ones. */

void WallBatch::run()
{
  if (!filled) return;
  const int end = (filled + lanes - 1) / lanes * lanes;
  set_lanes(end);
  run_laws(batch, 0, 0, end, {law->table, dt, true, account});
  for (int k = 0; k < filled; k++)
    for (std::size_t n = 0; histories[k] && n < law->history_index.size(); n++)
      if (law->history_index[n] >= 0) histories[k][n] = batch.history[law->history_index[n]][k];
  if (account) add_to_account();
  set_torques(end);
  keep_forces(end);
}

void WallBatch::set_torques(int end)
{
  const bool twists = law->law().twists();
  for (int d = 0; d < 3; d++)
    for (int k = 0; k < end; k += lanes) {
      const Vec8 of_force = -load8(&radius[k]) * load8(&batch.torque_per_radius[d][k]);
      store(&torque[d][k], twists ? of_force + load8(&batch.twisting_torque[d][k]) : of_force);
    }
}

void WallBatch::keep_forces(int end)
{
  const std::size_t n = kept / ContactBatch::width;
  if (n == last.size()) last.emplace_back();
  LastForces &forces = last[n];
  std::copy_n(atoms, filled, forces.atoms);
  for (int d = 0; d < 3; d++) {
    std::copy_n(batch.force[d], end, forces.force[d]);
    std::copy_n(batch.torque_per_radius[d], end, forces.torque_per_radius[d]);
    if (law->law().twists()) std::copy_n(batch.twisting_torque[d], end, forces.twisting_torque[d]);
  }
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

void WallBatch::report(ContactData requested,
                       const std::function<void(const ContactReport &)> &visit)
{
  set_lanes((filled + lanes - 1) / lanes * lanes);
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
    found.separation[d] = separation[d][k];
  }
  return found;
}

}    // namespace Talus
