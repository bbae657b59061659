// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/contact_spec.h"

#include "laws/restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

double mean(double a, double b)
{
  return 0.5 * (a + b);
}

double mix_friction(double a, double b, FrictionMix rule)
{
  if (rule == FrictionMix::ARITHMETIC) return mean(a, b);
  if (rule == FrictionMix::GEOMETRIC) return std::sqrt(a * b);
  return std::min(a, b);
}

/* Stiffness and damping of hooke, hertz, flores, plaincoulomb. Defaults of kt and gt are those of
   the stock styles gran/hooke and gran/hertz. */

void mix_numbers(const ContactSpec &a, const ContactSpec &b, ContactCoefficients &c)
{
  const auto kt = [](const ContactSpec &s) {
    return s.kt_given ? s.given.kt : 2.0 / 7.0 * s.given.kn;
  };
  const auto gt = [](const ContactSpec &s) { return s.gt_given ? s.given.gt : 0.5 * s.given.gn; };
  c.kn = mean(a.given.kn, b.given.kn);
  c.gn = mean(a.given.gn, b.given.gn);
  c.kt = mean(kt(a), kt(b));
  c.gt = mean(gt(a), gt(b));
}

/* The same from material; see normal_laws.h for the meaning of the four numbers. A tangential
   stiffness that was given by number stands for 8 G (hertz/material) or 16/3 G (flores/material).
 */

void mix_materials(const ContactSpec &a, const ContactSpec &b, bool limited, ContactCoefficients &c)
{
  const double e = std::min(a.restitution, b.restitution);
  c.kn = effective_young(a.young, a.poisson, b.young, b.poisson);
  c.kt = effective_shear(a.young, a.poisson, b.young, b.poisson);
  switch (a.law.normal) {
  case NormalLaw::HOOKE_MATERIAL:
    c.gn = c.gt = limited ? linear_damping_factor_limited(e) : linear_damping_factor(e);
    break;
  case NormalLaw::FLORES_MATERIAL:
    c.gn = flores_damping_factor(e);
    c.gt = hertz_damping_factor(flores_restitution(e));
    break;
  default:
    c.gn = c.gt = limited ? hertz_damping_factor_limited(e) : hertz_damping_factor(e);
  }
  const double modulus_per_kt = a.law.normal == NormalLaw::FLORES_MATERIAL ? 3.0 / 16.0 : 1.0 / 8.0;
  if (a.kt_given && b.kt_given) c.kt = modulus_per_kt * mean(a.given.kt, b.given.kt);
  if (a.gt_given && b.gt_given) c.gt = mean(a.given.gt, b.given.gt);
}

}    // namespace

ContactCoefficients LAMMPS_NS::contact_coefficients(const ContactSpec &a, const ContactSpec &b,
                                                    FrictionMix rule)
{
  const ContactCoefficients &p = a.given, &q = b.given;
  const bool limited = a.limit_damping || b.limit_damping;
  ContactCoefficients c;
  if (a.is_material())
    mix_materials(a, b, limited, c);
  else
    mix_numbers(a, b, c);

  c.force_floor = limited ? 0.0 : -std::numeric_limits<double>::infinity();
  c.speed = std::max(p.speed, q.speed);
  c.mu = mix_friction(p.mu, q.mu, rule);
  c.mu_roll = mix_friction(p.mu_roll, q.mu_roll, rule);
  c.mu_twist = mix_friction(p.mu_twist, q.mu_twist, rule);
  c.adhesion = std::min(p.adhesion, q.adhesion);
  c.adhesion_dmt = std::min(p.adhesion_dmt, q.adhesion_dmt);
  c.adhesion_perko = std::min(p.adhesion_perko, q.adhesion_perko);
  c.slip_min = std::max(p.slip_min, q.slip_min);
  c.roll_min = std::max(p.roll_min, q.roll_min);
  c.twist_min = std::max(p.twist_min, q.twist_min);
  return c;
}
