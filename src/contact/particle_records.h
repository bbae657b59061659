// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// State of all particles of a rank, owned and ghost, as records in canonical order, and the sums of
// their contact forces. The host's arrays are read once and written once in a step.

#ifndef TALUS_CONTACT_PARTICLE_RECORDS_H
#define TALUS_CONTACT_PARTICLE_RECORDS_H

#include "contact/candidate_list.h"
#include "contact/record.h"

#include <vector>

namespace Talus {

/// The host's arrays: rows of three doubles, owned particles first, then ghosts.
struct ParticleView {
  const double *x, *v, *omega;    ///< omega may be nullptr in a scene without friction
  const double *radius, *mass;
  const double
      *mass_override;    ///< nullptr, or per particle: > 0 replaces its mass (infinity: frozen)
};

class ParticleRecords {
 public:
  /// Reads the state of all particles and clears the sums. `spins` is false in scenes without
  /// friction: spin records and moments are then neither read nor kept. `couples`: laws with
  /// resistance occur.
  void read(const CandidateList &order, const ParticleView &host, bool spins, bool couples);

  /// Adds the summed forces, and torques if spins are kept, to the host's rows of owned particles:
  /// f += F, torque += C - r M.
  void add_to(const CandidateList &order, double *f, double *torque) const;

  double memory_usage() const;

  std::vector<Record> position, velocity, spin;    ///< see record.h
  std::vector<Record> force, moment, couple;
};

}    // namespace Talus

#endif
