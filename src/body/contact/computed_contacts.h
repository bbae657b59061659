// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with one large body or wall as the last computation of forces has found
// them, for outputs. The computation writes them as it goes, in steps in which somebody may ask;
// asking only reads them. So what is told is what acted, at the positions that were used, whatever
// has moved since, and outputs change nothing. Where no command lists contacts only their energy is
// kept, which outputs of a body have.
//
//   a step                    begin()
//   a computation of forces   add()
//   outputs                   for_each(), stored_energy()

#ifndef TALUS_BODY_CONTACT_COMPUTED_CONTACTS_H
#define TALUS_BODY_CONTACT_COMPUTED_CONTACTS_H

#include "laws/contact_energy.h"
#include "material/law_table.h"

#include <functional>
#include <vector>

namespace Talus {

/// What a computation leaves of one contact of a shape.
struct ComputedContact {
  ContactReport report;          ///< all but `stored`, and without a number of the body
  ContactState<double> state;    ///< what its law has read
  int row = 0;                   ///< of the table of laws
  /// By these the energies of springs and of the normal law are multiplied.
  double weight = 1.0, energy = 1.0;

  /// The report with `stored`, by the laws and the time step of the computation.
  ContactReport with_energy(const LawTable &laws, double dt) const;
};

class ComputedContacts {
 public:
  /// A step begins: those of the one before are forgotten. `are_listed`: somebody lists contacts.
  void begin(bool are_listed);
  bool are_listed() const { return listed; }
  /// Takes the contacts of a thread behind those that are there, and what they store.
  void add(std::vector<ContactReport> &&more, double energy);
  void add(const ContactReport &one);

  /// visit(contact), in the order in which they were added; none if they are not listed.
  using VisitContact = std::function<void(const ContactReport &)>;
  void for_each(const VisitContact &visit) const;
  /// Of all contacts, listed or not (energy); without that which is lost when they are pulled apart.
  double stored_energy() const { return stored; }

  double memory_usage() const;

 private:
  bool listed = false;
  std::vector<std::vector<ContactReport>> rows;
  double stored = 0.0;
};

/// The part of its stored energy that ComputedContacts::stored_energy() sums.
inline double kept_energy(const ContactReport &one)
{
  return one.stored.normal - one.stored.detaching;
}

}    // namespace Talus

#endif
