// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_energy.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

Vector3<double> lane_of(const double (&v)[3][ContactBatch::width], int k)
{
  return {v[0][k], v[1][k], v[2][k]};
}

/// Normal law and damping of a contact at rest with nothing remembered.
ContactLanes<double> response_of(const ContactLaw &law, const ContactCoefficients &row,
                                 double overlap, double mass_eff, double radius_eff)
{
  ContactLanes<double> s;
  s.overlap = overlap;
  s.mass = mass_eff;
  s.radius = radius_eff;
  for (Stage stage : {Stage::NORMAL, Stage::DAMPING}) {
    double nothing[ContactBatch::history_size] = {};
    law[stage].one(s, law.coefficients(stage, row), nothing, 0.0);
  }
  return s;
}

}    // namespace

ContactEnergy contact_energy(const ContactLaw &law, const ContactCoefficients &row,
                             const ContactState<double> &state, double dt,
                             const RememberedValues &memory)
{
  const ContactLanes<double> s = single_contact(law, row, state, dt, memory);
  const HistoryLayout history = law.history();
  const auto stored = [&](Stage stage) {
    double values[ContactBatch::history_size] = {};
    for (int n = 0; n < law[stage].odd_history + law[stage].even_history; n++)
      values[n] = memory.value[history.of_stage[static_cast<int>(stage)][n]];
    return law[stage].stored(s, law.coefficients(stage, row), values);
  };

  ContactEnergy e;
  e.elastic_normal = stored(Stage::NORMAL) + stored(Stage::COHESION);
  e.damping = (s.normal_force - s.elastic) * s.normal;
  if (law.normal().lasts_beyond_contact) {
    e.damping = s.normal_force * s.normal;
    e.elastic_in_damping = e.elastic_normal;
  }
  if (!law.has_friction()) return e;

  e.friction = s.tangential;
  e.friction_moment = cross(s.normal, s.tangential);
  if (law.tangential().lever_arms) {
    e.friction_torque = s.arm_difference * e.friction_moment;
    e.friction_moment = (1.0 - s.arm_loss) * e.friction_moment;
  }
  e.elastic_tangential = stored(Stage::TANGENTIAL);
  e.elastic_resistance = stored(Stage::ROLLING) + stored(Stage::TWISTING);
  e.rolling_moment = s.moment - e.friction_moment;
  e.resistance_torque = s.twisting_torque - e.friction_torque;
  return e;
}

ContactEnergy lane_energy(const ContactLaw &law, const ContactCoefficients &coefficients,
                          const ContactBatch &b, int k, double dt)
{
  ContactState<double> s;
  s.normal = lane_of(b.normal, k);
  s.overlap = b.overlap[k];
  s.velocity = lane_of(b.velocity, k);
  s.surface_rotation = lane_of(b.surface_rotation, k);
  s.inverse_mass = b.inverse_mass[k];
  s.inverse_radius = b.inverse_radius[k];
  s.relative_omega = lane_of(b.relative_omega, k);
  s.circle = b.circle[k];
  s.inverse_distance = b.inverse_distance[k];
  s.arm_loss = b.arm_loss[k];
  s.arm_difference = b.arm_difference[k];
  RememberedValues memory;
  for (int n = 0; n < ContactBatch::history_size; n++) memory.value[n] = b.history[n][k];
  return contact_energy(law, coefficients, s, dt, memory);
}

double tangent_stiffness(const ContactLaw &law, const ContactCoefficients &row, double overlap,
                         double mass_eff, double radius_eff)
{
  return response_of(law, row, overlap, mass_eff, radius_eff).tangent_n;
}

double damping_ratio(const ContactLaw &law, const ContactCoefficients &row, double overlap,
                     double mass_eff, double radius_eff)
{
  const ContactLanes<double> s = response_of(law, row, overlap, mass_eff, radius_eff);
  return s.tangent_n > 0.0 ? s.gn / (2.0 * std::sqrt(mass_eff * s.tangent_n)) : 0.0;
}

void EnergyAccount::begin_step(int num_particles)
{
  elastic_normal = elastic_in_damping = elastic_tangential = elastic_resistance = 0.0;
  evaluations = std::min(evaluations + 1, 2);
  forces.assign(num_particles, Forces{});
}

void EnergyAccount::add_end(const ContactEnergy &e, int particle, double radius, double sign)
{
  Forces &f = forces[particle];
  f.damping = f.damping + sign * e.damping;
  f.friction = f.friction + sign * e.friction;
  f.friction_torque = f.friction_torque - radius * e.friction_moment + sign * e.friction_torque;
  f.resistance_torque =
      f.resistance_torque - radius * e.rolling_moment + sign * e.resistance_torque;
}

void EnergyAccount::add(const ContactEnergy &e, double share, int first, double first_radius,
                        int second, double second_radius)
{
  if (evaluations == 1) {
    work_normal += share * e.elastic_in_damping;
    work_tangential += share * e.elastic_tangential;
    work_resistance += share * e.elastic_resistance;
  }
  elastic_normal += share * e.elastic_normal;
  elastic_in_damping += share * e.elastic_in_damping;
  elastic_tangential += share * e.elastic_tangential;
  elastic_resistance += share * e.elastic_resistance;
  add_end(e, first, first_radius, 1.0);
  if (second >= 0) add_end(e, second, second_radius, -1.0);
}

void EnergyAccount::move(int particle, double dt, const Vector3<double> &mean_velocity,
                         const Vector3<double> &mean_omega, const Vector3<double> &surface)
{
  const Forces &f = forces[particle];
  work_normal -= dt * dot(f.damping, mean_velocity);
  work_tangential -=
      dt * (dot(f.friction, mean_velocity - surface) + dot(f.friction_torque, mean_omega));
  work_resistance -= dt * dot(f.resistance_torque, mean_omega);
}

}    // namespace Talus
