// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What would read proxies while they are under way. Asked at the start of every run that
// would overlap.

#ifndef TALUS_RUN_OVERLAP_HAZARDS_H
#define TALUS_RUN_OVERLAP_HAZARDS_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// "" if the exchange of proxies may overlap with the computation of pairs, else the first reason
/// why it must not, as text for messages. The same on all ranks. `pairs_computed`: the integrator
/// calls the pair style.
std::string hazard_of_overlap(LAMMPS_NS::LAMMPS *lmp, bool pairs_computed);

}    // namespace Talus

#endif
