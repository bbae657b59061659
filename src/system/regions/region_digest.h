// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_REGIONS_REGION_DIGEST_H
#define TALUS_SYSTEM_REGIONS_REGION_DIGEST_H

#include <cstdint>

namespace LAMMPS_NS {
class Region;
}

namespace Talus {

/// What a region looks like: the same on all ranks, another one if it has been defined anew in other words. Regions may be
/// deleted and defined again between two runs: who uses one looks for it in init() (see SetupState).
std::uint64_t digest_of(const LAMMPS_NS::Region &region);

}    // namespace Talus

#endif
