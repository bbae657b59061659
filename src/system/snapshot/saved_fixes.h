// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Part of a snapshot: what fixes know. Those of Talus exchange their state themselves
// (SystemFix::exchange_state()); of others, and of those that do not, it is what travels with particles
// and what they write into restart files. That is all that fixes of LAMMPS know of the past if they can be
// continued from a restart file; those that cannot are named by reason_against().

#ifndef TALUS_SYSTEM_SNAPSHOT_SAVED_FIXES_H
#define TALUS_SYSTEM_SNAPSHOT_SAVED_FIXES_H

#include "base/state_exchange.h"
#include "system/host/private_members.h"

#include "lmptype.h"
#include "pointers.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
}

namespace Talus {

class GranularSystem;

class SavedFixes : protected LAMMPS_NS::Pointers {
 public:
  SavedFixes(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// Between runs: "", or which fix cannot be saved and the cure, as text for messages.
  std::string reason_against() const;
  /// The first part is collective; the second is not and may run out of memory.
  void save_globals();
  void save();
  /// "", or which fix has been added or deleted since.
  std::string reason_against_restoring() const;
  /// Once particles are back in the arrays of LAMMPS.
  void restore_particles() const;
  /// After it, when ghosts and lists are there. Collective.
  void restore_globals() const;
  double memory_usage() const;

 private:
  struct One {
    std::string id, style;
    LAMMPS_NS::bigint next_rebuild = 0;
    std::array<double, 6> virial{};
    std::vector<char> in_restart_file;
    std::vector<double> with_particles;
    SavedState state;
    PouringState pouring;
  };
  bool is_own(const LAMMPS_NS::Fix *fix) const;
  bool follows_particles(const LAMMPS_NS::Fix *fix) const;
  std::vector<char> written_by(LAMMPS_NS::Fix *fix) const;
  void pack(LAMMPS_NS::Fix *fix, std::vector<double> &to) const;

  GranularSystem &system;
  std::vector<One> fixes;
};

}    // namespace Talus

#endif
