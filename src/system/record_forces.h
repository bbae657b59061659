// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Forces on particles that live in the records of a pair style, other than those of its contacts:
// added by the threads that compute the contacts, each to the particles that it has just dealt
// with, so that no thread waits for another one in between.

#ifndef TALUS_SYSTEM_RECORD_FORCES_H
#define TALUS_SYSTEM_RECORD_FORCES_H

namespace Talus {

class RecordForces {
 public:
  /// Called by the pair style at the beginning of compute(), when particles live in its records:
  /// whether the forces of this step will be added by add_to_slots(). If not, nor are those of
  /// anyone behind: forces on a particle are summed in the order of the fixes.
  virtual bool join_step() = 0;

  /// Adds the forces on the particles of slots begin ... end-1. Called once by each thread, at the
  /// same time, for ranges that together hold all owned particles.
  virtual void add_to_slots(int thread, int begin, int end) = 0;

 protected:
  ~RecordForces() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
