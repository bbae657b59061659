/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#ifndef LMP_SPHERE_KICKS_H
#define LMP_SPHERE_KICKS_H

#include "particles/particle_records.h"

namespace LAMMPS_NS {

class LAMMPS;

/* ----------------------------------------------------------------------
   Kick and drift of spheres in the arrays of LAMMPS, with the arithmetic of
   particles/kick_and_drift.h: a particle gets the bits that it would get in the records,
   on any number of threads.

   Called by integrators, at the start or the end of a step. `groupbit`: who moves;
   `drifts`: positions as well;
   `changes`: nullptr, or receives those of velocities, see ParticleRecords::change;
   `frozenbits`: groups whose members do not fall. One kick, whatever step.two_kicks says.
------------------------------------------------------------------------- */

void kick_spheres(LAMMPS *lmp, int igroup, Talus::RecordStep step, int frozenbits, bool drifts,
                  Talus::ChangeRecord *changes = nullptr);

}    // namespace LAMMPS_NS

#endif
