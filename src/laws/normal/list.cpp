// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage normal.

#include "laws/law_definition.h"
#include "laws/normal/dmt.h"
#include "laws/normal/eepa.h"
#include "laws/normal/flores.h"
#include "laws/normal/flores_material.h"
#include "laws/normal/hertz.h"
#include "laws/normal/hertz_material.h"
#include "laws/normal/hooke.h"
#include "laws/normal/hooke_material.h"
#include "laws/normal/jkr.h"
#include "laws/normal/luding.h"
#include "laws/normal/plaincoulomb.h"
#include "laws/normal/plaincoulomb_material.h"
#include "laws/normal/walton_braun.h"
#include "laws/stage_lists.h"

namespace Talus {

std::vector<const Law *> normal_laws()
{
  return {
      &law<Hooke>,         &law<Hertz>,         &law<Flores>,         &law<PlainCoulomb>,
      &law<HookeMaterial>, &law<HertzMaterial>, &law<FloresMaterial>, &law<PlainCoulombMaterial>,
      &law<Dmt>,           &law<Jkr>,           &law<Luding>,         &law<WaltonBraun>,
      &law<Eepa>,
  };
}

}    // namespace Talus
