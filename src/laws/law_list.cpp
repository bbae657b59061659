// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/law_list.h"

#include "laws/cohesion/constant.h"
#include "laws/cohesion/dmt.h"
#include "laws/cohesion/none.h"
#include "laws/cohesion/perko.h"
#include "laws/damping/coeff_restitution.h"
#include "laws/damping/flores.h"
#include "laws/damping/flores_material.h"
#include "laws/damping/mass_velocity.h"
#include "laws/damping/none.h"
#include "laws/damping/plaincoulomb.h"
#include "laws/damping/restitution.h"
#include "laws/damping/tsuji.h"
#include "laws/damping/velocity.h"
#include "laws/damping/viscoelastic.h"
#include "laws/heat/area.h"
#include "laws/heat/none.h"
#include "laws/heat/radius.h"
#include "laws/normal/dmt.h"
#include "laws/normal/flores.h"
#include "laws/normal/flores_material.h"
#include "laws/normal/hertz.h"
#include "laws/normal/hertz_material.h"
#include "laws/normal/hooke.h"
#include "laws/normal/hooke_material.h"
#include "laws/normal/jkr.h"
#include "laws/normal/plaincoulomb.h"
#include "laws/normal/plaincoulomb_material.h"
#include "laws/rolling/delayed.h"
#include "laws/rolling/holding.h"
#include "laws/rolling/holding_order_2.h"
#include "laws/rolling/none.h"
#include "laws/rolling/sds.h"
#include "laws/rolling/sds_order_2.h"
#include "laws/tangential/dashpot.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/multistep.h"
#include "laws/tangential/none.h"
#include "laws/tangential/onestep.h"
#include "laws/tangential/second_order.h"
#include "laws/tangential/synchronized.h"
#include "laws/tangential/tanh.h"
#include "laws/twisting/delayed.h"
#include "laws/twisting/marshall.h"
#include "laws/twisting/none.h"
#include "laws/twisting/sds.h"
#include "laws/twisting/stopping.h"
#include "laws/twisting/stopping_order_2.h"

#include <array>

namespace Talus {
namespace {

/// The first of each stage is what a contact has if nothing else was asked for.
const Law *const all_laws[] = {
    &law<Hooke>,
    &law<Hertz>,
    &law<Flores>,
    &law<PlainCoulomb>,
    &law<HookeMaterial>,
    &law<HertzMaterial>,
    &law<FloresMaterial>,
    &law<PlainCoulombMaterial>,
    &law<Dmt>,
    &law<Jkr>,

    &law<MassVelocity>,
    &law<Viscoelastic>,
    &law<FloresDamping>,
    &law<PlainCoulombDamping>,
    &law<RestitutionDamping>,
    &law<FloresMaterialDamping>,
    &law<NoDamping>,
    &law<VelocityDamping>,
    &law<Tsuji>,
    &law<CoeffRestitution>,

    &law<TangentialNone>,
    &law<Dashpot>,
    &law<Onestep>,
    &law<MultistepStock>,
    &law<Multistep<true, false>>,
    &law<Multistep<false, true>>,
    &law<Multistep<true, true>>,
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

    &law<RollingNone>,
    &law<HoldingRolling>,
    &law<HoldingOrder2>,
    &law<DelayedRolling>,
    &law<SdsRolling>,
    &law<SdsOrder2>,
    &law<SynchronizedSds>,

    &law<TwistingNone>,
    &law<StoppingTwist>,
    &law<StoppingOrder2>,
    &law<DelayedTwist>,
    &law<MarshallTwist>,
    &law<SdsTwist>,

    &law<CohesionNone>,
    &law<ConstantAdhesion>,
    &law<DmtAdhesion>,
    &law<PerkoAdhesion>,

    &law<HeatNone>,
    &law<HeatRadius>,
    &law<HeatArea>,
};

using LawsByStage = std::array<std::vector<const Law *>, num_stages>;

/// Made at the first question: static objects of other files may ask, and add to it.
LawsByStage &list()
{
  static LawsByStage laws = [] {
    LawsByStage by_stage;
    for (const Law *one : all_laws) by_stage[static_cast<int>(one->stage)].push_back(one);
    return by_stage;
  }();
  return laws;
}

}    // namespace

const std::vector<const Law *> &laws_of(Stage stage)
{
  return list()[static_cast<int>(stage)];
}

const Law *find_law(Stage stage, const std::string &name)
{
  for (const Law *one : laws_of(stage))
    if (name == one->name) return one;
  return nullptr;
}

const char *name_of(Stage stage)
{
  static const char *const names[num_stages] = {"normal",   "damping",  "tangential", "rolling",
                                                "twisting", "cohesion", "heat"};
  return names[static_cast<int>(stage)];
}

std::vector<std::string> words_of(Stage stage)
{
  std::vector<std::string> words;
  for (const Law *one : laws_of(stage))
    if (one->read) words.emplace_back(one->name);
  return words;
}

AddedLaw::AddedLaw(const Law &law)
{
  list()[static_cast<int>(law.stage)].push_back(&law);
}

}    // namespace Talus
