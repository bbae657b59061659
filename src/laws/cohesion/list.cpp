// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage cohesion.

#include "laws/cohesion/adhesion.h"
#include "laws/cohesion/liquid_of_particles.h"
#include "laws/cohesion/rabinovich.h"
#include "laws/cohesion/willett.h"
#include "laws/law_definition.h"
#include "laws/none.h"
#include "laws/stage_lists.h"

namespace Talus {

std::vector<const Law *> cohesion_laws()
{
  return {
      &law<NoCohesion>,
      &law<Adhesion<ConstantModel>>,
      &law<Adhesion<DmtModel>>,
      &law<Adhesion<PerkoModel>>,
      &law<LiquidBridge<WillettModel>>,
      &law<LiquidBridge<RabinovichModel>>,
      &law<LiquidBridgeOfParticles<WillettModel>>,
      &law<LiquidBridgeOfParticles<RabinovichModel>>,
  };
}

}    // namespace Talus
