// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Base of computes that read contacts. As long as one is registered with EnergyAccount, the work of
// contacts is accounted for in each step if asks_for_work(), and the contacts of the last step of a
// run stay available after it.

#ifndef TALUS_SYSTEM_CONTACTS_CONTACT_OBSERVER_H
#define TALUS_SYSTEM_CONTACTS_CONTACT_OBSERVER_H

namespace Talus {

class ContactObserver {
 public:
  ContactObserver() = default;
  ContactObserver(const ContactObserver &) = delete;
  ContactObserver &operator=(const ContactObserver &) = delete;

  virtual bool asks_for_work() const = 0;
  /// Rows of six by local index, asked for in each step: receive the work of each particle's
  /// contacts, see WorkAccount. nullptr: only the sum is needed.
  virtual double **work_by_particle() { return nullptr; }

 protected:
  ~ContactObserver() = default;    // those of LAMMPS may throw
};

}    // namespace Talus

#endif
