// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the contacts of the last compute() of a pipeline are asked: for outputs and diagnostics, not part
// of a step. Changes nothing. While the pairs are there; pairs that another rank computes as well count
// half, so that sums over all ranks are those of pairs.

#ifndef TALUS_CONTACT_CONTACT_SURVEY_H
#define TALUS_CONTACT_CONTACT_SURVEY_H

#include "contact/contact_pipeline.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace Talus {

class ContactSurvey {
 public:
  explicit ContactSurvey(const ContactPipeline &contacts) : of(contacts) {}

  /// Touching and candidate pairs.
  double count_contacts() const;
  double count_candidates() const;
  /// Share of the candidate pairs that compute_early() computes; 0 in one phase.
  double early_share() const;

  /// visit(contact) for each contact, with the state that was found and the history after it.
  using VisitContact = std::function<void(const ContactReport &)>;
  void for_each_contact(ContactData requested, const VisitContact &visit) const;
  /// History of the contact of local indices i and j, with the signs of i; none if the pair does
  /// not touch, or in a scene without history.
  std::optional<HistoryValues> history_of(int i, int j) const;

  /// The contact with the largest overlap over the smaller radius.
  DeepestContact deepest_contact() const;
  /// The same of all that have been computed since start_pairs(), if it is deeper than
  /// DeepestContact::watched; otherwise that.
  DeepestContact deepest_since_rebuild() const;
  /// Smallest sqrt(m_eff/k) with the tangent stiffness k; 0 without contacts.
  double smallest_contact_period() const;
  /// Largest relative speed of the centers of candidate pairs.
  double largest_relative_speed() const;

 private:
  ContactReport report_of(const ContactChunk &chunk, std::int64_t pair,
                          ContactData requested) const;
  double squared_distance(int slot_a, int slot_b) const;
  double overlap_of(int slot_a, int slot_b) const;
  bool is_gap(const ContactChunk &chunk, std::int64_t pair) const;
  template <class Value, class Result> Value largest_of_chunks(Value none, Result result) const;

  const ContactPipeline &of;
};

}    // namespace Talus

#endif
