// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_energy.h"

#include "laws/contact_kernel.h"
#include "laws/model_dispatch.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

Vector3<double> lane_of(const double (&v)[3][ContactBatch::width], int k)
{
  return {v[0][k], v[1][k], v[2][k]};
}

struct Inputs {
  double mass, radius, speed;
};

Inputs inputs_of(const ContactCoefficients &c, const ContactState<double> &s,
                 const ContactImpact<double> &impact)
{
  return {s.inverse_mass > 0.0 ? 1.0 / s.inverse_mass : 0.0,
          s.inverse_radius > 0.0 ? 1.0 / s.inverse_radius : 0.0, std::max(impact.speed, c.speed)};
}

Stiffness<double> stiffness_of(ContactLaw law, const ContactCoefficients &c, double overlap,
                               const Inputs &in)
{
  return dispatch_model(law, [&](auto model) {
    return decltype(model)::Normal::stiffness(
        c, NormalInput<double>{overlap, in.mass, in.radius, in.speed});
  });
}

}    // namespace

ContactEnergy contact_energy(ContactLaw law, const ContactCoefficients &c,
                             const ContactState<double> &s, double dt,
                             const TangentialHistory<double> &history,
                             const ContactImpact<double> &impact)
{
  const Inputs in = inputs_of(c, s, impact);
  const Stiffness<double> k = stiffness_of(law, c, s.overlap, in);
  const ContactForce<double> out = single_contact(law, c, s, dt, history, impact);
  const double elastic = k.kn * s.overlap;
  const double adhesion = law.adheres ? c.adhesion + c.adhesion_dmt * std::sqrt(in.radius) +
                                            c.adhesion_perko * in.radius
                                      : 0.0;

  ContactEnergy e;
  // F ~ overlap: F overlap/2; F ~ overlap^(3/2): 2/5 F overlap
  e.elastic_normal =
      (is_linear(law.normal) ? 0.5 : 0.4) * elastic * s.overlap - adhesion * s.overlap;
  e.damping = (out.normal - elastic) * s.normal;
  if (!law.has_friction()) return e;

  e.friction = out.tangential;
  e.friction_moment = cross(s.normal, out.tangential);
  if (law.has_history())
    e.elastic_tangential = 0.5 * k.kt * dot(history.displacement, history.displacement);
  e.rolling_moment = out.moment - e.friction_moment;
  e.twisting_torque = out.couple;
  return e;
}

ContactEnergy lane_energy(ContactLaw law, const ContactCoefficients &coefficients,
                          const ContactBatch &b, int k, double dt)
{
  ContactState<double> s;
  s.normal = lane_of(b.normal, k);
  s.overlap = b.overlap[k];
  s.velocity = lane_of(b.velocity, k);
  s.spin = lane_of(b.spin, k);
  s.inverse_mass = b.inverse_mass[k];
  s.inverse_radius = b.inverse_radius[k];
  s.relative_omega = lane_of(b.relative_omega, k);
  s.circle = b.circle[k];
  s.inverse_distance = b.inverse_distance[k];
  return contact_energy(law, coefficients, s, dt, {lane_of(b.displacement, k), b.sliding[k]},
                        {b.impact[0][k], b.impact[1][k], b.impact[2][k]});
}

double tangent_stiffness(ContactLaw law, const ContactCoefficients &c, double overlap,
                         double mass_eff, double radius_eff)
{
  const Stiffness<double> k = stiffness_of(law, c, overlap, {mass_eff, radius_eff, c.speed});
  return (is_linear(law.normal) ? 1.0 : 1.5) * k.kn;
}

double damping_ratio(ContactLaw law, const ContactCoefficients &c, double overlap, double mass_eff,
                     double radius_eff)
{
  const Stiffness<double> k = stiffness_of(law, c, overlap, {mass_eff, radius_eff, c.speed});
  const double tangent = (is_linear(law.normal) ? 1.0 : 1.5) * k.kn;
  return tangent > 0.0 ? k.gn / (2.0 * std::sqrt(mass_eff * tangent)) : 0.0;
}

void EnergyAccount::begin_step(int num_particles)
{
  elastic_normal = elastic_tangential = 0.0;
  forces.assign(num_particles, Forces{});
}

void EnergyAccount::add_end(const ContactEnergy &e, int particle, double radius, double sign)
{
  Forces &f = forces[particle];
  f.damping = f.damping + sign * e.damping;
  f.friction = f.friction + sign * e.friction;
  f.friction_torque = f.friction_torque - radius * e.friction_moment;
  f.resistance_torque = f.resistance_torque - radius * e.rolling_moment + sign * e.twisting_torque;
}

void EnergyAccount::add(const ContactEnergy &e, double share, int first, double first_radius,
                        int second, double second_radius)
{
  elastic_normal += share * e.elastic_normal;
  elastic_tangential += share * e.elastic_tangential;
  add_end(e, first, first_radius, 1.0);
  if (second >= 0) add_end(e, second, second_radius, -1.0);
}

void EnergyAccount::move(int particle, double dt, const Vector3<double> &mean_velocity,
                         const Vector3<double> &mean_spin)
{
  const Forces &f = forces[particle];
  work_normal -= dt * dot(f.damping, mean_velocity);
  work_tangential -= dt * (dot(f.friction, mean_velocity) + dot(f.friction_torque, mean_spin));
  work_resistance -= dt * dot(f.resistance_torque, mean_spin);
}

}    // namespace Talus
