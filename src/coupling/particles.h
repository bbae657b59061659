// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What calls for particles and fields share.

#ifndef TALUS_COUPLING_PARTICLES_H
#define TALUS_COUPLING_PARTICLES_H

struct talus_partner;

namespace Talus {

class ExternalLoads;

/// Within a call, see talus_partner: what is put on particles. Throws Refusal where they cannot bear
/// anything. The next advance may have to begin with a set-up.
ExternalLoads &loads_of(talus_partner &partner);
/// Throws Refusal where particles have no temperature.
void require_temperatures(const talus_partner &partner);

}    // namespace Talus

#endif
