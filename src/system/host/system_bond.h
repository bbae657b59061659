// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What is known of the bond styles of Talus, for the log.

#ifndef TALUS_SYSTEM_HOST_SYSTEM_BOND_H
#define TALUS_SYSTEM_HOST_SYSTEM_BOND_H

#include <string>

namespace LAMMPS_NS {
class Bond;
}

namespace Talus {

class SystemBond {
 public:
  /// nullptr of bond styles of LAMMPS, and of none.
  static const SystemBond *of(const LAMMPS_NS::Bond *bond);

  /// As scripts have it, without a suffix.
  virtual std::string plain_style() const = 0;

  /// After init_style(): "" if Talus computes the bonds, else why the stock methods do.
  virtual std::string reason_for_stock() const = 0;

 protected:
  ~SystemBond() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
