// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The fixes that move particles: properties of those in the script, and in a run with steps in the
// records those of Talus, which hand in their steps one after another, so that all particles are
// moved in one pass. GranularSystem owns them.

#ifndef TALUS_SYSTEM_STEP_INTEGRATORS_H
#define TALUS_SYSTEM_STEP_INTEGRATORS_H

#include "particles/particle_records.h"
#include "system/host/system_fix.h"

#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class Integrators : protected LAMMPS_NS::Pointers {
 public:
  explicit Integrators(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  // ---- of the script, at any time

  /// In the time step: 1, or 2 if one is.
  int order() const;
  /// The time by which velocities are behind positions, with an integrator of second order.
  double lag() const;
  /// The shortest kick that the next forces give (time), see SystemFix::next_kick_in_steps().
  double next_kick() const;
  /// In a step after initial_integrate(): the kicks of the first fix that integrates, one of Talus if
  /// there is any.
  Kicks kicks() const;
  /// Bits of the groups whose integrators keep changes of velocities in the arrays of LAMMPS.
  int groups_with_changes() const;

  // ---- of a run

  /// At its start, those in the order of the script.
  void start_run();
  /// Of such a run, collective: "", or why they cannot move particles in the records. `fix_of_shapes`:
  /// nullptr, or the one that checks itself that no other fix moves its particles.
  std::string reason_against_records(const LAMMPS_NS::Fix *fix_of_shapes) const;
  /// Which of them moves each of the owned particles begin ... end-1 on the way through the records,
  /// -1: none, to mover[0] ...; called by all threads.
  void find_movers(int begin, int end, signed char *mover) const;
  /// The step of one, each in its turn. Returns whether all have given theirs, in steps().
  bool give(const RecordStep &step);
  const std::vector<RecordStep> &steps() const { return given; }
  /// Particles go back to the arrays of LAMMPS.
  void leave_records();
  void turn_particles() const;

 private:
  struct Integrator {
    LAMMPS_NS::Fix *fix;
    SystemFix *talus_fix;    ///< the same
  };
  std::vector<Integrator> of_run;
  std::vector<RecordStep> given;    // of the first of these, in this step
};

}    // namespace Talus

#endif
