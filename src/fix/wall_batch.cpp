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
  places = stock_history_of({&model}).value();
  // that a contact has begun comes first
  if (model.beyond_contact && law().has_history() && places != std::vector<int>{-1})
    places.insert(places.begin(), -1);
}

double WallLaw::reach(double radius, double wall_radius) const
{
  const double inverse = 1.0 / radius + (wall_radius != 0.0 ? 1.0 / wall_radius : 0.0);
  return reach_of(law(), row(), 1.0 / inverse);
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
  for (std::size_t n = 0; n < law->places.size(); n++)
    if (law->places[n] >= 0) batch.history[law->places[n]][k] = c.history[n];
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
    for (std::size_t n = 0; histories[k] && n < law->places.size(); n++)
      if (law->places[n] >= 0) histories[k][n] = batch.history[law->places[n]][k];
  if (account) add_to_account();
  set_torques(end);
  keep_forces(end);
}

void WallBatch::set_torques(int end)
{
  const bool twists = law->law().twists();
  for (int d = 0; d < 3; d++)
    for (int k = 0; k < end; k += lanes) {
      const Vec8 its = -load8(&radius[k]) * load8(&batch.moment[d][k]);
      store(&torque[d][k], twists ? its + load8(&batch.twisting_torque[d][k]) : its);
    }
}

void WallBatch::keep_forces(int end)
{
  const std::size_t n = kept / ContactBatch::width;
  if (n == last.size()) last.emplace_back();
  LastForces &its = last[n];
  std::copy_n(atoms, filled, its.atoms);
  for (int d = 0; d < 3; d++) {
    std::copy_n(batch.force[d], end, its.force[d]);
    std::copy_n(batch.moment[d], end, its.moment[d]);
    if (law->law().twists()) std::copy_n(batch.twisting_torque[d], end, its.twisting_torque[d]);
  }
  kept += filled;
}

void WallBatch::add_to_account()
{
  for (int k = 0; k < filled; k++) {
    const EnergyByCause its = work_of_lane(batch, k);
    work += its;
    add_work(*account, atoms[k], its, 1.0);
  }
}

/* A contact that began behind the step has no forces. */

void WallBatch::find_last(int k, SurveyedContact &found)
{
  if (surveyed == kept) return;
  const LastForces &its = last[surveyed / ContactBatch::width];
  const int lane = static_cast<int>(surveyed % ContactBatch::width);
  if (its.atoms[lane] != atoms[k]) return;
  surveyed++;
  found.force = lane_of(its.force, lane);
  found.moment = lane_of(its.moment, lane);
  if (law->law().twists()) found.twisting_torque = lane_of(its.twisting_torque, lane);
}

void WallBatch::survey(Ask ask, const std::function<void(const SurveyedContact &)> &visit)
{
  set_lanes((filled + lanes - 1) / lanes * lanes);
  for (int k = 0; k < filled; k++) {
    HistoryValues memory{};
    for (std::size_t n = 0; histories[k] && n < law->places.size(); n++)
      if (law->places[n] >= 0) memory[law->places[n]] = histories[k][n];
    const ContactState<double> state = state_of_lane(batch, k);
    SurveyedContact found;
    found.i = atoms[k];
    found.part = parts[k];
    found.normal = state.normal;
    found.overlap = state.overlap;
    survey_contact(law->law(), law->row(), state, dt, memory, ask, found);
    find_last(k, found);
    found.set_arms_of_spheres(radius[k], 0.0);
    visit(found);
  }
  filled = 0;
}

WallBatch::Result WallBatch::result(int k) const
{
  Result its;
  its.atom = atoms[k];
  its.heat_flow = law->law().conducts_heat() ? batch.heat_flow[k] : 0.0;
  for (int d = 0; d < 3; d++) {
    its.force[d] = batch.force[d][k];
    its.torque[d] = torque[d][k];
    its.separation[d] = separation[d][k];
  }
  return its;
}

}    // namespace Talus
