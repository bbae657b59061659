// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Warnings about the time step:
//
//   too large   above 20 % of the smallest critical one: said at the start of a run, or when the
//               neighbor lists are rebuilt with smaller particles than those at its start
//   unstable    above the largest stable one of a particle among twelve others, which may be
//               smaller where damping is strong; said with the first one
//   undamped    contacts that need a smaller one still: see undamped_friction.h and
//               elastic_impacts.h; said at the start of a run
//
// The first one is a check of the run: each rank compares its smallest particles with those that
// there were; only if one is smaller the critical time step is computed.

#ifndef TALUS_SYSTEM_MONITOR_TIME_STEP_MONITOR_H
#define TALUS_SYSTEM_MONITOR_TIME_STEP_MONITOR_H

#include "contact/contact_pipeline.h"
#include "material/pair_coeffs.h"
#include "pointers.h"
#include "system/monitor/critical_time_step.h"
#include "system/monitor/run_monitor.h"

#include <vector>

namespace LAMMPS_NS {

class TimeStepMonitor : protected Pointers {
 public:
  static constexpr double advised = 0.2;    ///< of the critical time step

  explicit TimeStepMonitor(LAMMPS *lmp) : Pointers(lmp), critical(lmp) {}

  /// A run is prepared: there is nothing to say until judge_start().
  void start() { said = true; }

  /// Collective, at the start of a run. `contacts` are those of its first step.
  void judge_start(const Talus::PairCoeffs &laws, const Talus::ContactPipeline &contacts);

  /// This object and `laws` must live as long as the check.
  RunMonitor::Check check(const Talus::PairCoeffs &laws);

 private:
  RunMonitor::Finding smaller_particles(const Talus::PairCoeffs &laws) const;
  bool judge_smaller_particles(const Talus::PairCoeffs &laws);
  void store_sizes(const Talus::PairCoeffs &laws);
  void judge();
  bool particles_move() const;
  void warn_unstable() const;
  void warn_too_large(double limit) const;

  CriticalTimeStep critical;
  double limit_at_start = 0.0;        ///< from the sizes of particles, of the present run (time)
  std::vector<double> known_sizes;    ///< see CriticalTimeStep::sizes_here(); of all ranks
  bool said = true;                   ///< too large; the same on all ranks
};

}    // namespace LAMMPS_NS

#endif
