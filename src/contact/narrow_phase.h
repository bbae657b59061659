// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From candidate pairs to touching pairs.

#ifndef TALUS_CONTACT_NARROW_PHASE_H
#define TALUS_CONTACT_NARROW_PHASE_H

#include "history/contact_history.h"
#include "neighbors/pair_list.h"
#include "particles/record.h"

#include <cstdint>
#include <functional>

namespace Talus {

/// Writes the indices of the pairs among begin ... end-1 whose spheres overlap (|x_i - x_j| < r_i +
/// r_j), in ascending order, and returns their number; `begin` must be a multiple of 8 and
/// `contacts` have room for end - begin + 8. Pairs that overlapped at the last call and do not now
/// lose their history. `history` may be nullptr, but not with `lasts`. `lasts`, if given, is asked of
/// pairs that touched and do not overlap now, and of those whose distance is below (r_i + r_j)(1 + reach),
/// whether they touch all the same; `touched`: at the last call.
using LastsBeyondContact = std::function<bool(std::int64_t pair, bool touched)>;
std::int64_t find_contacts(const PairList &pairs, std::int64_t begin, std::int64_t end,
                           const Record *position, ContactHistory *history, std::uint32_t *contacts,
                           const LastsBeyondContact *lasts = nullptr, double reach = 0.0);

}    // namespace Talus

#endif
