// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_COMM_GHOST_CUTOFF_H
#define TALUS_COMM_GHOST_CUTOFF_H

#include "system/step/granular_system.h"

#include "neighbor.h"

namespace Talus {

/// While it exists, around the setup() of LAMMPS' communication objects: ghosts are to reach as far as the lists that
/// there are, not as far as lists of LAMMPS would.
class GhostCutoff {
 public:
  GhostCutoff(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::Neighbor &of_lists) :
      neighbor(of_lists), of_lammps(of_lists.cutneighmax)
  {
    neighbor.cutneighmax = GranularSystem::of(lmp)->lists().reach_of_ghosts();
  }
  ~GhostCutoff() { neighbor.cutneighmax = of_lammps; }
  GhostCutoff(const GhostCutoff &) = delete;
  GhostCutoff &operator=(const GhostCutoff &) = delete;

 private:
  LAMMPS_NS::Neighbor &neighbor;
  const double of_lammps;
};

}    // namespace Talus

#endif
