// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of friction of second order in the time step.

#include "laws/law_definition.h"
#include "laws/stage_lists.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/second_order.h"
#include "laws/tangential/tanh.h"

namespace Talus {

std::vector<const Law *> tangential_laws_order_2()
{
  return {
      &law<SecondOrder<Friction::NONE>>,
      &law<SecondOrder<Friction::SPRING>>,
      &law<SecondOrder<Friction::DASHPOT>>,
      &law<SecondOrder<Friction::TANH>>,
      &law<SecondOrder<Friction::DASHPOT, LinearNoHistory>>,
      &law<SecondOrder<Friction::SPRING, LinearHistory>>,
      &law<SecondOrder<Friction::SPRING, Mindlin>>,
      &law<SecondOrder<Friction::SPRING, MindlinForce>>,
      &law<SecondOrder<Friction::SPRING, MindlinRescale>>,
      &law<SecondOrder<Friction::SPRING, MindlinRescaleForce>>,
      &law<SecondOrder<Friction::NONE, void, Pull::YES>>,
      &law<SecondOrder<Friction::SPRING, void, Pull::YES>>,
      &law<SecondOrder<Friction::DASHPOT, void, Pull::YES>>,
      &law<SecondOrder<Friction::DASHPOT, LinearNoHistory, Pull::YES>>,
      &law<SecondOrder<Friction::SPRING, LinearHistory, Pull::YES>>,
      &law<SecondOrder<Friction::SPRING, Mindlin, Pull::YES>>,
      &law<SecondOrder<Friction::SPRING, MindlinForce, Pull::YES>>,
      &law<SecondOrder<Friction::SPRING, MindlinRescale, Pull::YES>>,
      &law<SecondOrder<Friction::SPRING, MindlinRescaleForce, Pull::YES>>,
  };
}

}    // namespace Talus
