// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All contacts of a step, one after another, for outputs: of particles with each other, with large
// bodies and with walls. Pairs of a pair style of Talus come from GranularSystem; those of other
// granular styles from Pair::single(), whose first three extra values have to be the tangential
// force, and which needs a neighbor list.
//
//   in init() of a compute    problem(), then request()
//   in its init_list()        set_list()
//   in a step with output     for_each()

#ifndef TALUS_SYSTEM_CONTACTS_CONTACT_LIST_H
#define TALUS_SYSTEM_CONTACTS_CONTACT_LIST_H

#include "laws/contact_energy.h"

#include "pointers.h"

#include <functional>
#include <memory>
#include <string>

namespace LAMMPS_NS {
class Compute;
class NeighList;
}    // namespace LAMMPS_NS

namespace Talus {

class GranularSystem;

class ContactList : protected LAMMPS_NS::Pointers {
 public:
  explicit ContactList(LAMMPS_NS::LAMMPS *lmp);

  /// "" or why contacts of the pair style cannot be listed, as text for messages.
  std::string problem() const;
  void request(LAMMPS_NS::Compute *owner);
  void set_list(LAMMPS_NS::NeighList *neighbor_list) { list = neighbor_list; }
  /// The contacts of pairs can be listed now.
  bool is_known() const;

  /// Calls visit for each contact once, on one rank; its second particle may be a ghost. Of pairs
  /// of styles of LAMMPS only particles, their centers, normal, overlap, force and arms are set, and
  /// positions of ghosts must be up to date, as they are in steps that LAMMPS looks at. Collective.
  using VisitContact = std::function<void(const ContactReport &)>;
  void for_each(const VisitContact &visit) const;

 private:
  void for_each_pair_of_lammps(const VisitContact &visit) const;
  void visit_pair(int i, int neighbor_of_i, const VisitContact &visit) const;
  bool is_for_me(int i, int j) const;

  std::shared_ptr<GranularSystem> system;
  LAMMPS_NS::NeighList *list = nullptr;
};

}    // namespace Talus

#endif
