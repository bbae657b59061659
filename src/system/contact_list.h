// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// All contacts of a step, one after another, for outputs: of particles with each other, with large
// bodies and with walls. Pairs of a pair style of Talus are told by GranularSystem; those of other
// granular styles by Pair::single(), which has to tell the tangential force in the first three of
// its extra values, and needs a neighbor list.
//
//   in init() of a compute    problem(), then request()
//   in its init_list()        set_list()
//   in a step with output     for_each()

#ifndef TALUS_SYSTEM_CONTACT_LIST_H
#define TALUS_SYSTEM_CONTACT_LIST_H

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

  /// "" or why the pair style does not tell its contacts, for people.
  std::string problem() const;
  void request(LAMMPS_NS::Compute *owner);
  void set_list(LAMMPS_NS::NeighList *its) { list = its; }
  /// The contacts of pairs can be told now.
  bool is_known() const;

  /// Calls visit for each contact once, on one rank; its second particle may be a ghost. Of pairs of
  /// other styles than ours only particles, normal, overlap, force and arms are told. Positions of
  /// ghosts must be up to date, as they are in steps that the host looks at. Collective.
  using VisitContact = std::function<void(const SurveyedContact &)>;
  void for_each(const VisitContact &visit) const;

 private:
  void for_each_pair_of_host(const VisitContact &visit) const;
  void visit_pair(int i, int neighbor_of_i, const VisitContact &visit) const;
  bool is_for_me(int i, int j) const;

  std::shared_ptr<GranularSystem> system;
  LAMMPS_NS::NeighList *list = nullptr;
};

}    // namespace Talus

#endif
