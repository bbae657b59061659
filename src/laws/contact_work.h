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
//   springs     E(h - h_before), the energy that the change of the displacement alone would store:
//               then a spring takes what it stores and gives all of it back
//   damping     the change of velocity by the damping force itself, dt^2 F^2/(2 m_eff)
// Sums over an impact of two bodies are of second order in the step by this, but for friction that
// slides, of first.

#ifndef TALUS_LAWS_CONTACT_WORK_H
#define TALUS_LAWS_CONTACT_WORK_H

#include "laws/law.h"

namespace Talus {

class ContactLaw;

/// Rows of ContactBatch::work.
enum class Cause : int { DAMPING, FRICTION, RESISTANCE };
inline constexpr int num_causes = 3;
inline Cause cause_of(Stage stage)
{
  return stage == Stage::TANGENTIAL ? Cause::FRICTION : Cause::RESISTANCE;
}

/// Copies `history` to `before`: to run before the stages of a law that remembers something.
StageFunction history_copier(const ContactLaw &law);

/// Finds `work`, without the lag of springs, once all stages have run that left their findings in
/// `between`. Needs relative_omega of laws that twist.
StageFunction work_finder(const ContactLaw &law);

}    // namespace Talus

#endif
