// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contacts remember: of pairs of spheres, of particles with a shape, with large bodies and with
// walls. While steps are made each holder has its contacts in the form that it computes with. Before
// particles get other indices, leave or are saved, holders put them aside into lists by particle
// (ContactLists), which one fix of LAMMPS moves, sends and saves; at the next rebuild each holder takes
// its own. A contact is with its holder or in the lists. Contacts of a holder that is gone are dropped.
//
//   put_aside()         before a rebuild, after a run, before a file or a snapshot is written; and before
//                       a particle is moved or forgotten
//   are_taken()         by a holder that has read its contacts out of the lists
//
// Contacts between spheres are put aside by slots instead (HistoryStore); of these only those of
// particles that came from another rank or a file are in the lists.

#ifndef TALUS_HISTORY_CONTACT_MEMORY_H
#define TALUS_HISTORY_CONTACT_MEMORY_H

#include "base/state_exchange.h"
#include "history/contact_lists.h"
#include "history/history_store.h"

#include <cstdint>
#include <string>
#include <vector>

namespace Talus {

class ContactMemory {
 public:
  class Holder {
   public:
    /// Its contacts are in the lists. True of a new one: there may be some out of a restart file.
    bool is_at_rest() const { return at_rest; }
    /// This contact of the lists is one of its own.
    virtual bool owns(const ContactLists::Contact &one) const = 0;
    /// Adds all contacts to the lists, while particles have the indices that it knows. Other ranks may not do so now.
    virtual void put_aside(ContactLists &to) = 0;

   protected:
    ~Holder() = default;

   private:
    friend class ContactMemory;
    bool at_rest = true, was_awake = false;
  };

  explicit ContactMemory(int this_rank = 0) : store(this_rank) { add(spheres); }
  ContactMemory(const ContactMemory &) = delete;
  ContactMemory &operator=(const ContactMemory &) = delete;

  /// Contacts with this body or wall, the same in every process: negative.
  static std::int64_t name_of(const std::string &id);

  void add(Holder &holder);
  /// With all that it had; but not what a file has brought for it, if it has never taken that.
  void remove(const Holder &holder);
  /// There are more than those of spheres.
  bool has_others() const { return holders.size() > 1; }

  HistoryStore &pairs() { return store; }
  const ContactLists &lists() const { return store.lists; }

  void put_aside()
  {
    if (awake) put_all_aside();
  }
  /// By one that is at rest: it has read its contacts, or they are about to change.
  void are_taken(Holder &holder);
  /// Those of spheres have been taken: particles have these slots from here on, see HistoryStore::number().
  void are_numbered(const ParticleOrder &present);
  /// What is put aside of spheres is not needed: pairs have later ones, or there are none.
  void drop_spheres();
  /// Further contacts of one that is at rest.
  ContactLists &lists_to_fill() { return store.lists; }

  /// For snapshots, between two runs; all are at rest when it is restored.
  void exchange_state(StateExchange &x);
  double memory_usage() const { return store.memory_usage(); }

 private:
  /// Of the pairs of spheres.
  class Spheres : public Holder {
   public:
    bool owns(const ContactLists::Contact &one) const override
    {
      return HistoryStore::is_of_spheres(one);
    }
    void put_aside(ContactLists & /*to*/) override {}
  };

  void put_all_aside();

  HistoryStore store;
  Spheres spheres;
  std::vector<Holder *> holders;
  std::size_t awake = 0;    // of these, not at rest
};

}    // namespace Talus

#endif
