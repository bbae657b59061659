// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_HOST_PRESENT_BOX_H
#define TALUS_SYSTEM_HOST_PRESENT_BOX_H

#include "exchange/periodic_box.h"

#include "domain.h"

#include <algorithm>

namespace Talus {

/// The box of LAMMPS as the exchange knows it. It may change in any step: asked before each
/// exchange.
inline PeriodicBox present_box(const LAMMPS_NS::Domain &domain)
{
  PeriodicBox box{domain.xprd, domain.yprd, domain.zprd, domain.triclinic != 0,
                  domain.xy,   domain.xz,   domain.yz};
  box.changes_velocities = domain.deform_vremap != 0;
  std::copy_n(domain.h_rate, 6, box.rate.begin());
  return box;
}

}    // namespace Talus

#endif
