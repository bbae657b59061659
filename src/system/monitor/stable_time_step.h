// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The time step at which contacts that stay closed stop being stable, by their stiffness and
// damping, and by the order of the integrator.
//
// A sphere of mass m (moment of inertia 2/5 m r^2) is held by n equal contacts, evenly spread over
// it. They share its translation, with the stiffness n/3 (kn + 2 kt), and its rotation, with
// 5/3 n kt in place of the mass of the surface; damping adds up in the same way. For stiffness K
// and damping G of such a motion the roots of the difference equation leave the unit circle at -1,
// where
//
//   order 1   K dt^2 + 2 G dt = 4 m
//   order 2   K dt^2 + 4 G dt = 4 m: the velocity is extrapolated by half a step; of the normal
//             damping, which is implicit in its own contact, only the part 1 - 3/n counts, which
//             comes from the other contacts
//
// With twelve contacts this is within 2 % of what is found in the densest packing of spheres and in
// a cage of twelve fixed ones (m: effective mass of a contact), see `scripts/bench stability`.
//
// A body with faces is held at their corners: K and G are matrices there, see
// shape/face_stiffness.h, and order 1 ends where the largest eigenvalue of M^-1 (K dt^2 + 2 G dt)
// is 4. Of two bodies that hold each other the sum of both eigenvalues is a bound of it.

#ifndef TALUS_SYSTEM_MONITOR_STABLE_TIME_STEP_H
#define TALUS_SYSTEM_MONITOR_STABLE_TIME_STEP_H

#include "laws/contact_energy.h"
#include "shape/face_stiffness.h"

#include <vector>

namespace LAMMPS_NS {

/// Units of time; 0 if nothing limits it. `mass` in units of force/acceleration, `contacts` at
/// least 3, order 1 or 2.
double largest_stable_time_step(const Talus::ContactResponse &contact, double mass, int contacts,
                                int order);

/// One side of contacts of which at least one has faces.
struct HeldBody {
  double mass;                          ///< in units of force/acceleration
  const Talus::FaceStiffness *faces;    ///< nullptr: a sphere among twelve
  bool on_large_bodies = false;         ///< are what it touches
};
/// The same of such bodies, with order 1; 0 if nothing limits it.
double largest_stable_time_step(const Talus::ContactResponse &contact,
                                const std::vector<HeldBody> &bodies);

}    // namespace LAMMPS_NS

#endif
