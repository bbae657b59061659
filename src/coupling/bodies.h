// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What all calls for large bodies read first.

#ifndef TALUS_COUPLING_BODIES_H
#define TALUS_COUPLING_BODIES_H

#include <cstdint>

struct talus_partner;

namespace Talus {

class LargeBody;

/// Within a call, see talus_partner: the body of fix large/body with this ID. Throws Refusal.
LargeBody &body_of(talus_partner &partner, const char *given);
/// A number of steps after which something is to be reached. Throws Refusal.
int steps_ahead(talus_partner &partner, std::int64_t given);

}    // namespace Talus

#endif
