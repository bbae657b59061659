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

std::string FixNVEBPMSphereTalus::needs_arrays()
{
  return reason_for_stock().empty() ? "orientations are in the arrays" : reason_for_stock();
}

void FixNVEBPMSphereTalus::initial_integrate(int vflag)
{
  SphereVerlet::initial_integrate(vflag);
  const int n = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  if (n == 0 || !reason_for_stock().empty()) return;
  Talus::turn_spheres({n, atom->mask, groupbit, atom->omega[0], atom->quat[0]}, update->dt,
                      comm->nthreads);
}
