// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of stage damping.

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
#include "laws/law_definition.h"
#include "laws/stage_lists.h"

namespace Talus {

std::vector<const Law *> damping_laws()
{
  return {
      &law<MassVelocity>,        &law<Viscoelastic>,       &law<FloresDamping>,
      &law<PlainCoulombDamping>, &law<RestitutionDamping>, &law<FloresMaterialDamping>,
      &law<NoDamping>,           &law<VelocityDamping>,    &law<Tsuji>,
      &law<CoeffRestitution>,
  };
}

}    // namespace Talus
