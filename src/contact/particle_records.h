// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// State of all particles of a rank, owned and ghost, as records in canonical order, and the sums of
// their contact forces. The host's arrays are read once and written once in a step.
//
// What a contact needs of its partner apart from the position stands in one cache line, and so does
// what it adds to it: (velocity, spin) and (force, moment). Scenes without friction have no second
// halves.

#ifndef TALUS_CONTACT_PARTICLE_RECORDS_H
#define TALUS_CONTACT_PARTICLE_RECORDS_H

#include "contact/big_vector.h"
#include "contact/particle_order.h"
#include "contact/record.h"

namespace Talus {

/// The host's arrays: rows of three doubles, owned particles first, then ghosts.
struct ParticleView {
  const double *x, *v, *omega;    ///< omega may be nullptr in a scene without friction
  const double *radius, *mass;
  const double
      *mass_override;    ///< nullptr, or per particle: > 0 replaces its mass (infinity: frozen)
  double *f, *torque;    ///< added to; torque may be nullptr like omega
};

class ParticleRecords {
 public:
  /// Makes room for `n` particles, and `spare` more slots for forces that nobody wants. `spins` is
  /// false in scenes without friction: spin records and moments are then neither read nor kept.
  /// `couples`: laws with resistance occur.
  void resize(int n, int spare, bool spins, bool couples);

  /// Reads the state of slots begin ... end-1, or of the owned particles or ghosts among them, and
  /// clears their sums.
  enum class Which { ALL, OWNED, GHOSTS, NONE };
  void read(const ParticleOrder &order, const ParticleView &host, int begin, int end, Which which);

  /// Forgets what has been added to a particle so far.
  void clear_sums(int slot)
  {
    for (std::size_t n = 0; n < stride; n++) store(load[stride * slot + n], Vec4{});
    if (!couple.empty()) store(couple[slot], Vec4{});
  }

  /// Adds the summed forces, and torques if spins are kept, of slots begin ... end-1 to the host's
  /// rows of owned particles: f += F, torque += C - r M.
  void add_to(const ParticleOrder &order, const ParticleView &host, int begin, int end) const;

  double memory_usage() const;

  const Record &velocity(int slot) const { return motion[stride * slot]; }
  const Record &spin(int slot) const { return motion[2 * static_cast<std::size_t>(slot) + 1]; }

  std::size_t stride = 1;    ///< records per particle in motion and load: 2 with spins
  BigVector<Record> position, motion, load, couple;    ///< see record.h
};

}    // namespace Talus

#endif
