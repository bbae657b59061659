// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Which objects of LAMMPS are of Talus.

#include "system/host/system_style.h"

#include "system/host/system_fix.h"

#include "bond.h"
#include "fix.h"
#include "lammps.h"
#include "pair.h"
#include "update.h"
#include "verlet.h"

#include <cstring>
#include <typeinfo>

using namespace LAMMPS_NS;

namespace Talus {

SystemFix *SystemFix::of(Fix *fix)
{
  return dynamic_cast<SystemFix *>(fix);
}

const SystemStyle *SystemStyle::of(const Pair *pair)
{
  return dynamic_cast<const SystemStyle *>(pair);
}

const SystemStyle *SystemStyle::of(const Bond *bond)
{
  return dynamic_cast<const SystemStyle *>(bond);
}

const SystemStyle *SystemStyle::of(const Integrate *run_style)
{
  return dynamic_cast<const SystemStyle *>(run_style);
}

void make_run_style_the_default(LAMMPS *lmp)
{
  Update *update = lmp->update;
  auto &creators = *update->integrate_map;
  const auto talus_style = creators.find("verlet/proxy");
  if (talus_style == creators.end()) return;
  creators["verlet"] = talus_style->second;

  const Integrate *present = update->integrate;
  if (std::strcmp(update->integrate_style, "verlet") != 0 || typeid(*present) != typeid(Verlet))
    return;
  char name[] = "verlet";
  char *words[] = {name};
  update->create_integrate(1, words, 1);
}

}    // namespace Talus
