// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Where the internal fix is that moves what contacts remember with the particles (FixContactStore): it is made
// when somebody has contacts to remember, and goes with the last who has.

#ifndef TALUS_SYSTEM_CONTACTS_CONTACT_STORE_H
#define TALUS_SYSTEM_CONTACTS_CONTACT_STORE_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {
class FixContactStore;
}

namespace Talus {

class ContactStore : protected LAMMPS_NS::Pointers {
 public:
  explicit ContactStore(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// nullptr: it has not been made.
  LAMMPS_NS::FixContactStore *get() const { return fix; }
  /// In the constructor of a pair style, which may come before the box: an internal fix that does nothing keeps
  /// the place in the list of fixes.
  void keep_place();
  /// By those who have contacts to remember, when there is a box: not in constructors of fixes, nor in their init().
  void create();
  /// An error where it should be there, and a script has deleted it. `command`: who asks.
  void require(const std::string &command) const;
  /// After the last who had contacts to remember.
  void remove();

  /// By the fix, as soon as it is there and when it goes.
  void is_there(LAMMPS_NS::FixContactStore *store) { fix = store; }
  void is_gone() { fix = nullptr, was_there = true; }

 private:
  LAMMPS_NS::FixContactStore *fix = nullptr;
  bool was_there = false;    // since keep_place()
};

}    // namespace Talus

#endif
