// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From old neighbor lists to new ones. FixContactStore calls these at LAMMPS' hooks:
//
//   pre_exchange     keep_history(), release_pairs()
//                    LAMMPS migrates particles, which carry their slots or their histories
//   post_neighbor    renumber_pairs()

#ifndef TALUS_SYSTEM_STEP_REBUILD_H
#define TALUS_SYSTEM_STEP_REBUILD_H

#include "contact/contact_pipeline.h"
#include "history/history_store.h"
#include "system/contacts/neighbor_source.h"
#include "system/contacts/run_contacts.h"
#include "system/step/neighbor_lists.h"

#include "pointers.h"

#include <memory>
#include <optional>

namespace Talus {

class GranularSystem;

class Rebuild : protected LAMMPS_NS::Pointers {
 public:
  /// What it changes of the system, which owns all of it, and this.
  struct Parts {
    std::optional<ContactPipeline> &contacts;    ///< there whenever Rebuild is called
    LAMMPS_NS::NeighborSource &neighbors;
    RunContacts &for_outputs;
  };
  Rebuild(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner, const Parts &of_system) :
      Pointers(lmp), system(owner), parts(of_system)
  {
  }

  /// Puts histories of pairs aside. Unless the pairs stay they are gone then until renumber_pairs(), and
  /// memory is free for others.
  void keep_history(HistoryStore::Scope scope, bool pairs_stay);
  void release_pairs() { contacts().release(); }
  /// New neighbor lists are due: finds the pairs, and their histories.
  void renumber_pairs();
  /// A run has ended, and what belongs to particles has been put aside.
  void end_contacts_of_run();

  /// For snapshots: pairs as they are; and where they are to be taken from at the next rebuild, nullptr: found.
  std::shared_ptr<const ContactPipeline::Lists> pair_lists() { return contacts().lists(); }
  void take_pairs_from(const std::shared_ptr<const ContactPipeline::Lists> &lists_of_then)
  {
    given_pairs = lists_of_then;
  }

 private:
  ContactPipeline &contacts() { return *parts.contacts; }
  void find_pairs();
  void make_pairs();
  void change_order_of_histories();
  NeighborView without_shapes(const NeighborView &all);

  GranularSystem &system;
  Parts parts;
  std::shared_ptr<const ContactPipeline::Lists> given_pairs;
};

}    // namespace Talus

#endif
