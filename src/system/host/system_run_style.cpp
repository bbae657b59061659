// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/system_run_style.h"

#include "lammps.h"
#include "update.h"
#include "verlet.h"

#include <cstring>
#include <typeinfo>

using namespace LAMMPS_NS;

namespace Talus {

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
