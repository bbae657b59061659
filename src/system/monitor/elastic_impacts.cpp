// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/elastic_impacts.h"

#include "system/step/granular_system.h"

#include "base/told_numbers.h"
#include "laws/contact_energy.h"

#include "error.h"

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

// e = .995: an impact loses more than the kinks can give it at .2 of the critical time step
constexpr double little_damping = 0.0016;

}    // namespace

void ElasticImpacts::clear()
{
  loses_energy = false;
  strictest.clear();
  advised = 0.0;
}

void ElasticImpacts::consider(const std::string &who, const ContactLaw &law,
                              const ContactCoefficients &c, double overlap, double mass_eff,
                              double radius_eff)
{
  // without a spring, friction of pair granular's laws is a share of the normal damping
  const bool granular = law.tangential().lever_arms;
  const bool rubs = law.coefficient(Stage::TANGENTIAL, "mu", c) > 0.0 &&
                    (!granular || law.coefficient(Stage::TANGENTIAL, "kt", c) > 0.0);
  // a contact with a reach ends with less energy than it begins with
  const bool detaches =
      !law.reaches() && pulloff_distance_of(law, c, 2.0 * radius_eff, 2.0 * radius_eff) > 0.0;
  if (rubs || detaches || law.normal().hysteretic ||
      damping_ratio(law, c, overlap, mass_eff, radius_eff) > little_damping) {
    loses_energy = true;
    return;
  }
  const double limit = law.normal().exponent == 1.0 ? advised_linear : advised_hertzian;
  if (advised > 0.0 && advised <= limit) return;
  strictest = who;
  advised = limit;
}

void ElasticImpacts::warn(double fraction) const
{
  if (loses_energy || !(advised > 0.0) || fraction <= visibly * advised) return;
  error->warning(FLERR,
                 "Pair style {}: no contact has damping or friction: at this time step, "
                 "{:.3g} of the critical one, impacts of {} gain or lose some energy by chance, "
                 "which adds up over many: use at most {} of it, or add damping",
                 GranularSystem::of(lmp)->pair_style().name(), fraction, strictest, advised);
}
