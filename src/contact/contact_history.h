// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact history stored by candidate pair during a run: one record for each pair, zero unless the
// pair touches, seen from the first particle of the pair.

#ifndef TALUS_CONTACT_CONTACT_HISTORY_H
#define TALUS_CONTACT_CONTACT_HISTORY_H

#include "contact/candidate_list.h"
#include "contact/partner_lists.h"
#include "contact/record.h"

#include <cstdint>
#include <vector>

namespace Talus {

class ContactHistory {
 public:
  /// After a rebuild: takes the history of each pair from the lists of whichever of its particles is
  /// owned. Pairs without history start at zero. `filed_tag`: tags that the particles had when the lists
  /// were filed, if they may have changed (host's numbering, owned and ghosts; 0 for new particles).
  void fetch(const CandidateList &pairs, const PartnerLists &partners,
             const std::int64_t *filed_tag = nullptr);

  /// Before particles are renumbered: files the history of every touching pair under each of its
  /// owned particles.
  void file(const CandidateList &pairs, PartnerLists &partners) const;

  /// Gives all memory back: for scenes whose laws keep no history.
  void release();

  /// Sets the history of a pair that has separated to zero; `block` is the pair's index / 8.
  void forget(std::int64_t block, unsigned separated);

  bool touches(std::int64_t pair) const { return touching[pair / 8] >> (pair % 8) & 1U; }
  double memory_usage() const;

  std::vector<Record> records;           ///< indexed like the candidate pairs
  std::vector<std::uint8_t> touching;    ///< one bit for each pair: it touched when last computed
};

}    // namespace Talus

#endif
