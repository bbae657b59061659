// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_DEFINITIONS_H
#define TALUS_SYSTEM_DEFINITIONS_H

#include <cstdint>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

class GranularSystem;

/// A number that changes when commands have defined or deleted something that a run has to set up: fixes, computes, the pair
/// style, laws of pairs, the run style, particles; or set one up, such as `run`. To be compared with that of the same rank before; it then changes on all
/// ranks or on none.
std::uint64_t digest_of_definitions(LAMMPS_NS::LAMMPS &lmp, GranularSystem &system);

}    // namespace Talus

#endif
