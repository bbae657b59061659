// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Mixing of materials: from what the user gave for I I and J J to the coefficients of I J, rule by rule.

#include "laws/restitution.h"
#include "material/contact_spec.h"
#include "named_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace Talus;
using namespace named;

namespace {

ContactSpec with_law(NamedLaw law)
{
  ContactSpec s;
  s.law = law;
  return s;
}

/// All numbers, also those of laws that are not used: they are ignored.
ContactSpec numbers(double kn, double gn, double kt, double gt)
{
  ContactSpec s = with_law({Normal::HERTZ, Tangential::MULTISTEP, true});
  s.given["kn"] = kn;
  s.given["gn"] = gn;
  s.given["kt"] = kt;
  s.given["gt"] = gt;
  return s;
}

ContactSpec material(NamedLaw law, double young, double e, double poisson)
{
  ContactSpec s = with_law(law);
  s.given["E"] = young;
  s.given["e"] = e;
  s.given["nu"] = poisson;
  return s;
}

Numbers mixed(const ContactSpec &a, const ContactSpec &b, FrictionMix rule = FrictionMix::MINIMUM)
{
  return numbers_of(a.law, contact_coefficients(a, b, rule));
}

TEST(Mixing, NumbersTakeTheArithmeticMean)
{
  ContactSpec a = numbers(1000.0, 10.0, 70.0, 3.0), b = numbers(3000.0, 30.0, 90.0, 5.0);
  Numbers c = mixed(a, b);
  EXPECT_EQ(c.kn, 2000.0);
  EXPECT_EQ(c.gn, 20.0);
  EXPECT_EQ(c.kt, 80.0);
  EXPECT_EQ(c.gt, 4.0);
  ContactSpec without = with_law({Normal::HERTZ, Tangential::MULTISTEP, true});    // 2/7 kn, gn/2
  without.given["kn"] = 3000.0;
  without.given["gn"] = 30.0;
  c = mixed(a, without);
  EXPECT_DOUBLE_EQ(c.kt, 0.5 * (70.0 + 6000.0 / 7.0));
  EXPECT_DOUBLE_EQ(c.gt, 0.5 * (3.0 + 15.0));
}

TEST(Mixing, FrictionAndResistanceFollowTheRule)
{
  ContactSpec a = numbers(1.0, 1.0, 1.0, 1.0), b = a;
  a.given["mu"] = 0.2;
  b.given["mu"] = 0.8;
  a.given["mu_r"] = 0.09;
  b.given["mu_r"] = 0.01;
  a.given["mu_s"] = 0.0;
  b.given["mu_s"] = 0.5;
  const auto expect = [&](FrictionMix rule, double mu, double roll, double spin) {
    const Numbers c = mixed(a, b, rule);
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
  const struct {
    Adhesion kind;
    const char *name;
  } kinds[] = {{Adhesion::CONSTANT, "adhesive force"},
               {Adhesion::DMT, "adhesion W"},
               {Adhesion::PERKO, "adhesion S"}};
  for (const auto &[kind, name] : kinds) {
    NamedLaw law{Normal::PLAINCOULOMB_MATERIAL, Tangential::TANH, true};
    law.adhesion = kind;
    ContactSpec a = material(law, 1e6, 0.5, 0.3), b = a;
    a.given[name] = 2.0;
    b.given[name] = 3.0;
    a.given["slip_min"] = a.given["roll_min"] = a.given["twist_min"] = 1e-4;
    b.given["slip_min"] = b.given["roll_min"] = b.given["twist_min"] = 1e-5;
    Numbers c = mixed(a, b);
    EXPECT_EQ(c.adhesion, 2.0);
    EXPECT_EQ(c.slip_min, 1e-4);
    EXPECT_EQ(c.roll_min, 1e-4);
    EXPECT_EQ(c.twist_min, 1e-4);
  }
  ContactSpec a = material({Normal::HOOKE_MATERIAL}, 1e6, 0.5, 0.3), b = a;
  a.given["vchar"] = 0.1;
  b.given["vchar"] = 0.2;
  EXPECT_EQ(mixed(a, b).speed, 0.2);
}

// Without vmin only friction of plaincoulomb and delayed resistance have a threshold.
TEST(Mixing, ThresholdsThatWereNotGiven)
{
  for (bool delayed : {false, true}) {
    const ContactSpec a = with_law({Normal::PLAINCOULOMB, Tangential::TANH, true, delayed});
    const Numbers c = mixed(a, a);
    EXPECT_EQ(c.slip_min, 1e-4);
    EXPECT_EQ(c.roll_min, delayed ? 1e-4 : 0.0);
    EXPECT_EQ(c.twist_min, delayed ? 1e-4 : 0.0);
  }
}

TEST(Mixing, ModuliByComplianceRestitutionByMinimum)
{
  const ContactSpec a = material({Normal::HERTZ_MATERIAL}, 2e4, 0.6, 0.3);
  const ContactSpec b = material({Normal::HERTZ_MATERIAL}, 3e4, 0.5, 0.25);
  const Numbers c = mixed(a, b);
  EXPECT_DOUBLE_EQ(c.kn, 1.0 / (0.91 / 2e4 + 0.9375 / 3e4));
  EXPECT_DOUBLE_EQ(c.kt, 1.0 / (4.42 / 2e4 + 4.375 / 3e4));
  const double l = std::log(0.5), beta = l / std::sqrt(l * l + std::acos(-1.0) * std::acos(-1.0));
  EXPECT_DOUBLE_EQ(c.gn, -2.0 * std::sqrt(5.0 / 6.0) * beta);
  EXPECT_EQ(c.gt, c.gn);
}

TEST(Mixing, DampingIsLimitedIfEitherAsksForIt)
{
  for (Normal law : {Normal::HOOKE_MATERIAL, Normal::HERTZ_MATERIAL, Normal::FLORES_MATERIAL,
                     Normal::PLAINCOULOMB_MATERIAL}) {
    const ContactSpec a = material({law}, 2e4, 0.6, 0.3);
    ContactSpec b = a;
    EXPECT_EQ(mixed(a, b).force_floor, -std::numeric_limits<double>::infinity());
    b.given["limit_damping"] = 1.0;
    const Numbers c = mixed(a, b);
    EXPECT_EQ(c.force_floor, 0.0);
    const double expected = law == Normal::HOOKE_MATERIAL    ? linear_damping_factor_limited(0.6)
                            : law == Normal::FLORES_MATERIAL ? flores_damping_factor(0.6)
                                                             : hertz_damping_factor_limited(0.6);
    EXPECT_EQ(c.gn, expected);
  }
}

// A number for kt or gt of a material law counts if both materials have one: kt is the stiffness over sqrt(R overlap),
// gt the factor of sqrt(S_t m) (hooke/material: sqrt(kn m)).
TEST(Mixing, NumbersReplaceWhatTheMaterialGives)
{
  for (Normal law : {Normal::HOOKE_MATERIAL, Normal::HERTZ_MATERIAL, Normal::FLORES_MATERIAL}) {
    ContactSpec a = material({law}, 2e4, 0.6, 0.3), b = a;
    const Numbers plain = mixed(a, b);
    a.given["kt"] = 100.0;
    a.given["gt"] = 0.25;
    Numbers c = mixed(a, b);
    EXPECT_EQ(c.kt, plain.kt);
    EXPECT_EQ(c.gt, plain.gt);
    b.given["kt"] = 300.0;
    b.given["gt"] = 0.75;
    c = mixed(a, b);
    EXPECT_EQ(c.gt, 0.5);
    EXPECT_EQ(c.gn, plain.gn);
    // the grammar takes no kt for hooke/material
    if (law == Normal::HERTZ_MATERIAL) {
      EXPECT_DOUBLE_EQ(c.kt, 200.0 / 8.0);
    }
    if (law == Normal::FLORES_MATERIAL) {
      EXPECT_DOUBLE_EQ(c.kt, 200.0 * 3.0 / 16.0);
    }
  }
}

}    // namespace
