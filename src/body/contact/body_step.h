// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How the contacts of a large body or wall are computed in one step, and what it is asked for. Made by
// its owner for each step (LargeBody, HostWall), see BodyContacts::compute().

#ifndef TALUS_BODY_CONTACT_BODY_STEP_H
#define TALUS_BODY_CONTACT_BODY_STEP_H

#include "base/vector3.h"
#include "body/contact/body_load.h"
#include "body/contact/computed_contacts.h"
#include "laws/contact_energy.h"

#include <vector>

namespace Talus {

/// Force of one contact on a part of the body in one step.
struct TouchedPart {
  int part;
  double normal_force;      ///< > 0: pressed
  Vector3<double> force;    ///< on the body, its frame
  Vector3<double> shear;    ///< the tangential part of it
  double shear_power;       ///< that force times the velocity of the surfaces past each other
  double heat = 0.0;        ///< that flows into the body (energy/time)
};

/// Force of one contact on the corners of a triangle in one step, see MovingVertices.
struct TouchedCorners {
  int triangle;
  Vector3<double> force[3];
};

/// Heat between particles and a body that has one temperature; of particles by local index.
struct BodyHeat {
  const double *temperature = nullptr;    ///< nullptr: none is conducted
  double of_body = 0.0;                   ///< its temperature
  double *flow = nullptr;    ///< into the particles, added to (energy/time); or nullptr
};

struct BodyStep {
  double dt = 0.0;
  double lag = 0.0;       ///< see ContactStep
  bool advance = true;    ///< false while a run is set up: histories are then only read
  int threads = 1;
  /// Contacts end where the overlap does, whatever their laws say.
  bool ends_at_zero_overlap = false;
  /// Of owned particles, by local index (mass); nullptr: as contacts feel them, see ParticleState.
  const double *masses = nullptr;
  BodyHeat heat;
  WorkAccount *account = nullptr;                    ///< receives the work, if it advances
  ExactLoad *exact = nullptr;                        ///< receives the load without rounding
  std::vector<TouchedPart> *touched = nullptr;       ///< receives one entry for each contact
  std::vector<TouchedCorners> *corners = nullptr;    ///< the same, of a mesh whose vertices move
  ComputedContacts *for_outputs = nullptr;    ///< receives the contacts, if they may be asked for
  double *virial = nullptr;    ///< added to, six for each owned particle: xx yy zz xy xz yz
};

}    // namespace Talus

#endif
