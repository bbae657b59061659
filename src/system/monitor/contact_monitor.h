// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Two checks of a run, for what the laws and the time step are not made for:
//
//   overlap   two particles overlap by more than a tenth of the smaller radius: the laws are those
//             of small overlaps
//   move      a particle moves by more than a tenth of its radius in a time step (of a shape: the fastest
//             point of its surface may, and the radius is that of the largest sphere inside): it may
//             be deep in another one, or through it, before it feels a force

#ifndef TALUS_SYSTEM_MONITOR_CONTACT_MONITOR_H
#define TALUS_SYSTEM_MONITOR_CONTACT_MONITOR_H

#include "contact/contact_pipeline.h"
#include "pointers.h"
#include "system/monitor/run_monitor.h"

#include <functional>
#include <string>
#include <vector>

namespace Talus {
class ShapedParticles;
}

namespace LAMMPS_NS {

class ContactMonitor : protected Pointers {
 public:
  static constexpr double largest_overlap =
      Talus::DeepestContact::watched;    ///< over the smaller radius
  /// A deep overlap is told once, and again if it is so many times as deep.
  static constexpr double much_deeper = 1.5;
  static constexpr double largest_move = 0.1;    ///< over the radius

  /// Overlaps over the radius that no impact should have.
  static constexpr double deep = 0.5;

  /// What to do about an overlap above the limit and not deep, which was not there from the
  /// beginning. `power`: see ContactSides::stiffness_power().
  static std::string remedy_for(double overlap, double power);

  explicit ContactMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  /// `find_deepest`: of the contacts since the last rebuild, with particles still numbered as then.
  /// This object must live as long as the checks.
  std::vector<RunMonitor::Check> checks(std::function<Talus::DeepestContact()> find_deepest);

 private:
  RunMonitor::Finding overlap_of(const Talus::DeepestContact &deepest) const;
  RunMonitor::Finding largest_own_move() const;
  double speed_over_radius(int i, const Talus::ShapedParticles &shapes) const;
  void warn_overlap(const RunMonitor::Finding &worst) const;
  void warn_move(const RunMonitor::Finding &worst) const;
};

}    // namespace LAMMPS_NS

#endif
