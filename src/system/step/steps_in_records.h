// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which steps of a run are made in the records: those in which only Talus looks at the particles.
// The arrays of LAMMPS are then neither read nor written. GranularSystem asks it in each step.

#ifndef TALUS_SYSTEM_STEP_STEPS_IN_RECORDS_H
#define TALUS_SYSTEM_STEP_STEPS_IN_RECORDS_H

#include "system/host/fix_calls.h"
#include "system/monitor/style_report.h"

#include "lmptype.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;
class Integrators;

/// A fix of LAMMPS, whose calls are these, reads or changes particles in every step.
bool acts_within_steps(const LAMMPS_NS::Fix *fix, int mask);

class StepsInRecords : protected LAMMPS_NS::Pointers {
 public:
  /// `run_integrators`: of the system.
  StepsInRecords(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner, Integrators &run_integrators) :
      Pointers(lmp), system(owner), integrators(run_integrators), styles(lmp), calls(lmp, owner)
  {
  }

  /// At the start of a run, after set-up: finds out whether it may have such steps, and prints which
  /// styles are accelerated, if that has changed. Collective; `pairs_computed`: the run style calls
  /// the pair style.
  void start_run(bool pairs_computed);
  /// Before set-up: only prints; the same.
  void report(bool pairs_computed);
  /// This step is one of them. `tallied`: energies or virials are asked for in it.
  bool include(LAMMPS_NS::bigint step, bool tallied) const;
  /// What calls the fixes of any step.
  FixCalls &fix_calls() { return calls; }
  const FixCalls &fix_calls() const { return calls; }

 private:
  std::string find_reason_against(bool pairs_computed);
  std::string reason_of_scene(bool pairs_computed) const;
  bool is_looked_at(LAMMPS_NS::bigint step) const;

  GranularSystem &system;
  Integrators &integrators;
  StyleReport styles;
  FixCalls calls;
  std::string reason = "no run yet";               // "" if this run has such steps, as text for
                                                   // messages
  std::vector<LAMMPS_NS::Fix *> at_end_of_step;    // fixes that may change particles then
};

}    // namespace Talus

#endif
