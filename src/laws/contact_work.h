// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The work that normal damping, tangential forces, and rolling and twisting resistance take from
// the two bodies of a contact in a step, positive if they lose energy. It is that of the drift that
// led to the present positions, whose velocities v and omega the contact sees:
//
//   W = -dt (F . v + M . omega) - lag
//
// F is the force at the end of the drift. What it was at the beginning is not known any more, so
// the work lacks what is of second order in the step, except for the parts that do not cancel over
// a contact, the lag:
//   springs     the energy that the displacement of this step alone would store, where the contact
//               sticks: then a spring takes what it stores and gives all of it back. Less what the
//               dashpot beside it changes, with the change of velocity by the force itself
//   sliding     of a contact with a spring, that the limit of friction grows with the overlap
//   tearing     of contacts that last beyond zero overlap the work is that of the whole normal
//               force, and what they store when they tear is lost like that of the springs above
//   damping     the change of velocity by the damping force itself, dt^2 F^2/(2 m_eff)
// The rest is of first order in the step; see doc/compute_penalty_stats.md for how much it is.

#ifndef TALUS_LAWS_CONTACT_WORK_H
#define TALUS_LAWS_CONTACT_WORK_H

#include "base/simd.h"
#include "laws/contact_lanes.h"
#include "laws/law.h"

namespace Talus {

class ContactLaw;

/// Rows of ContactBatch::work.
enum class Cause : int { DAMPING, FRICTION, RESISTANCE };
inline constexpr Cause cause_of(Stage stage)
{
  return stage == Stage::TANGENTIAL ? Cause::FRICTION : Cause::RESISTANCE;
}

template <class Real> using ContactWork = Real[ContactBatch::num_causes];

/// The work without the lag of springs, when all stages have run. `twists`: ContactLaw::twists();
/// `resists`: the same; `tears`: as Law::lasts_beyond_contact of the normal law.
/// The torques about the centers are -r moment and +- twisting torque: of the moment that much
/// belongs to friction as its lever arm is long, of the twisting torque what the arms differ.
template <bool friction, bool twists, bool resists, bool tears, class Real>
TALUS_INLINE void find_work(const ContactLanes<Real> &s, double dt, ContactWork<Real> &work)
{
  const Real damping = s.normal_force - s.elastic;
  work[0] = -dt * damping * (s.normal_velocity + 0.5 * dt * damping * s.inverse_mass);
  if constexpr (tears)
    work[0] = work[0] - dt * s.elastic * s.normal_velocity -
              0.5 * dt * dt * s.tangent_n * s.normal_velocity * s.normal_velocity;
  work[1] = work[2] = splat<Real>(0.0);
  if constexpr (!friction) return;
  const Vector3<Real> tangential = s.force - dot(s.force, s.normal) * s.normal;
  const Vector3<Real> lever = cross(s.normal, tangential);
  if constexpr (!twists) {
    work[1] = -dt * (dot(tangential, s.velocity) - dot(lever, s.surface_rotation));
    return;
  }
  const Vector3<Real> moment = (splat<Real>(1.0) - s.arm_loss) * lever,
                      twist = s.arm_difference * lever;
  work[1] = -dt * (dot(tangential, s.velocity) - dot(moment, s.surface_rotation) +
                   dot(twist, s.relative_omega));
  if constexpr (!resists) return;
  work[2] = dt * (dot(s.moment - moment, s.surface_rotation) -
                  dot(s.twisting_torque - twist, s.relative_omega));
}

/// L remembers the displacement, or the force, of a spring.
template <class L> inline constexpr bool has_lag = L::spring_size > 0;

/// Takes the lag of its spring away. `before`, `now`: what L remembered and remembers. The contact
/// sticks if friction is below its limit; rolling and twisting, if the history has changed about as
/// its rate says.
template <class L, class Real>
TALUS_INLINE void take_lag(const ContactLanes<Real> &s, const typename L::template Row<Real> &c,
                           const Real *before, const Real *now, double dt, ContactWork<Real> &work)
{
  const Real zero = splat<Real>(0.0);
  Real moved[L::spring_size];
  L::rate(s, c, moved);
  for (int n = 0; n < L::spring_size; n++) moved[n] = dt * moved[n];
  const Real lag = L::stored(s, c, moved);
  Real &its = work[static_cast<int>(cause_of(L::stage))];
  if constexpr (L::stage == Stage::TANGENTIAL) {
    constexpr double rounding = 1.0e-9;
    const Real limit = (1.0 - rounding) * c.mu * s.critical_force;
    const Vector3<Real> tangential = s.force - dot(s.force, s.normal) * s.normal;
    constexpr double response = 1.0 + 2.5;    // of a sphere's surface, times 1/m
    const Real change = (0.5 * response * dt * dt) * s.inverse_mass * L::drag(s, c) *
                        dot(tangential, surface_velocity(s));
    const auto slides = dot(tangential, tangential) >= limit * limit;
    Real late = lag + change;
    if (any(slides)) {    // few slide: spares the root. Their limit changes with the overlap
      const Vector3<Real> velocity = surface_velocity(s);
      const Real tightened = -0.5 * dt * dt * c.mu * s.tangent_n * s.normal_velocity *
                             square_root(dot(velocity, velocity));
      late = select(slides, tightened, late);
    }
    its = its - late;
  } else {
    Real slip = zero, length = zero;
    for (int n = 0; n < L::spring_size; n++) {
      const Real difference = now[n] - before[n] - moved[n];
      slip = slip + difference * difference;
      length = length + moved[n] * moved[n];
    }
    its = its - select(slip < 0.25 * length, lag, zero);
  }
}

/// Copies `history` to `before`: to run before single stages of a law that remembers something.
StageFunction history_copier(const ContactLaw &law);

/// find_work() for what single stages have left in `between`. Needs relative_omega of laws that
/// twist.
StageFunction work_finder(const ContactLaw &law);

}    // namespace Talus

#endif
