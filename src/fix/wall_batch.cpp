// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall_batch.h"

#include "base/simd.h"
#include "material/contact_spec.h"

#include "gran_sub_mod.h"
#include "granular_model.h"

namespace Talus {

void WallLaw::take(const Model &model)
{
  const ContactSpec spec = spec_of_model(model);
  law = spec.law;
  row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
  kernel = contact_kernel(law, true, true);
  places = stock_history_of({&model}).value();
  // that a contact has begun comes first
  if (model.beyond_contact && law.has_history() && places != std::vector<int>{-1})
    places.insert(places.begin(), -1);
}

double WallLaw::reach(double radius, double wall_radius) const
{
  const double inverse = 1.0 / radius + (wall_radius != 0.0 ? 1.0 / wall_radius : 0.0);
  return reach_of(law, row, 1.0 / inverse);
}

void WallBatch::add(const Contact &c)
{
  const int k = filled++;
  atoms[k] = c.atom;
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
  if (!c.history) return;
  for (std::size_t n = 0; n < law->places.size(); n++)
    if (law->places[n] >= 0) batch.history[law->places[n]][k] = c.history[n];
}

/* Lanes behind the last contact hold old ones. */

void WallBatch::run()
{
  if (!filled) return;
  const int end = (filled + lanes - 1) / lanes * lanes;
  law->kernel(batch, 0, end, &law->row, dt);
  for (int k = 0; k < filled; k++)
    for (std::size_t n = 0; histories[k] && n < law->places.size(); n++)
      if (law->places[n] >= 0) histories[k][n] = batch.history[law->places[n]][k];
}

WallBatch::Result WallBatch::result(int k) const
{
  Result its;
  its.atom = atoms[k];
  its.heat_flow = law->law.conducts_heat() ? batch.heat_flow[k] : 0.0;
  for (int d = 0; d < 3; d++) {
    its.force[d] = batch.force[d][k];
    its.torque[d] = -radii[k] * batch.moment[d][k];
    if (law->law.twists()) its.torque[d] += batch.twisting_torque[d][k];
    its.separation[d] = distances[k] * batch.normal[d][k];
  }
  return its;
}

}    // namespace Talus
