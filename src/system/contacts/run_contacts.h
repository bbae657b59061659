// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The contacts of the last step, for outputs: of particles with each other, with large bodies and
// with walls, as the computation of forces has left them. Nothing is found anew and nothing is
// changed when they are asked for. After a run they stay as they are until the next set-up, for those
// who observe contacts (see contact_observer.h), whatever moves in between; only that particles or
// bodies are others is noticed, and is an error.

#ifndef TALUS_SYSTEM_CONTACTS_RUN_CONTACTS_H
#define TALUS_SYSTEM_CONTACTS_RUN_CONTACTS_H

#include "contact/contact_survey.h"
#include "laws/contact_energy.h"

#include "pointers.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace Talus {

class GranularSystem;
class StateExchange;

class RunContacts : protected LAMMPS_NS::Pointers {
 public:
  RunContacts(LAMMPS_NS::LAMMPS *lmp, GranularSystem &owner) : Pointers(lmp), system(owner) {}

  /// visit(contact) for those on this rank, those with a ghost as well. After a run only as long as
  /// someone observes them, and collective then.
  using VisitContact = ContactSurvey::VisitContact;
  void for_each(ContactData requested, const VisitContact &visit) const;
  /// Of those that two ranks know, or one twice, only one is.
  bool is_of_this_rank(const ContactReport &one) const;
  /// During a run; after it, if someone observes them.
  bool are_known() const;
  /// Pairs of particles that touch on this rank; those that another one has as well count half.
  double count() const;
  /// Pairs that may touch; the same.
  double count_candidates() const;
  /// Of the pairs that touch on this rank.
  DeepestContact deepest() const;
  /// The same of all that have touched since the last rebuild, if it is deeper than
  /// DeepestContact::watched; otherwise that.
  DeepestContact deepest_since_rebuild() const;
  /// History of the contact of local indices i and j, with the signs of i, in a run or between two;
  /// none if they do not touch.
  std::optional<HistoryValues> history_of(int i, int j) const;

  // ---- by the system

  /// New ones are being computed, or the pair style is going.
  void forget();
  /// A run has ended: until the next one its contacts stay, for those who observe them.
  void end_run();
  /// LAMMPS is initialized: the last moment at which those of the last run can be found, for
  /// commands such as write_restart then send particles to other ranks.
  void keep();
  /// For snapshots: contacts of the last step, if someone observes them; the pipeline has its histories again.
  void exchange_state(StateExchange &x);

 private:
  /// A contact of the last run, whose particles may have other local indices by now.
  struct KeptContact {
    ContactReport contact;
    std::int64_t tag[2];    ///< of its particles
  };
  /// What a rank has of the contacts of the last run.
  enum class Known { NONE, OLD, ALL };
  std::uint64_t digest_of_owners() const;
  Known known_after_run(std::vector<ContactReport> &of_kept) const;
  void require_those_of_last_run(Known here) const;
  void visit_all(ContactData requested, const VisitContact &visit) const;
  int present_index(const KeptContact &one, int end) const;
  bool find_kept(std::vector<ContactReport> &all) const;

  GranularSystem &system;
  /// After a run whose contacts are observed: digest of whose they are; and contacts that have been
  /// kept because particles may have other local indices since, with the number of particles then.
  std::optional<std::uint64_t> digest_after_run;
  std::optional<std::vector<KeptContact>> kept;
  std::int64_t kept_of = 0;
};

}    // namespace Talus

#endif
