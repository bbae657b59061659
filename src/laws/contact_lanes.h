// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// One contact, or several side by side, on the way through the stages of its law: the input, what
// each stage computes for later ones, and the forces. Real is one contact (double) or eight (Vec8).
// Units are those of the caller, consistent: force = mass length/time^2.

#ifndef TALUS_LAWS_CONTACT_LANES_H
#define TALUS_LAWS_CONTACT_LANES_H

#include "base/vector3.h"

namespace Talus {

/// State of one contact as the laws see it. The first body is the one that receives `force`.
template <class Real> struct ContactState {
  Vector3<Real> normal{};      ///< unit vector from body 2 to body 1; 0 if centers coincide
  Real overlap{};              ///< > 0; 0 if centers coincide, which switches the contact off
  Vector3<Real> velocity{};    ///< v_1 - v_2 of the centers (of the surface point for a large body)
  Vector3<Real> surface_rotation{};    ///< r_1 omega_1 + r_2 omega_2; only for laws with torques
  Real inverse_mass{};      ///< 1/m_1 + 1/m_2; 0 between two infinitely heavy bodies: no damping
  Real inverse_radius{};    ///< 1/r_1 + 1/r_2; only for laws that need it
  Vector3<Real> relative_omega{};    ///< omega_1 - omega_2; only for laws with resistance
  Real intersection_radius{};        ///< of the circle in which the surfaces intersect; only for
                                     ///< the same laws
  Real inverse_distance{};    ///< 1/|x_1 - x_2|, 0 against a large body; only for midpoint laws
  // Only for laws whose lever arms end in the middle of the overlap, and 0 against a large body,
  // where they do not: overlap/(r_1 + r_2), and overlap/2 (r_2 - r_1)/(r_1 + r_2).
  Real arm_loss{}, arm_difference{};
  Real temperature_difference{};    ///< T_2 - T_1; only for laws that conduct heat
  // For laws of second order, and the changes also for the work of contacts: the time by which
  // velocities lag behind positions, and the changes of velocity, surface_rotation and (with
  // resistance) relative_omega during that time, by the accelerations of the last step.
  Real lag{};
  Vector3<Real> velocity_change{}, rotation_change{}, omega_change{};
  /// For the same laws: change of the normal during the last step, of contacts with a large body,
  /// whose inverse_distance is 0; 0 in the first step.
  Vector3<Real> normal_change{};
  Real separated{};    ///< 1 if the contact has ended in this step, see tangential/end_of_contact.h
  Real pulloff_distance{};    ///< how far it lasts beyond zero overlap; only where the bodies are
                              ///< apart
};

/// The state, and the results of the stages. Torques about the centers: -r_1 torque_per_radius +
/// twisting_torque on body 1, -r_2 torque_per_radius - twisting_torque on body 2 (LAMMPS' gran/*
/// styles call the first tor1, tor2, tor3).
template <class Real> struct ContactLanes : ContactState<Real> {
  // approach, see approach.h
  Vector3<Real> full_normal{};    ///< of synchronized laws: the normal of the positions, while
                                  ///< `normal` is that of half a step before
  Real normal_velocity{};         ///< (v_1 - v_2) . n, negative when approaching
  Real mass{}, radius{};          ///< effective ones; radius only for laws that need it
  Real impact_speed{};            ///< normal speed in the first step; 0 if it is not kept
  Real age{};                     ///< time since the first step; 0 if it is not kept

  // normal
  Real kn{}, kt{};    ///< force/length: elastic force over overlap, tangential stiffness
  Real tangent_n{}, tangent_t{};    ///< force/length: d elastic/d overlap, and the like for kt
  Real contact_radius{};            ///< length; 0 of laws that have none
  Real elastic{};                   ///< normal force without damping
  Real pulloff_force{};    ///< force that separates the bodies, > 0; 0 of laws without adhesion

  // damping
  Real gn{}, gt{};          ///< force/velocity
  Real normal_force{};      ///< repulsive if positive; without cohesion
  Real critical_force{};    ///< friction is limited to mu times this, see finish_normal_force()

  /// Share of a constant adhesive force that acts in this step: 1, except where a contact of second
  /// order begins or ends, see tangential/second_order.h.
  Real adhesive_share{};
  /// Where that is not 1: normal_force plus pulloff_force without the correction for begin and end.
  Real uncorrected_force{};

  Real delayed_force{};    ///< normal force, 0 until the contact has lasted one collision time

  // results
  Vector3<Real> force{};                ///< on the first body; the second receives the opposite
  Vector3<Real> tangential{};           ///< the tangential part of it
  Vector3<Real> torque_per_radius{};    ///< force: normal x tangential, and that of rolling
                                        ///< resistance
  Vector3<Real> twisting_torque{};      ///< spinning resistance, and what else is opposite on both
  Real heat_flow{};                     ///< power that the first body receives from the second
};

}    // namespace Talus

#endif
