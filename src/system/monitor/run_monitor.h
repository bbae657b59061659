// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The warnings of a run: one place that evaluates all checks and prints.
//
// A check is a number that each rank finds on its own, and a limit. Whenever contacts are looked at
// (at the start of a run, whenever the neighbor lists are about to be rebuilt, and at its end, not
// in every step), the largest values of all ranks are found for all checks at once, in one
// reduction. Only where a limit is exceeded more messages follow: the rank that has the largest
// value tells the others what they need to know, and the check says it. Each check speaks once in a
// run, or once for all unless it becomes worse. GranularSystem owns the monitor of a LAMMPS
// instance.
//
// Thresholds stand beside the checks: ContactMonitor, TimeStepMonitor, LargeBodyMonitor.

#ifndef TALUS_SYSTEM_MONITOR_RUN_MONITOR_H
#define TALUS_SYSTEM_MONITOR_RUN_MONITOR_H

#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <functional>
#include <vector>

namespace LAMMPS_NS {

class RunMonitor : protected Pointers {
 public:
  /// What a rank has found. The rank with the largest value sends its details, such as atom IDs.
  /// A value that is not a number counts as zero: it is another trouble.
  struct Finding {
    double value = 0.0;
    std::array<double, 4> details{};
  };

  struct Check {
    double limit;
    /// Of this rank, without communication; asked unless the check has spoken.
    std::function<Finding()> evaluate;
    /// The value of all ranks is above the limit. Called on all ranks, which may communicate.
    /// Returns whether that was all for this run; if not, look() goes on.
    std::function<bool(const Finding &worst)> warn;
    /// What has been said in an earlier run is only said again of a value that is so many times as
    /// large; 0: in each run.
    double worse = 0.0;
  };

  explicit RunMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// Adds the checks of `owner`, on all ranks in the same order; remove() takes them back.
  void add(const void *owner, std::vector<Check> checks);
  void remove(const void *owner);

  /// A run begins: everything may be said again.
  void start();

  /// Steps are repeated: what has been said stays said.
  void forget_step() { last_step = -1; }

  enum class Moment { SETUP, REBUILD, END };
  /// Collective: one reduction. Does nothing if it has been called for this moment before:
  /// everybody who owns a check may call it.
  void look(Moment moment);

 private:
  struct Entry {
    const void *owner;
    Check check;
    bool said;
    double told = 0.0;    ///< largest value that has been said
  };
  Finding from_worst(const Finding &mine, double value, int rank) const;

  std::vector<Entry> entries;
  bigint last_step = -1;
  Moment last_moment = Moment::END;
};

}    // namespace LAMMPS_NS

#endif
