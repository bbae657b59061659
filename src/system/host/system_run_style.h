// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the system knows of the run style: update->integrate of LAMMPS, if it is that of Talus;
// and how it becomes LAMMPS' default.

#ifndef TALUS_SYSTEM_HOST_SYSTEM_RUN_STYLE_H
#define TALUS_SYSTEM_HOST_SYSTEM_RUN_STYLE_H

#include <string>

namespace LAMMPS_NS {
class Integrate;
class LAMMPS;
}    // namespace LAMMPS_NS

namespace Talus {

class SystemRunStyle {
 public:
  /// nullptr of run styles of LAMMPS.
  static SystemRunStyle *of(LAMMPS_NS::Integrate *style);
  static const SystemRunStyle *of(const LAMMPS_NS::Integrate *style)
  {
    return of(const_cast<LAMMPS_NS::Integrate *>(style));
  }

  /// "" if it makes the steps of this run itself, else why it calls those of LAMMPS. Valid in
  /// setup() and run().
  virtual std::string reason_for_stock() const = 0;
  /// Neighbor lists have been made between two runs, not by it.
  virtual void lists_are_made() = 0;
  /// A run with this object has been set up: it has no other way to know of what it calls.
  virtual bool was_set_up() const = 0;

 protected:
  ~SystemRunStyle() = default;    // never deleted through this interface
};

/// Makes run style `verlet` of LAMMPS that of Talus, which is registered as verlet/proxy, also
/// the present one unless the user has chosen another. Collective, at any time between two runs:
/// when the plugin is loaded, and when a pair style of Talus is defined, since some hosts bring
/// back all styles of a plugin after `clear` without telling it.
void make_run_style_the_default(LAMMPS_NS::LAMMPS *lmp);

}    // namespace Talus

#endif
