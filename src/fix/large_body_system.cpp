// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/large_body_system.h"

#include "pair/pair_gran_penalty.h"

#include "atom.h"
#include "error.h"
#include "force.h"

using namespace LAMMPS_NS;
using namespace Talus;

BodyParticleView LargeBodySystem::particles(const double *mass_override) const
{
  if (atom->nlocal == 0) return {};
  auto *keeper = dynamic_cast<PairGranPenalty *>(force->pair);
  const bool kept = keeper && keeper->holds_state();
  return {atom->nlocal,
          atom->x[0],
          atom->v[0],
          atom->omega[0],
          atom->radius,
          atom->rmass,
          mass_override,
          atom->type,
          atom->f[0],
          atom->torque[0],
          nullptr,
          kept ? &keeper->records() : nullptr,
          kept ? keeper->slot_of_atom() : nullptr};
}

bool LargeBodySystem::turns_particles() const
{
  const auto *pair = dynamic_cast<const PairGranPenalty *>(force->pair);
  return !pair || pair->turns_particles();
}

const PairGranPenalty *LargeBodySystem::pair_of_materials() const
{
  return dynamic_cast<const PairGranPenalty *>(force->pair_match("gran/penalty", 1, 0));
}

ContactCoefficients LargeBodySystem::mixed(const ContactSpec &body, int type, const char *id) const
{
  const PairGranPenalty *pair = pair_of_materials();
  const ContactSpec *own = pair ? pair->own_spec(type) : nullptr;
  if (!own || !own->is_material())
    error->all(
        FLERR,
        "Fix large/body {}: the material law {} needs the material of particles of type {}: set "
        "'pair_style gran/penalty' and 'pair_coeff {} {}' with a material law",
        id, name_of(body.law.normal), type, type, type);
  ContactSpec particle = body;
  particle.young = own->young;
  particle.poisson = own->poisson;
  particle.restitution = own->restitution;
  particle.limit_damping = own->limit_damping;
  if (own->law.tangential != TangentialLaw::NONE) particle.given.mu = own->given.mu;
  if (own->law.resists) {
    particle.given.mu_roll = own->given.mu_roll;
    particle.given.mu_twist = own->given.mu_twist;
  }
  return contact_coefficients(body, particle, pair->mix_rule());
}
