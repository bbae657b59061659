// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_DEFINITIONS_H
#define TALUS_SYSTEM_DEFINITIONS_H

#include <cstdint>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

class GranularSystem;

/// Of the fixes that there are, which LAMMPS lists by what they do when a run or the like is set up.
std::uint64_t digest_of_fixes(LAMMPS_NS::LAMMPS &lmp);
/// A number that changes when commands have defined or deleted something that a run has to set up: fixes, computes, the pair
/// style, laws of pairs, the run style, particles; or if LAMMPS' lists of fixes are of others. To be compared with that of the same rank before; it then changes on all
/// ranks or on none.
std::uint64_t digest_of_definitions(LAMMPS_NS::LAMMPS &lmp, GranularSystem &system);

}    // namespace Talus

#endif
