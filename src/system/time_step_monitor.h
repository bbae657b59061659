// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Warnings about the time step:
//
//   too large   above 20 % of the smallest critical one: said at the start of a run, or when the
//               neighbor lists are rebuilt with smaller particles than those at its start
//   undamped    contacts that need a smaller one still: see undamped_friction.h and
//               elastic_impacts.h; said at the start of a run
//
// Used by pair gran/penalty, beside ContactMonitor.

#ifndef TALUS_SYSTEM_TIME_STEP_MONITOR_H
#define TALUS_SYSTEM_TIME_STEP_MONITOR_H

#include "contact/contact_pipeline.h"
#include "material/law_book.h"
#include "pointers.h"
#include "system/critical_time_step.h"

namespace LAMMPS_NS {

class TimeStepMonitor : protected Pointers {
 public:
  static constexpr double advised = 0.2;    ///< of the critical time step

  explicit TimeStepMonitor(LAMMPS *lmp) : Pointers(lmp), critical(lmp) {}

  /// A run is prepared: there is nothing to say until judge_start().
  void start() { said = true; }

  /// Collective, at the start of a run. `contacts` are those of its first step.
  void judge_start(const Talus::LawBook &laws, const Talus::ContactPipeline &contacts);

  /// Collective, when the neighbor lists are about to be rebuilt.
  void look_for_smaller_particles(const Talus::LawBook &laws);

 private:
  void judge();

  CriticalTimeStep critical;
  double limit_at_start = 0.0;    ///< from the sizes of particles, of the present run (time)
  bool said = true;               ///< too large; the same on all ranks
};

}    // namespace LAMMPS_NS

#endif
