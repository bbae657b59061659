// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_HOST_SIMULATED_TIME_H
#define TALUS_SYSTEM_HOST_SIMULATED_TIME_H

#include "update.h"

namespace Talus {

/// Simulated time (time units) at the present step: as LAMMPS counts it for output.
inline double simulated_time(const LAMMPS_NS::Update *update)
{
  return update->atime + static_cast<double>(update->ntimestep - update->atimestep) * update->dt;
}

}    // namespace Talus

#endif
