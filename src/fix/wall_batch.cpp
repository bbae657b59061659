// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall_batch.h"

#include "base/simd.h"
#include "material/contact_spec.h"
#include "material/run_laws.h"

#include "gran_sub_mod.h"
#include "granular_model.h"

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

void WallBatch::add(const Contact &c)
{
  const int k = filled++;
  atoms[k] = c.atom;
  parts[k] = c.part;
  histories[k] = c.history;
  distances[k] = c.distance;
  radii[k] = c.radius;
  for (int d = 0; d < 3; d++) {
    batch.normal[d][k] = c.separation[d] / c.distance;
    batch.velocity[d][k] = c.velocity[d] - c.wall_velocity[d];
    batch.surface_rotation[d][k] = c.radius * c.omega[d];
    batch.relative_omega[d][k] = c.omega[d];
  }
  batch.overlap[k] = c.radius - c.distance;
  batch.inverse_mass[k] = 1.0 / c.mass;
  batch.inverse_radius[k] = 1.0 / c.radius;
  if (c.wall_radius != 0.0) batch.inverse_radius[k] += 1.0 / c.wall_radius;
  batch.temperature_difference[k] = c.temperature_difference;
  if (account) set_change(k, c);
  if (!c.history) return;
  for (std::size_t n = 0; n < law->places.size(); n++)
    if (law->places[n] >= 0) batch.history[law->places[n]][k] = c.history[n];
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
  run_laws(batch, 0, 0, end, {law->table, dt, true, account});
  for (int k = 0; k < filled; k++)
    for (std::size_t n = 0; histories[k] && n < law->places.size(); n++)
      if (law->places[n] >= 0) histories[k][n] = batch.history[law->places[n]][k];
  if (account) add_to_account();
  keep_forces();
}

void WallBatch::keep_forces()
{
  const bool twists = law->law().twists();
  for (int k = 0; k < filled; k++)
    last.push_back({atoms[k], lane_of(batch.force, k), lane_of(batch.moment, k),
                    twists ? lane_of(batch.twisting_torque, k) : Vector3<double>{0.0, 0.0, 0.0}});
}

void WallBatch::add_to_account()
{
  for (int k = 0; k < filled; k++) {
    const EnergyByCause its = work_of_lane(batch, k);
    work += its;
    add_work(*account, atoms[k], its, 1.0);
  }
}

void WallBatch::survey(Ask ask, const std::function<void(const SurveyedContact &)> &visit)
{
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
    if (surveyed < last.size() && last[surveyed].atom == atoms[k]) {
      const LastForce &its = last[surveyed++];
      found.force = its.force;
      found.moment = its.moment;
      found.twisting_torque = its.twisting_torque;
    }
    found.set_arms_of_spheres(radii[k], 0.0);
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
    its.torque[d] = -radii[k] * batch.moment[d][k];
    if (law->law().twists()) its.torque[d] += batch.twisting_torque[d][k];
    its.separation[d] = distances[k] * batch.normal[d][k];
  }
  return its;
}

}    // namespace Talus
