// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Force and torque of one contact for one combination of laws. The same function runs for eight
// contacts at a time in the kernels and for one in Pair::single() and in the unit tests.

#ifndef TALUS_CONTACT_MODEL_H
#define TALUS_CONTACT_MODEL_H

#include "contact/contact_law.h"
#include "contact/normal_laws.h"
#include "contact/tangential_laws.h"

namespace Talus {

/// State of one contact as the laws see it. The first body is the one that receives `force`.
template <class Real> struct ContactState {
  Vector3<Real> normal;      ///< unit vector from the second body to the first; 0 if centres coincide
  Real overlap;              ///< > 0; 0 if centres coincide, which switches the contact off
  Vector3<Real> velocity;    ///< v_1 - v_2 of the centres (of the surface point for a large body)
  Vector3<Real> spin;        ///< r_1 omega_1 + r_2 omega_2
  Real inverse_mass;         ///< 1/m_1 + 1/m_2; 0 between two infinitely heavy bodies: no damping
  Real inverse_radius;       ///< 1/r_1 + 1/r_2
};

/// Result of one contact. The torque on body i about its centre is -r_i moment, for both bodies.
template <class Real> struct ContactForce {
  Vector3<Real> force{};         ///< on the first body; the second receives the opposite
  Vector3<Real> tangential{};    ///< the tangential part of it
  Vector3<Real> moment{};        ///< normal x tangential
  Real normal{};                 ///< normal force, repulsive if positive
};

/// Relative surface velocity of body 1 against body 2 in the tangent plane:
/// v_t = v - (v.n) n - (r_1 omega_1 + r_2 omega_2) x n  (lever arms are the full radii).
template <class Real>
inline Vector3<Real> surface_velocity(const ContactState<Real> &s, Real normal_velocity)
{
  return s.velocity - normal_velocity * s.normal - cross(s.spin, s.normal);
}

/// Evaluates a contact. `advance` is false while a run is set up and in queries: forces are then
/// those of the stored history, which is left as it is.
template <class Normal, class Tangential, bool advance, class Real>
inline ContactForce<Real> evaluate_contact(const Coefficients<Real> &c, const ContactState<Real> &s,
                                           double dt, TangentialHistory<Real> &history)
{
  const Real zero = splat<Real>(0.0), one = splat<Real>(1.0);
  ContactForce<Real> out;
  const Real mass_eff = select(s.inverse_mass > zero, one / s.inverse_mass, zero);
  const Real radius_eff = Normal::needs_radius ? one / s.inverse_radius : zero;
  const Stiffness<Real> k = Normal::stiffness(c, s.overlap, mass_eff, radius_eff);

  const Real normal_velocity = dot(s.velocity, s.normal);
  const Real elastic_damped = k.kn * s.overlap - k.gn * normal_velocity;
  out.normal = select(elastic_damped < c.force_floor, c.force_floor, elastic_damped);
  out.force = out.normal * s.normal;

  if constexpr (Tangential::friction) {
    const TangentialInput<Real> in{k, surface_velocity(s, normal_velocity), s.normal,
                                   c.mu * magnitude(out.normal), splat<Real>(dt)};
    if constexpr (Tangential::history)
      out.tangential = Tangential::template force<advance>(in, history);
    else
      out.tangential = Tangential::force(in);
    out.force = out.force + out.tangential;
    out.moment = cross(s.normal, out.tangential);
  }
  return out;
}

}    // namespace Talus

#endif
