// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Finds the largest values of all ranks for the warnings of fix large/body, and prints them.

#ifndef TALUS_FIX_LARGE_BODY_MONITOR_H
#define TALUS_FIX_LARGE_BODY_MONITOR_H

#include "body/contact/body_warnings.h"
#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class LargeBodyMonitor : protected Pointers {
 public:
  explicit LargeBodyMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// A run begins.
  void start() { warnings.start(); }

  /// Collective, one reduction. `found` among the particles of this rank; `moves`: the body does.
  void look(const Talus::BodyFindings &found, bool moves, const std::string &id);

 private:
  Talus::BodyWarnings warnings;
};

}    // namespace LAMMPS_NS

#endif
