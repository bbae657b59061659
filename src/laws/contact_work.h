// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The work that normal damping, tangential forces, and rolling and twisting resistance take from
// the two bodies of a contact in a step, positive if they lose energy:
//
//   W = -dt (F . (v + dv) + M . (omega + domega))
//
// The force F belongs to the time of the positions, half way between the velocities before and
// after the kick that it gives: the change of kinetic energy by it is dt F times their mean. The
// contact sees the velocity v before it; dv, half the change by the kick before, brings it to the
// time of the positions, to second order in the step. See doc/compute_contacts.md for how
// much that is.
//
// Of contacts that last beyond zero overlap or are hysteretic the work is that of the whole normal
// force, and the energy that they store when they end is lost like that of springs.

#ifndef TALUS_LAWS_CONTACT_WORK_H
#define TALUS_LAWS_CONTACT_WORK_H

#include "base/simd.h"
#include "laws/contact_lanes.h"
#include "laws/law.h"

namespace Talus {

class ContactLaw;

/// Rows of ContactBatch::work.
enum class Cause : int { DAMPING, FRICTION, RESISTANCE };

template <class Real> using ContactWork = Real[ContactBatch::num_causes];

/// The work, when all stages have run: s.tangential is that of the tangential stage. `friction`,
/// `twists`, `resists`: as ContactLaw has them; `whole_force`: its whole_force_works(), where
/// s.normal_force is that of all stages. The torques about the centers are -r torque_per_radius and +- twisting_torque.
/// Friction has (1 - arm_loss) n x F_t of the former and arm_difference n x F_t of the latter,
/// resistance the rest.
template <bool friction, bool twists, bool resists, bool whole_force, class Real>
TALUS_INLINE void find_work(const ContactLanes<Real> &s, double dt, ContactWork<Real> &work)
{
  const Vector3<Real> velocity = s.velocity + s.velocity_change;
  const Real lost = whole_force ? s.normal_force : s.normal_force - s.elastic;
  work[0] = -dt * lost * dot(velocity, s.normal);
  work[1] = work[2] = splat<Real>(0.0);
  if constexpr (!friction) return;
  const Vector3<Real> rotation = s.surface_rotation + s.rotation_change;
  if constexpr (!twists) {
    work[1] = -dt * (dot(s.tangential, velocity) - dot(s.torque_per_radius, rotation));
    return;
  }
  const Vector3<Real> friction_torque = cross(s.normal, s.tangential);
  const Vector3<Real> omega = s.relative_omega + s.omega_change;
  const Vector3<Real> of_friction = (splat<Real>(1.0) - s.arm_loss) * friction_torque,
                      twist = s.arm_difference * friction_torque;
  work[1] = -dt * (dot(s.tangential, velocity) - dot(of_friction, rotation) + dot(twist, omega));
  if constexpr (!resists) return;
  work[2] = dt * (dot(s.torque_per_radius - of_friction, rotation) -
                  dot(s.twisting_torque - twist, omega));
}

/// find_work() for what single stages have left in `between`. Needs relative_omega and its change
/// of laws that twist.
StageFunction work_finder(const ContactLaw &law);

}    // namespace Talus

#endif
