// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact history stored by candidate pair during a run: one record for each pair, zero unless the
// pair touches, seen from the first particle of the pair; and a second one, the onset of the
// contact, in scenes with a law that needs it.

#ifndef TALUS_CONTACT_CONTACT_HISTORY_H
#define TALUS_CONTACT_CONTACT_HISTORY_H

#include "contact/candidate_list.h"
#include "contact/partner_lists.h"
#include "contact/record.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace Talus {

class ContactHistory {
 public:
  /// After a rebuild: takes the history of each pair from the lists of whichever of its particles
  /// is owned. `filed_tag` is the name of each particle (host's index) in the lists, 0 if it is in
  /// none; it differs from the tag if IDs were renumbered since. Pairs without history start at
  /// zero. Onsets are kept if the lists have 8 values.
  void fetch(const CandidateList &pairs, const PartnerLists &partners,
             const std::vector<std::int64_t> &filed_tag);

  /// Before particles are renumbered: the history of every touching pair is filed under each of its
  /// owned particles that the list serves. First announce(), then PartnerLists::layout(), then
  /// file(); each may run for different parts of a rank at the same time.
  void announce(const CandidateList &pairs, PartnerLists &partners) const;
  void file(const CandidateList &pairs, PartnerLists &partners) const;

  /// After file(): pairs whose first particle is a ghost take over the history that its owner has
  /// filed, which ghost_values(host's index of the first, tag of the second) returns or nullptr.
  void
  adopt_first_copies(const CandidateList &pairs, PartnerLists &partners,
                     const std::function<const double *(int, std::int64_t)> &ghost_values) const;

  /// Gives all memory back: for scenes whose laws keep no history.
  void release();

  /// Sets the history of a pair that has separated to zero; `block` is the pair's index / 8.
  void forget(std::int64_t block, unsigned separated);

  bool touches(std::int64_t pair) const { return touching[pair / 8] >> (pair % 8) & 1U; }
  double memory_usage() const;

  BigVector<Record> records;             ///< indexed like the candidate pairs
  BigVector<Record> onsets;              ///< the same, or empty
  std::vector<std::uint8_t> touching;    ///< one bit for each pair: it touched when last computed

 private:
  template <class Visit> void for_each_end(const CandidateList &pairs, Visit visit) const;
  void file_entry(double *values, std::int64_t pair, bool from_first) const;
};

}    // namespace Talus

#endif
