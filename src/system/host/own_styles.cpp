// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which objects of LAMMPS are of Talus.

#include "system/host/system_fix.h"
#include "system/host/system_run_style.h"
#include "system/host/system_style.h"

#include "bond.h"
#include "fix.h"
#include "integrate.h"
#include "pair.h"

namespace Talus {

SystemFix *SystemFix::of(LAMMPS_NS::Fix *fix)
{
  return dynamic_cast<SystemFix *>(fix);
}

const SystemStyle *SystemStyle::of(const LAMMPS_NS::Pair *pair)
{
  return dynamic_cast<const SystemStyle *>(pair);
}

const SystemStyle *SystemStyle::of(const LAMMPS_NS::Bond *bond)
{
  return dynamic_cast<const SystemStyle *>(bond);
}

SystemRunStyle *SystemRunStyle::of(LAMMPS_NS::Integrate *style)
{
  return dynamic_cast<SystemRunStyle *>(style);
}

}    // namespace Talus
