// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The number of particles that are there. Atom::natoms is not: it still counts those that have left
// the box since LAMMPS looked for lost ones, which it does when it prints thermodynamic output and
// then accepts with thermo_modify lost ignore or warn.

#ifndef TALUS_SYSTEM_HOST_PARTICLE_COUNT_H
#define TALUS_SYSTEM_HOST_PARTICLE_COUNT_H

#include "atom.h"
#include "lammps.h"

namespace Talus {

/// Of all ranks. Collective.
inline LAMMPS_NS::bigint count_particles(LAMMPS_NS::LAMMPS *lmp)
{
  const LAMMPS_NS::bigint mine = lmp->atom->nlocal;
  LAMMPS_NS::bigint all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  return all;
}

}    // namespace Talus

#endif
