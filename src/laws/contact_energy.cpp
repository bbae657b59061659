// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_energy.h"

#include <cmath>

namespace Talus {
namespace {

/// Normal law and damping of a contact at rest, without history.
ContactLanes<double> at_rest(const ContactLaw &law, const ContactCoefficients &row, double overlap,
                             double mass_eff, double radius_eff)
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

void report_contact(const ContactLaw &law, const ContactCoefficients &row,
                    const ContactState<double> &state, double dt, const HistoryValues &history,
                    ContactData requested, ContactReport &to)
{
  const Stage last = requested == ContactData::ALL ? Stage::HEAT : Stage::NORMAL;
  const ContactLanes<double> s = single_contact(law, row, state, dt, history, last);
  const HistoryLayout layout = law.history();
  const auto stored = [&](Stage stage) {
    double values[ContactBatch::history_size] = {};
    for (int n = 0; n < law[stage].odd_history + law[stage].even_history; n++)
      values[n] = history[layout.of_stage[static_cast<int>(stage)][n]];
    return law[stage].stored(s, law.coefficients(stage, row), values);
  };
  to.force = s.force;
  to.torque_per_radius = s.torque_per_radius;
  to.twisting_torque = s.twisting_torque;
  to.history = history;
  to.stored = EnergyByCause{};
  if (s.separated > 0.0) return;    // the overlap and the springs are those of the last step
  if (law.reaches() && s.overlap < 0.0) return;
  to.stored.normal = stored(Stage::NORMAL) + stored(Stage::COHESION);
  if (law.whole_force_works()) to.stored.detaching = to.stored.normal;
  if (!law.has_friction()) return;
  to.stored.tangential = stored(Stage::TANGENTIAL);
  to.stored.resistance = stored(Stage::ROLLING) + stored(Stage::TWISTING);
}

EnergyByCause stored_energy(const ContactLaw &law, const ContactCoefficients &row,
                            const ContactState<double> &state, double dt,
                            const HistoryValues &history)
{
  ContactReport found;
  report_contact(law, row, state, dt, history, ContactData::ENERGIES, found);
  return found.stored;
}

ContactState<double> state_of_lane(const ContactBatch &b, int k)
{
  ContactState<double> s;
  s.normal = lane_of(b.normal, k);
  s.overlap = b.overlap[k];
  s.velocity = lane_of(b.velocity, k);
  s.surface_rotation = lane_of(b.surface_rotation, k);
  s.inverse_mass = b.inverse_mass[k];
  s.inverse_radius = b.inverse_radius[k];
  s.relative_omega = lane_of(b.relative_omega, k);
  s.intersection_radius = b.intersection_radius[k];
  s.inverse_distance = b.inverse_distance[k];
  s.arm_loss = b.arm_loss[k];
  s.arm_difference = b.arm_difference[k];
  s.lag = b.lag;
  s.velocity_change = lane_of(b.velocity_change, k);
  s.rotation_change = lane_of(b.rotation_change, k);
  s.omega_change = lane_of(b.omega_change, k);
  s.normal_change = lane_of(b.normal_change, k);
  return s;
}

double tangent_stiffness(const ContactLaw &law, const ContactCoefficients &row, double overlap,
                         double mass_eff, double radius_eff)
{
  return at_rest(law, row, overlap, mass_eff, radius_eff).tangent_n;
}

/// Damping by the law of cohesion (force/velocity), along the normal and across it: what a unit of
/// velocity changes.
static ContactResponse with_damping_of_cohesion(const ContactLaw &law,
                                                const ContactCoefficients &row,
                                                const ContactLanes<double> &at_rest,
                                                ContactResponse found)
{
  const auto force = [&](const Vector3<double> &velocity) {
    ContactLanes<double> s = at_rest;
    s.normal = {1.0, 0.0, 0.0};
    s.velocity = velocity;
    s.normal_velocity = velocity.x;
    s.force = {0.0, 0.0, 0.0};
    // of a bridge of the liquid of particles its volume: any above 0, which viscous forces do not read
    double history[ContactBatch::history_size] = {1.0};
    law.cohesion().one(s, law.coefficients(Stage::COHESION, row), history, 0.0);
    return s.force;
  };
  const Vector3<double> still = force({0.0, 0.0, 0.0});
  found.gn += still.x - force({1.0, 0.0, 0.0}).x;
  found.gt += still.y - force({0.0, 1.0, 0.0}).y;
  return found;
}

/* The laws of pair granular have coefficients of their own: kt, times the contact radius of those
   of Mindlin, and the share xt of the normal damping. */

static ContactResponse response_without_cohesion(const ContactLaw &law,
                                                 const ContactCoefficients &row,
                                                 const ContactLanes<double> &s)
{
  const Law &tangential = law.tangential();
  const bool springs = tangential.has_spring || tangential.odd_history > 0;
  if (!tangential.acts) return {s.tangent_n, s.gn, 0.0, 0.0};
  if (tangential.reads_stiffness) return {s.tangent_n, s.gn, springs ? s.kt : 0.0, s.gt};
  const double kt = law.coefficient(Stage::TANGENTIAL, "kt", row);
  const double gt = law.coefficient(Stage::TANGENTIAL, "xt", row) * s.gn;
  return {s.tangent_n, s.gn,
          springs ? kt * (tangential.needs_radius ? s.contact_radius : 1.0) : 0.0, gt};
}

ContactResponse response(const ContactLaw &law, const ContactCoefficients &row, double overlap,
                         double mass_eff, double radius_eff)
{
  const ContactLanes<double> s = at_rest(law, row, overlap, mass_eff, radius_eff);
  return with_damping_of_cohesion(law, row, s, response_without_cohesion(law, row, s));
}

double damping_ratio(const ContactLaw &law, const ContactCoefficients &row, double overlap,
                     double mass_eff, double radius_eff)
{
  const ContactLanes<double> s = at_rest(law, row, overlap, mass_eff, radius_eff);
  return s.tangent_n > 0.0 ? s.gn / (2.0 * std::sqrt(mass_eff * s.tangent_n)) : 0.0;
}

}    // namespace Talus
