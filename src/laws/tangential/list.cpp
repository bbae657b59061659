// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of friction.

#include "laws/law_definition.h"
#include "laws/stage_lists.h"
#include "laws/tangential/dashpot.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/limited_spring.h"
#include "laws/tangential/multistep.h"
#include "laws/tangential/none.h"
#include "laws/tangential/onestep.h"
#include "laws/tangential/synchronized.h"
#include "laws/tangential/tanh.h"

namespace Talus {

std::vector<const Law *> tangential_laws()
{
  return {
      &law<TangentialNone>,
      &law<Dashpot>,
      &law<Onestep>,
      &law<MultistepStock>,
      &law<Multistep<true, false>>,
      &law<Multistep<false, true>>,
      &law<Multistep<true, true>>,
      &law<MultistepSpring>,
      &law<Tanh>,
      &law<LinearNoHistory>,
      &law<LinearHistory>,
      &law<LinearHistoryClassic>,
      &law<Mindlin>,
      &law<MindlinForce>,
      &law<MindlinRescale>,
      &law<MindlinRescaleForce>,
      &law<MindlinClassic>,
      &law<ClassicOfFeb2025>,
      &law<SynchronizedLinear>,
      &law<SynchronizedLinearClassic>,
      &law<SynchronizedMindlin>,
      &law<SynchronizedMindlinForce>,
      &law<SynchronizedMindlinRescale>,
      &law<SynchronizedMindlinRescaleForce>,
      &law<SynchronizedMindlinClassic>,
  };
}

}    // namespace Talus
