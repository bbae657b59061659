// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Force and torque of one contact for one combination of laws. The same function runs for eight
// contacts at a time in the kernels and for one in Pair::single() and in the unit tests.

#ifndef TALUS_LAWS_CONTACT_MODEL_H
#define TALUS_LAWS_CONTACT_MODEL_H

#include "laws/contact_law.h"
#include "laws/normal_laws.h"
#include "laws/resistance.h"
#include "laws/tangential_laws.h"

#include <type_traits>

namespace Talus {

/// A combination of laws, as types.
template <class Normal_, class Tangential_, Resistance resistance_, bool adheres_> struct Model {
  using Normal = Normal_;
  using Tangential = Tangential_;
  static constexpr Resistance resistance = resistance_;
  static constexpr bool resists = resistance_ != Resistance::NONE;
  static constexpr bool adheres = adheres_;
  static constexpr bool rotates = Tangential::friction || resists;    ///< spins in, torques out
  static constexpr bool history = Tangential::history;
  static constexpr bool midpoint = Tangential::midpoint;
  static constexpr bool needs_speed = std::is_same<Normal, NormalHookeMaterial>::value ||
                                      std::is_same<Normal, NormalFloresMaterial>::value;
  static constexpr bool impact = history && (needs_speed || resistance_ == Resistance::DELAYED);
  static constexpr bool holds = resistance_ == Resistance::AT_ONCE;
  static constexpr bool needs_radius = Normal::needs_radius || adheres || holds;
};

/// State of one contact as the laws see it. The first body is the one that receives `force`.
template <class Real> struct ContactState {
  Vector3<Real> normal;    ///< unit vector from the second body to the first; 0 if centers coincide
  Real overlap;            ///< > 0; 0 if centers coincide, which switches the contact off
  Vector3<Real> velocity;    ///< v_1 - v_2 of the centers (of the surface point for a large body)
  Vector3<Real> spin;        ///< r_1 omega_1 + r_2 omega_2; only for models that rotate
  Real inverse_mass;         ///< 1/m_1 + 1/m_2; 0 between two infinitely heavy bodies: no damping
  Real inverse_radius;       ///< 1/r_1 + 1/r_2; only for models that need it
  Vector3<Real> relative_omega;    ///< omega_1 - omega_2; only for models with resistance
  Real circle;                     ///< radius of the circle of intersection; only for the same
  Real inverse_distance;    ///< 1/|x_1 - x_2|, 0 against a flat body; only for the midpoint laws
};

/// How a contact began; kept only by models that need it.
template <class Real> struct ContactImpact {
  Real speed{};    ///< normal speed in the first step
  Real age{};      ///< time since the first step
  Real begun{};    ///< 1 after the first step
};

/// Result of one contact. Torques about the centers: -r_1 moment + couple on body 1, -r_2 moment -
/// couple on 2.
template <class Real> struct ContactForce {
  Vector3<Real> force{};         ///< on the first body; the second receives the opposite
  Vector3<Real> tangential{};    ///< the tangential part of it
  Vector3<Real> moment{};        ///< normal x tangential, and rolling resistance
  Vector3<Real> couple{};        ///< spinning resistance
  Real normal{};                 ///< normal force without adhesion, repulsive if positive
};

/// Relative surface velocity of body 1 against body 2 in the tangent plane:
/// v_t = v - (v.n) n - (r_1 omega_1 + r_2 omega_2) x n  (lever arms are the full radii).
template <class Real>
inline Vector3<Real> surface_velocity(const ContactState<Real> &s, Real normal_velocity)
{
  return s.velocity - normal_velocity * s.normal - cross(s.spin, s.normal);
}

/// How long a contact has lasted of the step that led here, for the midpoint laws: one that began
/// on the way overlap/(-v_n).
template <class Real>
inline Real lasted(const ContactState<Real> &s, Real normal_velocity, double dt)
{
  const Real approach = -normal_velocity * dt;
  return dt * select(approach > s.overlap, s.overlap / approach, splat<Real>(1.0));
}

/// Displacement of the surfaces during the step that led here, for the midpoint laws. The centers
/// came here along straight lines, so the normal half way is known.
template <class Real>
inline Vector3<Real> step_displacement(const ContactState<Real> &s, double dt, Real time)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const Vector3<Real> half_way = s.normal - (0.5 * dt * s.inverse_distance) * s.velocity;
  const Real length = square_root(dot(half_way, half_way));
  const Vector3<Real> n = select(length > zero, one / length, zero) * half_way;
  const Vector3<Real> slip = s.velocity - dot(s.velocity, n) * n - cross(s.spin, n);
  return time * slip;
}

/// Impact speed and age at this step; `advance` counts the step.
template <bool advance, class Real>
inline void follow_impact(ContactImpact<Real> &impact, Real normal_velocity, double dt)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  const auto begun = impact.begun > zero;
  impact.speed = select(begun, impact.speed, magnitude(normal_velocity));
  if (!advance) return;
  impact.age = select(begun, impact.age + dt, zero);
  impact.begun = one;
}

/// Evaluates a contact. `advance` is false while a run is set up and in queries: forces are then
/// those of the stored history, which is left as it is.
template <class Model, bool advance, class Real>
TALUS_INLINE ContactForce<Real>
evaluate_contact(const Coefficients<Real> &c, const ContactState<Real> &s, double dt,
                 TangentialHistory<Real> &history, ContactImpact<Real> &impact)
{
  using Normal = typename Model::Normal;
  using Tangential = typename Model::Tangential;
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  ContactForce<Real> out;

  const Real normal_velocity = dot(s.velocity, s.normal);
  if constexpr (Model::impact) follow_impact<advance>(impact, normal_velocity, dt);
  const Real speed =
      Model::impact ? select(impact.speed > c.speed, impact.speed, c.speed) : c.speed;
  const auto finite = s.inverse_mass > zero;    // else both bodies are infinitely heavy
  Real mass_eff, radius_eff = zero;
  if constexpr (Model::needs_radius) {    // two quotients for the price of one
    const Real inverse_mass = select(finite, s.inverse_mass, one);
    const Real inverse = one / (inverse_mass * s.inverse_radius);
    mass_eff = select(finite, s.inverse_radius * inverse, zero);
    radius_eff = inverse_mass * inverse;
  } else
    mass_eff = select(finite, one / s.inverse_mass, zero);
  const Stiffness<Real> k =
      Normal::stiffness(c, NormalInput<Real>{s.overlap, mass_eff, radius_eff, speed});

  const Real elastic_damped = k.kn * s.overlap - k.gn * normal_velocity;
  out.normal = select(elastic_damped < c.force_floor, c.force_floor, elastic_damped);
  out.force = out.normal * s.normal;

  if constexpr (Tangential::friction) {
    TangentialInput<Real> in{k,
                             surface_velocity(s, normal_velocity),
                             s.normal,
                             c.mu * magnitude(out.normal),
                             c.mu * out.normal,
                             splat<Real>(dt),
                             c.slip_min,
                             Vector3<Real>{}};
    if constexpr (Tangential::midpoint && advance) {
      in.dt = lasted(s, normal_velocity, dt);
      in.increment = step_displacement(s, dt, in.dt);
    }
    if constexpr (Tangential::history)
      out.tangential = Tangential::template force<advance>(in, history);
    else
      out.tangential = Tangential::force(in);
    out.force = out.force + out.tangential;
    out.moment = cross(s.normal, out.tangential);
  }
  if constexpr (Model::holds) {
    const Real presses = select(out.normal > zero, out.normal, zero);
    const Real turns = response(s.inverse_mass, dt);
    out.moment = out.moment + holding_moment(c.mu_roll * presses, c.roll_min, s.spin, s.normal,
                                             turns, out.moment);
    out.couple = stopping_torque(c.mu_twist * s.circle * presses, c.twist_min, s.relative_omega,
                                 s.normal, turns, s.inverse_radius);
  } else if constexpr (Model::resists) {    // Chrono's rule, an attractive F_n with its sign
    const Real acts = out.normal * resistance_gate<Normal>(k, s.overlap, mass_eff, impact.age);
    out.moment = out.moment + rolling_moment(c.mu_roll * acts, c.roll_min, s.spin, s.normal);
    out.couple =
        twisting_torque(c.mu_twist * s.circle * acts, c.twist_min, s.relative_omega, s.normal);
  }
  if constexpr (Model::adheres) {
    const Real pull =
        c.adhesion + c.adhesion_dmt * square_root(radius_eff) + c.adhesion_perko * radius_eff;
    out.force = out.force - pull * s.normal;
  }
  return out;
}

}    // namespace Talus

#endif
