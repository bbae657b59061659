// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Heat through contacts whose moduli are softened: the circle is that of the real grains under the same load.

#include "contacts_by_words.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace contacts;

namespace {

constexpr double pi = 3.14159265358979323846, radius = 1e-3, other = 2e-3, depth = 4e-6;
constexpr double effective = radius * other / (radius + other);

double flow(const std::string &words, double overlap = depth)
{
  const Pair pair(words, radius, other);
  ContactState<double> s = pair.at(-overlap);
  s.temperature_difference = 1.0;
  return single_contact(pair.law, pair.row, s, 1.0e-5).heat_flow;
}

double effective_modulus(double young, double poisson)
{
  return young / (2.0 * (1.0 - poisson * poisson));
}

const double real_modulus = effective_modulus(7e10, 0.22);
const std::string real_words = " modulus 7e10 0.22";

// a ~ E^(-1/3) at one load.
TEST(Conduction, OfHertzianLawsTakesTheRatioOfModuli)
{
  const double ratio = std::cbrt(effective_modulus(5e6, 0.3) / real_modulus);
  for (const std::string law :
       {"hertz/material 5e6 0.5 0.3", "jkr 5e6 0.5 0.3 0.2", "dmt 5e6 0.5 0.3 0.2"}) {
    const double by_radius = flow(law + " heat radius 40"), by_area = flow(law + " heat area 40");
    EXPECT_NEAR(flow(law + " heat radius 40" + real_words), ratio * by_radius, 1e-12 * by_radius);
    EXPECT_NEAR(flow(law + " heat area 40" + real_words), ratio * ratio * by_area, 1e-12 * by_area);
  }
}

// Under the load of the law the real grains are flattened less deep: the contact of a law with their modulus.
TEST(Conduction, IsThatOfTheRealGrainsUnderTheSameLoad)
{
  const std::string soft = "hertz/material 5e6 0.5 0.3 heat radius 40",
                    real = "hertz/material 7e10 0.5 0.22 heat radius 40";
  const double share = std::pow(effective_modulus(5e6, 0.3) / real_modulus, 2.0 / 3.0);
  const Pair of_soft(soft, radius, other), of_real(real, radius, other);
  const double load = of_soft.contact(-depth).elastic;
  EXPECT_NEAR(of_real.contact(-share * depth).elastic, load, 1e-12 * load);
  const double expected = flow(real, share * depth);
  EXPECT_NEAR(flow(soft + real_words), expected, 1e-12 * expected);
}

// Of linear and elasto-plastic laws: the circle of Hertz under the elastic force.
TEST(Conduction, OfOtherLawsIsThatOfHertz)
{
  for (const std::string law :
       {"hooke 2e4 0.0", "hertz 1e8 0.0", "plaincoulomb 2e4 0.0 0.5", "walton/braun 2e4 4e4 0.0"}) {
    const double load = Pair(law, radius, other).contact(-depth).elastic;
    ASSERT_GT(load, 0.0);
    const double a = std::cbrt(0.75 * effective * load / real_modulus);
    EXPECT_NEAR(flow(law + " heat radius 40" + real_words), 80.0 * a, 80e-12 * a) << law;
    EXPECT_NEAR(flow(law + " heat area 40" + real_words), 40.0 * pi * a * a, 40e-12 * a * a) << law;
  }
}

TEST(Conduction, MixesModuliByCompliance)
{
  const ContactSpec a = read("hertz/material 5e6 0.5 0.3 heat radius 40 modulus 7e10 0.22"),
                    b = read("hertz/material 5e6 0.5 0.3 heat radius 10 modulus 2e11 0.3"),
                    c = read("hertz/material 3e9 0.5 0.4 heat radius 10");
  const auto number = [&](const ContactSpec &one, const ContactSpec &two, const char *name) {
    return one.law.coefficient(Stage::HEAT, name,
                               contact_coefficients(one, two, FrictionMix::MINIMUM));
  };
  const auto together = [](double y1, double n1, double y2, double n2) {
    return 1.0 / ((1.0 - n1 * n1) / y1 + (1.0 - n2 * n2) / y2);
  };
  EXPECT_DOUBLE_EQ(number(a, b, "heat"), 20.0);
  EXPECT_DOUBLE_EQ(number(a, b, "real_E_eff"), together(7e10, 0.22, 2e11, 0.3));
  EXPECT_DOUBLE_EQ(number(a, c, "real_E_eff"), together(7e10, 0.22, 3e9, 0.4));
  EXPECT_EQ(number(c, c, "real_E_eff"), 0.0);
}

TEST(Conduction, RefusesBadModuli)
{
  const auto has = [](const std::string &words, const std::string &text) {
    const std::string problem = problem_of("hooke 1e4 0 heat " + words);
    EXPECT_NE(problem.find(text), std::string::npos) << words << ": " << problem;
  };
  has("radius 40 modulus", "Young's modulus E of the grains");
  has("radius 40 modulus 0 0.3", "Young's modulus E of the grains");
  has("area 40 modulus 1e9 0.6", "Poisson's ratio nu of the grains");
  has("area 40 modulus 1e9", "Poisson's ratio nu of the grains");
}

}    // namespace
