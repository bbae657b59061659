// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/undamped_friction.h"

#include "system/step/granular_system.h"

#include "base/told_numbers.h"
#include "laws/contact_energy.h"

#include "error.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

// damping ratios below which the loss in the normal direction does not outweigh the gain: e = .9,
// .8
constexpr double weak_damping = 0.03, moderate_damping = 0.075;
constexpr double strong_friction = 0.5, gripping_friction = 10.0, strong_resistance = 0.2;
// rolling resistance over friction: it takes away more than the first step of the contact gives
constexpr double braking_resistance = 0.01;

/// Damping ratio that outweighs what the update of the displacement gains: none for mu = 1, e = .95
/// for mu = 5, .85 for mu above 10.
double outweighing(double mu)
{
  return std::min(0.05, 4.0e-4 * mu * mu);
}

double harmless_fraction(double mu)
{
  return 0.14 / std::cbrt(mu);
}

}    // namespace

void UndampedFriction::consider(const std::string &who, const ContactLaw &law,
                                const ContactCoefficients &c, double overlap, double mass_eff,
                                double radius_eff)
{
  if (!law.tangential().has_spring) return;
  const double damping = damping_ratio(law, c, overlap, mass_eff, radius_eff);
  const double mu = law.coefficient(Stage::TANGENTIAL, "mu", c);
  const double mu_roll = law.coefficient(Stage::ROLLING, "mu_r", c);
  const double resistance = law.rolling().holds ? mu_roll : 0.0;
  const bool hides = damping >= outweighing(mu) || resistance >= braking_resistance * mu;
  const bool granular = !law.tangential().reads_stiffness;
  if (!law.tangential().is_midpoint && mu > strong_friction && !hides && mu > worst_step.mu)
    worst_step = {who, mu, mu_roll, granular, false, false};

  const double held = std::min(mu, resistance);
  const double enough = held >= 1.0 ? moderate_damping : weak_damping;
  const bool grips = mu > visibly * gripping_friction && damping < weak_damping;
  const bool holds = held > visibly * strong_resistance && damping < enough;
  if (law.stiffens() && (grips || holds) && mu > worst_spring.mu)
    worst_spring = {who, mu, mu_roll, granular, grips, holds};
}

void UndampedFriction::warn(double fraction) const
{
  if (worst_step.mu > 0.0 && fraction > visibly * harmless_fraction(worst_step.mu))
    error->warning(FLERR,
                   "Pair style {}: contacts of {} have a coefficient of friction of "
                   "{:.4g} and next to no damping: at this time step, {:.3g} of the critical one, "
                   "impacts gain energy: add {}damping, or use at most {:.2g} of it",
                   GranularSystem::of(lmp)->pair_style().name(), worst_step.who, worst_step.mu,
                   fraction, worst_step.granular ? "" : "the word midpoint, or ",
                   rounded_down(harmless_fraction(worst_step.mu), 2));
  if (worst_spring.mu > 0.0) {
    std::string less;
    if (worst_spring.grips)
      less = fmt::format("a coefficient of friction of at most {}", gripping_friction);
    if (worst_spring.holds)
      less += fmt::format("{}rolling resistance of at most {}", less.empty() ? "" : " and ",
                          strong_resistance);
    error->warning(
        FLERR,
        "Pair style {}: contacts of {} have a coefficient of friction of "
        "{:.4g}{} and next to no damping: impacts gain energy at any time step, since "
        "their tangential spring stiffens while it is stretched: add damping, {}or use {}",
        GranularSystem::of(lmp)->pair_style().name(), worst_spring.who, worst_spring.mu,
        worst_spring.mu_roll > 0.0
            ? fmt::format(", rolling resistance of {:.4g}", worst_spring.mu_roll)
            : "",
        worst_spring.granular ? "or use mindlin_rescale or mindlin_rescale/force, " : "", less);
  }
}
