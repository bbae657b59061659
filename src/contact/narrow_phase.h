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

/// Which pairs touch though their spheres do not overlap; needs a history.
struct BeyondTouch {
  /// By pair, and eight behind the last one: squared distance of the centers below which it does; negative: of a pair that
  /// touched at the last call; or none.
  const double *limits = nullptr;
  /// Asked of pairs that touched at the last call and do not now: of eight from `pair` on those whose bits are in `ended`.
  using Lasts = std::function<unsigned(std::int64_t pair, unsigned ended)>;
  const Lasts *lasts = nullptr;
};

/// Writes the indices of the pairs among begin ... end-1 whose spheres overlap (|x_i - x_j| < r_i +
/// r_j), or that touch all the same, in ascending order, and returns their number; `begin` must be a multiple of 8 and
/// `contacts` have room for end - begin + 8. Pairs that touched at the last call and do not now lose their history, which
/// may be nullptr.
std::int64_t find_contacts(const PairList &pairs, std::int64_t begin, std::int64_t end,
                           const Record *position, ContactHistory *history, std::uint32_t *contacts,
                           const BeyondTouch &beyond = {});

}    // namespace Talus

#endif
