// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Rolling and spinning resistance after Schwartz, Richardson and Michel 2012 (Granular Matter 14,
// 363), as the penalty solver of Project Chrono has them: torques against the relative rotation
// that do not depend on its speed (type A of Ai et al. 2011, Powder Technology 206, 269), none
// below a threshold of speed.
//
// A constant torque cannot hold a body: it pushes it back and forth by what it does in one time
// step, and on a slope the body creeps. `delayed` resistance is so, as Chrono's. The other is
// limited to what stops the relative rotation, after the pattern of Coulomb friction with a return
// mapping: a body that does not roll is held up to mu_roll F_n, exactly.
//
// The words rolling and spinning bring both, with a coefficient of 0 for the one that is not given.

#ifndef TALUS_LAWS_ROLLING_COMMON_H
#define TALUS_LAWS_ROLLING_COMMON_H

#include "laws/law_definition.h"

namespace Talus {

/// The part of the relative rotation that one contact may take away in a step: a body may have many
/// contacts, each of which would stop it. Spheres of one size have at most twelve, of which each
/// sees 2/3 of a rotation on the mean; stable if the sum is below 2.
inline constexpr double stopping_share = 0.25;

/// Change of r_1 omega_1 + r_2 omega_2 in a step for each unit of torque_per_radius; bodies are
/// solid spheres, I = 2/5 m r^2. (One that is harder to turn, as a member of a rigid body, is only
/// stopped in more steps.)
template <class Real> inline Real response(Real inverse_mass, double dt)
{
  return 2.5 * dt * inverse_mass;
}

/// Below which delayed resistance does not act, Chrono's; resistance that holds a body needs none.
inline constexpr double delayed_threshold = 1.0e-4;

/// Reads mu [delayed] of a stage, rolling or twisting, and sets its law, and that of the other
/// stage unless it has one.
void read_resistance(LawReader &r, Stage stage);

}    // namespace Talus

#endif
