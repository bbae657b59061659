// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Whether messages between ranks leave a machine.

#ifndef TALUS_RUN_MACHINES_H
#define TALUS_RUN_MACHINES_H

#include <mpi.h>

namespace Talus {

/// The ranks of `world` are on more than one machine: then some neighbors are, since the grid of
/// sub-domains is connected. Collective; every rank gets the same answer.
bool spans_machines(MPI_Comm world);

}    // namespace Talus

#endif
