/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/motion/fix_nve_sphere_talus.h"

#include "group.h"

using namespace LAMMPS_NS;

FixNVESphereTalus::FixNVESphereTalus(LAMMPS *lmp, int narg, char **arg) :
    SphereVerlet(lmp, narg, arg, "nve/sphere")
{
}

std::string FixNVESphereTalus::reason_of_words() const
{
  return extra ? "it turns dipoles" : "";
}

std::string FixNVESphereTalus::needs_arrays()
{
  if (!reason_for_stock().empty()) return reason_for_stock();
  return group->dynamic[igroup] ? "its group is dynamic" : "";
}
