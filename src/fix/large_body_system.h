// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All that fix large/body asks of the pair style: where particles live in this step, and the
// materials of particles.

#ifndef TALUS_FIX_LARGE_BODY_SYSTEM_H
#define TALUS_FIX_LARGE_BODY_SYSTEM_H

#include "body/contact/body_particle_view.h"
#include "material/contact_spec.h"
#include "pointers.h"

namespace LAMMPS_NS {

class PairGranPenalty;

class LargeBodySystem : protected Pointers {
 public:
  explicit LargeBodySystem(LAMMPS *lmp) : Pointers(lmp) {}

  /// The owned particles in the host's arrays, or in the records while they live there.
  /// `mass_override`: as in BodyParticleView.
  Talus::BodyParticleView particles(const double *mass_override) const;

  /// Contacts between particles turn them: records then keep angular velocities. True without
  /// records.
  bool turns_particles() const;

  /// A body given by its material as it acts on particles of a type, whose material is theirs.
  /// Friction and resistance of particles whose own law has none are those of the body.
  Talus::ContactCoefficients mixed(const ContactSpec &body, int type, const char *id) const;

 private:
  const PairGranPenalty *pair_of_materials() const;
};

}    // namespace LAMMPS_NS

#endif
