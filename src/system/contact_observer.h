// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Someone who asks about contacts: a compute. As long as one is registered with EnergyAccount, the
// work of contacts is accounted for in each step if it asks for that, and the contacts of the last
// step of a run can still be asked for behind it.

#ifndef TALUS_SYSTEM_CONTACT_OBSERVER_H
#define TALUS_SYSTEM_CONTACT_OBSERVER_H

namespace Talus {

class ContactObserver {
 public:
  ContactObserver() = default;
  ContactObserver(const ContactObserver &) = delete;
  ContactObserver &operator=(const ContactObserver &) = delete;

  virtual bool asks_for_work() const = 0;
  /// Rows of six by host's index, asked for in each step: receive the work of each particle's
  /// contacts, see WorkAccount. nullptr: only the sum is needed.
  virtual double **work_by_particle() { return nullptr; }

 protected:
  ~ContactObserver() = default;    // those of the host may throw
};

}    // namespace Talus

#endif
