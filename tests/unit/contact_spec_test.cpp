// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Mixing of materials: from what the user gave for I I and J J to the coefficients of I J, rule by rule.

#include "laws/restitution.h"
#include "material/contact_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace Talus;
using LAMMPS_NS::ContactSpec;
using LAMMPS_NS::FrictionMix;

namespace {

ContactSpec numbers(double kn, double gn, double kt, double gt)
{
  ContactSpec s;
  s.law.normal = NormalLaw::HERTZ;
  s.given.kn = kn;
  s.given.gn = gn;
  s.given.kt = kt;
  s.given.gt = gt;
  s.kt_given = s.gt_given = true;
  return s;
}

ContactSpec material(NormalLaw law, double young, double e, double poisson)
{
  ContactSpec s;
  s.law.normal = law;
  s.young = young;
  s.restitution = e;
  s.poisson = poisson;
  return s;
}

TEST(Mixing, NumbersTakeTheArithmeticMean)
{
  ContactSpec a = numbers(1000.0, 10.0, 70.0, 3.0), b = numbers(3000.0, 30.0, 90.0, 5.0);
  ContactCoefficients c = contact_coefficients(a, b, FrictionMix::MINIMUM);
  EXPECT_EQ(c.kn, 2000.0);
  EXPECT_EQ(c.gn, 20.0);
  EXPECT_EQ(c.kt, 80.0);
  EXPECT_EQ(c.gt, 4.0);
  b.kt_given = b.gt_given = false;    // 2/7 kn, gn/2
  c = contact_coefficients(a, b, FrictionMix::MINIMUM);
  EXPECT_DOUBLE_EQ(c.kt, 0.5 * (70.0 + 6000.0 / 7.0));
  EXPECT_DOUBLE_EQ(c.gt, 0.5 * (3.0 + 15.0));
}

TEST(Mixing, FrictionAndResistanceFollowTheRule)
{
  ContactSpec a = numbers(1.0, 1.0, 1.0, 1.0), b = a;
  a.given.mu = 0.2;
  b.given.mu = 0.8;
  a.given.mu_roll = 0.09;
  b.given.mu_roll = 0.01;
  a.given.mu_twist = 0.0;
  b.given.mu_twist = 0.5;
  const auto expect = [&](FrictionMix rule, double mu, double roll, double spin) {
    const ContactCoefficients c = contact_coefficients(a, b, rule);
    EXPECT_DOUBLE_EQ(c.mu, mu);
    EXPECT_DOUBLE_EQ(c.mu_roll, roll);
    EXPECT_DOUBLE_EQ(c.mu_twist, spin);
  };
  expect(FrictionMix::MINIMUM, 0.2, 0.01, 0.0);
  expect(FrictionMix::ARITHMETIC, 0.5, 0.05, 0.25);
  expect(FrictionMix::GEOMETRIC, 0.4, 0.03, 0.0);
}

TEST(Mixing, AdhesionTakesTheMinimumAndSpeedsTheMaximum)
{
  ContactSpec a = material(NormalLaw::HOOKE_MATERIAL, 1e6, 0.5, 0.3), b = a;
  a.given.adhesion = 2.0;
  b.given.adhesion = 3.0;
  a.given.adhesion_dmt = 8.0;
  b.given.adhesion_dmt = 7.0;
  a.given.adhesion_perko = 1.0;    // and b none
  a.given.speed = 0.1;
  b.given.speed = 0.2;
  a.given.slip_min = a.given.roll_min = a.given.twist_min = 1e-4;
  b.given.slip_min = b.given.roll_min = b.given.twist_min = 1e-5;
  const ContactCoefficients c = contact_coefficients(a, b, FrictionMix::MINIMUM);
  EXPECT_EQ(c.adhesion, 2.0);
  EXPECT_EQ(c.adhesion_dmt, 7.0);
  EXPECT_EQ(c.adhesion_perko, 0.0);
  EXPECT_EQ(c.speed, 0.2);
  EXPECT_EQ(c.slip_min, 1e-4);
  EXPECT_EQ(c.roll_min, 1e-4);
  EXPECT_EQ(c.twist_min, 1e-4);
}

TEST(Mixing, ModuliByComplianceRestitutionByMinimum)
{
  const ContactSpec a = material(NormalLaw::HERTZ_MATERIAL, 2e4, 0.6, 0.3);
  const ContactSpec b = material(NormalLaw::HERTZ_MATERIAL, 3e4, 0.5, 0.25);
  const ContactCoefficients c = contact_coefficients(a, b, FrictionMix::MINIMUM);
  EXPECT_DOUBLE_EQ(c.kn, 1.0 / (0.91 / 2e4 + 0.9375 / 3e4));
  EXPECT_DOUBLE_EQ(c.kt, 1.0 / (4.42 / 2e4 + 4.375 / 3e4));
  const double l = std::log(0.5), beta = l / std::sqrt(l * l + std::acos(-1.0) * std::acos(-1.0));
  EXPECT_DOUBLE_EQ(c.gn, -2.0 * std::sqrt(5.0 / 6.0) * beta);
  EXPECT_EQ(c.gt, c.gn);
}

TEST(Mixing, DampingIsLimitedIfEitherAsksForIt)
{
  for (NormalLaw law : {NormalLaw::HOOKE_MATERIAL, NormalLaw::HERTZ_MATERIAL,
                        NormalLaw::FLORES_MATERIAL, NormalLaw::PLAINCOULOMB_MATERIAL}) {
    const ContactSpec a = material(law, 2e4, 0.6, 0.3);
    ContactSpec b = a;
    EXPECT_EQ(contact_coefficients(a, b, FrictionMix::MINIMUM).force_floor,
              -std::numeric_limits<double>::infinity());
    b.limit_damping = true;
    const ContactCoefficients c = contact_coefficients(a, b, FrictionMix::MINIMUM);
    EXPECT_EQ(c.force_floor, 0.0);
    const double expected = law == NormalLaw::HOOKE_MATERIAL    ? linear_damping_factor_limited(0.6)
                            : law == NormalLaw::FLORES_MATERIAL ? flores_damping_factor(0.6)
                                                                : hertz_damping_factor_limited(0.6);
    EXPECT_EQ(c.gn, expected);
  }
}

// A number for kt or gt of a material law counts if both materials have one: kt is the stiffness over sqrt(R overlap),
// gt the factor of sqrt(S_t m) (hooke/material: sqrt(kn m)).
TEST(Mixing, NumbersReplaceWhatTheMaterialGives)
{
  for (NormalLaw law :
       {NormalLaw::HOOKE_MATERIAL, NormalLaw::HERTZ_MATERIAL, NormalLaw::FLORES_MATERIAL}) {
    ContactSpec a = material(law, 2e4, 0.6, 0.3), b = a;
    const ContactCoefficients plain = contact_coefficients(a, b, FrictionMix::MINIMUM);
    a.kt_given = a.gt_given = true;
    a.given.kt = 100.0;
    a.given.gt = 0.25;
    ContactCoefficients c = contact_coefficients(a, b, FrictionMix::MINIMUM);
    EXPECT_EQ(c.kt, plain.kt);
    EXPECT_EQ(c.gt, plain.gt);
    b.kt_given = b.gt_given = true;
    b.given.kt = 300.0;
    b.given.gt = 0.75;
    c = contact_coefficients(a, b, FrictionMix::MINIMUM);
    EXPECT_EQ(c.gt, 0.5);
    EXPECT_EQ(c.gn, plain.gn);
    // the grammar takes no kt for hooke/material
    if (law == NormalLaw::HERTZ_MATERIAL) {
      EXPECT_DOUBLE_EQ(c.kt, 200.0 / 8.0);
    }
    if (law == NormalLaw::FLORES_MATERIAL) {
      EXPECT_DOUBLE_EQ(c.kt, 200.0 * 3.0 / 16.0);
    }
  }
}

}    // namespace
