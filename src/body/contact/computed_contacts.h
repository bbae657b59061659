// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with one large body or wall as the last computation of forces has found
// them, for outputs. The computation writes them as it goes, in steps in which somebody may ask;
// asking only reads them. So what is told is what acted, at the positions that were used, whatever
// has moved since; and it does not matter whether or how often somebody asks.
//
//   a computation of forces   begin(), add()
//   outputs                   for_each()

#ifndef TALUS_BODY_CONTACT_COMPUTED_CONTACTS_H
#define TALUS_BODY_CONTACT_COMPUTED_CONTACTS_H

#include "laws/contact_energy.h"
#include "material/law_table.h"

#include <functional>
#include <memory>
#include <vector>

namespace Talus {

/// What a computation leaves of one contact. Stored energies are found from it when somebody asks.
struct ComputedContact {
  ContactReport report;          ///< all but `stored`, and without a number of the body
  ContactState<double> state;    ///< what its law has read
  int row = 0;                   ///< of the table of laws
  /// Of points of shapes: by these the energies of springs and of the normal law are multiplied.
  double weight = 1.0, energy = 1.0;

  /// The report with `stored`, by the laws and the time step of the computation.
  ContactReport with_energy(const LawTable &laws, double dt) const;
};

class ComputedContacts {
 public:
  /// Forgets the contacts of the step before. `of`: the laws of those that follow; `time_step`: that
  /// of their computation.
  void begin(const std::shared_ptr<const LawTable> &of, double time_step);
  void forget() { contacts.clear(); }
  /// Takes the contacts of a thread or chunk behind those that are there.
  void add(const std::vector<ComputedContact> &more);
  void add(const ComputedContact &one) { contacts.push_back(one); }

  /// visit(contact), in the order in which they were added.
  using VisitContact = std::function<void(const ContactReport &)>;
  void for_each(const VisitContact &visit) const;

  double memory_usage() const
  {
    return static_cast<double>(contacts.capacity() * sizeof(ComputedContact));
  }

 private:
  std::vector<ComputedContact> contacts;
  std::shared_ptr<const LawTable> laws;
  double dt = 0.0;
};

}    // namespace Talus

#endif
