// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Part of a snapshot: time, what is planned for coming steps, and what was found in the last one.

#ifndef TALUS_SYSTEM_SNAPSHOT_SAVED_CLOCK_H
#define TALUS_SYSTEM_SNAPSHOT_SAVED_CLOCK_H

#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <vector>

namespace Talus {

class SavedClock : protected LAMMPS_NS::Pointers {
 public:
  /// Saves. Between two runs.
  explicit SavedClock(LAMMPS_NS::LAMMPS *lmp);
  /// First of all: the step, and the time step.
  void restore_time() const;
  /// Last of all: outputs, energies, when lists were made.
  void restore_plans() const;

 private:
  void forget_computes() const;

  LAMMPS_NS::bigint step, step_of_time;
  double time, dt;
  int lists_ago;
  LAMMPS_NS::bigint lists_made;
  LAMMPS_NS::bigint energies_of, virial_of, last_thermo;
  std::vector<LAMMPS_NS::bigint> last_dump;
  std::array<double, 8> pair_sums{};    // energies and virial of the pair style
};

}    // namespace Talus

#endif
