// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What GranularSystem knows of the fixes of Talus. It finds them in the list of the host, so that
// the order in which they act is that of the script.

#ifndef TALUS_SYSTEM_SYSTEM_FIX_H
#define TALUS_SYSTEM_SYSTEM_FIX_H

#include <string>

namespace Talus {

/// A fix that does its work on particles in the records as well as in the arrays of LAMMPS.
class SystemFix {
 public:
  /// At the start of a run, collective: "", or why it needs the arrays of LAMMPS in this run.
  virtual std::string needs_host_arrays() = 0;

  /// It moves particles.
  virtual bool integrates() const { return false; }

 protected:
  ~SystemFix() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
