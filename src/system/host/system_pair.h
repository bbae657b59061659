// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What is known of the pair styles of Talus besides what they tell GranularSystem.

#ifndef TALUS_SYSTEM_HOST_SYSTEM_PAIR_H
#define TALUS_SYSTEM_HOST_SYSTEM_PAIR_H

#include <string>

namespace LAMMPS_NS {
class Pair;
}

namespace Talus {

class SystemPair {
 public:
  /// nullptr of pair styles of LAMMPS, and of none.
  static const SystemPair *of(const LAMMPS_NS::Pair *pair);

  /// As scripts have it, without a suffix.
  virtual std::string plain_style() const = 0;

  /// After init_style(): "" if GranularSystem computes the contacts, else why the stock methods do.
  virtual std::string reason_for_stock() const = 0;

 protected:
  ~SystemPair() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
