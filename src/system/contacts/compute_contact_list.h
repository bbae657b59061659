// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Internal compute TALUS_CONTACT_LIST: contacts for a dump, which cannot ask for neighbor lists itself.
// It calculates nothing.

#ifndef LMP_COMPUTE_CONTACT_LIST_H
#define LMP_COMPUTE_CONTACT_LIST_H

#include "system/contacts/contact_list.h"
#include "system/contacts/contact_observer.h"
#include "system/step/granular_system.h"

#include "compute.h"

#include <memory>

namespace LAMMPS_NS {

class ComputeContactList : public Compute, private Talus::ContactObserver {
 public:
  ComputeContactList(LAMMPS *lmp, int narg, char **arg) :
      Compute(lmp, narg, arg), contacts(lmp), system(Talus::GranularSystem::of(lmp))
  {
    system->account().add_observer(this);
  }
  ~ComputeContactList() override { system->account().drop_observer(this); }

  void init() override
  {
    contacts.set_list(nullptr);
    if (contacts.problem().empty()) contacts.request(this);
  }
  void init_list(int, NeighList *list) override { contacts.set_list(list); }

  Talus::ContactList contacts;

 private:
  bool asks_for_work() const override { return false; }

  std::shared_ptr<Talus::GranularSystem> system;
};

}    // namespace LAMMPS_NS

#endif
