// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two checks of fix large/body, as ContactMonitor has them for pairs:
//
//   overlap   a particle overlaps the body by more than a tenth of its radius: the laws are those
//             of small overlaps
//   move      a particle near a body that moves goes by more than a tenth of its radius past it in
//             a time step: it may be deep in the body, or through it, before it feels a force

#ifndef TALUS_FIX_LARGE_BODY_MONITOR_H
#define TALUS_FIX_LARGE_BODY_MONITOR_H

#include "body/contact/body_contacts.h"
#include "pointers.h"
#include "system/run_monitor.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class LargeBodyMonitor : protected Pointers {
 public:
  static constexpr double largest_overlap = 0.1;    ///< over the radius
  static constexpr double largest_move = 0.1;       ///< over the radius

  explicit LargeBodyMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// `find_worst`: of the particles of this rank; `moves`: whether the body does. This object must live as
  /// long as the checks.
  std::vector<RunMonitor::Check> checks(std::function<Talus::BodyFindings()> find_worst,
                                        std::function<bool()> moves, const std::string &id);

 private:
  RunMonitor::Finding finding(double value, int particle) const;

  std::function<Talus::BodyFindings()> look;
  Talus::BodyFindings worst;
  bool just_looked = false;    ///< for the first of the two checks
};

}    // namespace LAMMPS_NS

#endif
