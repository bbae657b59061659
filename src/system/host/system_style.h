// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What is known of the pair and bond styles of Talus besides what they tell GranularSystem.

#ifndef TALUS_SYSTEM_HOST_SYSTEM_STYLE_H
#define TALUS_SYSTEM_HOST_SYSTEM_STYLE_H

#include <string>

namespace LAMMPS_NS {
class Bond;
class Pair;
}    // namespace LAMMPS_NS

namespace Talus {

class SystemStyle {
 public:
  /// nullptr of styles of LAMMPS, and of none.
  static const SystemStyle *of(const LAMMPS_NS::Pair *pair);
  static const SystemStyle *of(const LAMMPS_NS::Bond *bond);

  /// As scripts have it, without a suffix.
  virtual std::string plain_style() const = 0;

  /// After init_style(): "" if Talus computes the contacts or bonds, else why the stock methods do.
  virtual std::string reason_for_stock() const = 0;

 protected:
  ~SystemStyle() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
