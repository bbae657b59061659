// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The block of the log that says at the start of a run which styles are accelerated, which are
// stock because of what, and where steps without output are made. doc/messages.md explains it to
// users.

#ifndef TALUS_SYSTEM_MONITOR_STYLE_REPORT_H
#define TALUS_SYSTEM_MONITOR_STYLE_REPORT_H

#include "pointers.h"

#include <string>

namespace Talus {

class GranularSystem;

class StyleReport : protected LAMMPS_NS::Pointers {
 public:
  explicit StyleReport(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}
  /// Prints the block if it differs from the last one, on the first rank; nothing for a script that
  /// has neither granular pairs nor styles of Talus. `reason_for_arrays`: of the steps of this run.
  /// After init() of LAMMPS.
  void print(const GranularSystem &system, const std::string &reason_for_arrays);

 private:
  bool concerns(const GranularSystem &system) const;
  std::string text(const GranularSystem &system, const std::string &reason_for_arrays) const;
  std::string lines_of_fixes() const;
  std::string pair_is(const GranularSystem &system) const;
  std::string run_style_is() const;

  std::string last;
};

}    // namespace Talus

#endif
