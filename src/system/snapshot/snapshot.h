// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The whole state of a simulation in memory, with all bits: steps after restore() repeat those after
// the snapshot was made, on any number of ranks and threads.
//
// Each rank keeps its own particles, as they are in the arrays of LAMMPS between two runs, and takes them back:
// none is sent, and none is put into its period, which would round its position. Neighbor lists stay where they
// are still those of then, else they are made again as they were (saved_lists.h). What is not state: what a script
// defines (fixes, laws, groups, regions, variables), files, and what outputs have gathered.

#ifndef TALUS_SYSTEM_SNAPSHOT_SNAPSHOT_H
#define TALUS_SYSTEM_SNAPSHOT_SNAPSHOT_H

#include "base/state_exchange.h"
#include "system/snapshot/saved_clock.h"
#include "system/snapshot/saved_fixes.h"
#include "system/snapshot/saved_lists.h"
#include "system/snapshot/saved_particles.h"

#include "pointers.h"

#include <memory>
#include <string>

namespace Talus {

class GranularSystem;

class Snapshot : protected LAMMPS_NS::Pointers {
 public:
  /// Between runs: "", or why the scene cannot be saved and the cure.
  static std::string reason_against(LAMMPS_NS::LAMMPS *lmp, GranularSystem &system);
  /// Collective, between two runs, after a first one. Throws std::bad_alloc on all ranks, if one has not enough
  /// memory.
  Snapshot(LAMMPS_NS::LAMMPS *lmp, GranularSystem &of);

  /// "", or why it cannot be restored: it is of another instance, or the scene has changed since.
  std::string reason_against_restoring(const GranularSystem &into) const;
  /// Collective, between two runs. Ends in an error of LAMMPS where neighbor lists cannot be made again.
  void restore() const;
  /// Bytes on this rank.
  double memory_usage() const;

 private:
  void save();
  void restore_lists() const;

  GranularSystem &system;
  std::weak_ptr<GranularSystem> instance;
  SavedClock clock;
  SavedLists lists;
  SavedParticles particles;
  SavedFixes fixes;
  SavedState of_store, of_contacts, of_system;
};

}    // namespace Talus

#endif
