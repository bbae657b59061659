// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Who may read the angular velocity of proxies besides the pair style. Decides whether it can be
// left out of the messages.

#ifndef TALUS_COMM_SPIN_READERS_H
#define TALUS_COMM_SPIN_READERS_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace Talus {

/// "" if nothing but the pair style can read the spins of proxies, else who may do so: a pair
/// style that is no ProxyReader, or a fix or compute of a style that is not known to leave them
/// alone. The same on all ranks. Call after the host's init.
std::string reader_of_proxy_spins(LAMMPS_NS::LAMMPS *lmp);

}    // namespace Talus

#endif
