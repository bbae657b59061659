// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What is known of the pair, bond and run styles of Talus besides what they tell GranularSystem; and how that
// run style becomes LAMMPS' default.

#ifndef TALUS_SYSTEM_HOST_SYSTEM_STYLE_H
#define TALUS_SYSTEM_HOST_SYSTEM_STYLE_H

#include <string>

namespace LAMMPS_NS {
class Bond;
class Integrate;
class LAMMPS;
class Pair;
}    // namespace LAMMPS_NS

namespace Talus {

class SystemStyle {
 public:
  /// nullptr of styles of LAMMPS, and of none.
  static const SystemStyle *of(const LAMMPS_NS::Pair *pair);
  static const SystemStyle *of(const LAMMPS_NS::Bond *bond);
  static const SystemStyle *of(const LAMMPS_NS::Integrate *run_style);

  /// As scripts have it, without a suffix.
  virtual std::string plain_style() const = 0;

  /// After init_style(), of run styles in setup() and run(): "" if Talus computes the contacts or bonds or makes the
  /// steps, else why the stock methods do.
  virtual std::string reason_for_stock() const = 0;
  /// Of bond styles, at the start of a run: "" or why they need particles in the arrays of LAMMPS in this run.
  virtual std::string needs_arrays() const { return ""; }

 protected:
  ~SystemStyle() = default;    // never deleted through this interface
};

/// Makes run style `verlet` of LAMMPS that of Talus, which is registered as verlet/proxy, also
/// the present one unless the user has chosen another. Collective, at any time between two runs:
/// when the plugin is loaded, and when a pair style of Talus is defined, since some hosts bring
/// back all styles of a plugin after `clear` without telling it.
void make_run_style_the_default(LAMMPS_NS::LAMMPS *lmp);

}    // namespace Talus

#endif
