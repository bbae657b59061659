/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/fix_nve_bpm_sphere_talus.h"

#include "body/motion/turn_spheres.h"

#include "atom.h"
#include "comm.h"

using namespace LAMMPS_NS;

FixNVEBPMSphereTalus::FixNVEBPMSphereTalus(LAMMPS *lmp, int narg, char **arg) :
    SphereVerlet(lmp, narg, arg, "nve/bpm/sphere")
{
}

/* The first hosts have no such word. */

std::string FixNVEBPMSphereTalus::reason_of_words() const
{
#if TALUS_HOST_HAS_BOND_FRAMES
  if (extra) return "it turns dipoles";
#endif
  return "";
}

/* Orientations are in the arrays wherever particles are. */

void FixNVEBPMSphereTalus::turn_particles() const
{
  const int n = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  if (n == 0) return;
  system->step().complete_move();
  Talus::turn_spheres(
      {n, atom->mask, groupbit, system->step().particles().angular_velocities(), atom->quat[0]},
      update->dt, comm->nthreads);
}
