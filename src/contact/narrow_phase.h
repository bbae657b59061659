// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Candidate pairs -> touching pairs. Two spheres touch if |x_i - x_j|^2 < (r_i + r_j)^2.

#ifndef TALUS_CONTACT_NARROW_PHASE_H
#define TALUS_CONTACT_NARROW_PHASE_H

#include "contact/candidate_list.h"
#include "contact/contact_history.h"
#include "contact/record.h"

#include <cstdint>
#include <vector>

namespace Talus {

/// Fills `contacts` with the indices of the pairs that touch, ascending, and returns their number;
/// `contacts` keeps room for more. With a history, pairs that have separated lose theirs.
std::int64_t find_contacts(const CandidateList &pairs, const std::vector<Record> &position,
                           ContactHistory *history, std::vector<std::uint32_t> &contacts);

}    // namespace Talus

#endif
