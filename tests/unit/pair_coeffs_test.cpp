// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A pair whose E and nu are those of its types: all other numbers are its own, none is mixed. And the power by which
// the stiffness of an impact goes with its overlap.

#include "material/pair_coeffs.h"

#include "laws/contact_words.h"
#include "laws/restitution.h"
#include "material/law_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace Talus;

namespace {

ContactSpec spec_of(const std::string &text)
{
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<const char *> pointers;
  for (const std::string &word : words) pointers.push_back(word.c_str());
  Words reader("law", static_cast<int>(words.size()), pointers.data(), 0,
               [](int, const std::string &what) { throw std::runtime_error(what); });
  return parse_contact(reader, 1.0);
}

PairCoeffs two_types(const std::string &pair)
{
  PairCoeffs laws;
  laws.resize(2);
  laws.set(1, 1,
           spec_of("hertz/material 5e6 0.5 0.45 tangential multistep NULL NULL 0.2 rolling 0.1"));
  laws.set(2, 2,
           spec_of("hertz/material 1e8 0.7 0.3 tangential multistep NULL NULL 0.4 rolling 0.3"));
  if (!pair.empty()) laws.set(1, 2, spec_of(pair));
  return laws;
}

const std::string measured =
    "hertz/material NULL 0.9 NULL tangential multistep NULL NULL 0.8 rolling 0.6";

TEST(PairCoeffs, ModuliOfTypesAndAllElseOfThePair)
{
  for (const FrictionMix rule :
       {FrictionMix::MINIMUM, FrictionMix::ARITHMETIC, FrictionMix::GEOMETRIC}) {
    PairCoeffs laws = two_types(measured);
    laws.mix = rule;
    ASSERT_TRUE(laws.known(1, 2));
    const ContactLaw &law = laws.law(1, 2);
    const ContactCoefficients row = laws.coefficients(1, 2);
    EXPECT_DOUBLE_EQ(law.coefficient(Stage::NORMAL, "E_eff", row),
                     effective_young(5e6, 0.45, 1e8, 0.3));
    EXPECT_DOUBLE_EQ(law.coefficient(Stage::NORMAL, "G_eff", row),
                     effective_shear(5e6, 0.45, 1e8, 0.3));
    EXPECT_DOUBLE_EQ(law.coefficient(Stage::TANGENTIAL, "mu", row), 0.8);
    EXPECT_DOUBLE_EQ(law.coefficient(Stage::ROLLING, "mu_r", row), 0.6);
    PairCoeffs one;    // e = .9 of a pair that is of one material
    one.resize(1);
    one.set(1, 1,
            spec_of("hertz/material 1e7 0.9 0.3 tangential multistep NULL NULL 0.8 rolling 0.6"));
    EXPECT_DOUBLE_EQ(law.coefficient(Stage::DAMPING, "damping", row),
                     law.coefficient(Stage::DAMPING, "damping", one.coefficients(1, 1)));
  }
}

TEST(PairCoeffs, ModuliFollowTheTypes)
{
  PairCoeffs laws = two_types(measured);
  laws.set(2, 2, spec_of("hooke/material 2e8 0.1 0.2 1.0"));    // of another law
  EXPECT_DOUBLE_EQ(laws.law(1, 2).coefficient(Stage::NORMAL, "E_eff", laws.coefficients(1, 2)),
                   effective_young(5e6, 0.45, 2e8, 0.2));
  EXPECT_EQ(laws.type_without_moduli(1, 2), 0);
  laws.set(2, 2, spec_of("hooke 2e8 0.1"));
  EXPECT_EQ(laws.type_without_moduli(1, 2), 2);
  EXPECT_FALSE(laws.known(1, 2));
}

TEST(PairCoeffs, ToldInTheLog)
{
  EXPECT_NE(two_types(measured).describe_pair(1, 2).find("; E and nu of both types; E_eff "),
            std::string::npos);
  EXPECT_NE(two_types("").describe_pair(1, 2).find("; mixed; E_eff "), std::string::npos);
  EXPECT_EQ(two_types("").describe_pair(1, 1).find("; mixed"), std::string::npos);
}

TEST(PairCoeffs, ThroughARestartFile)
{
  const ContactSpec written = spec_of(measured), read = from_bytes(to_bytes(written));
  EXPECT_TRUE(takes_moduli_of_types(read));
  EXPECT_EQ(read.law, written.law);
  EXPECT_EQ(read.given.all(), written.given.all());
}

TEST(PairCoeffs, NullOfOneOnly)
{
  EXPECT_THROW(spec_of("hertz/material NULL 0.9 0.3"), std::runtime_error);
  EXPECT_THROW(spec_of("hertz/material 1e7 0.9 NULL"), std::runtime_error);
  EXPECT_TRUE(takes_moduli_of_types(spec_of("jkr NULL 10 NULL 5 tangential mindlin NULL 1.0 0.5")));
  EXPECT_TRUE(takes_moduli_of_types(spec_of("hooke/material NULL 0.9 NULL 2.0")));
}

/// Overlap of an elastic impact: energy of the spring = kinetic one.
TEST(ContactSides, StiffnessOfAnImpact)
{
  const auto power = [](const std::string &law) {
    const ContactSpec spec = spec_of(law);
    return ContactSides{spec, spec, FrictionMix::MINIMUM}.stiffness_power();
  };
  EXPECT_DOUBLE_EQ(power("hooke 1e4 0"), 2.0);    // k d^2 = const
  EXPECT_DOUBLE_EQ(power("hertz 1e4 0"), 2.5);    // k d^(5/2) = const
  EXPECT_DOUBLE_EQ(power("plaincoulomb 1e4 0 0"), 2.5);
  EXPECT_DOUBLE_EQ(power("hertz/material 1e7 0.9 0.3"), 2.5);
  EXPECT_DOUBLE_EQ(power("hooke/material 1e7 0.9 0.3 1.0"), 2.5);    // k ~ E^(4/5)
}

}    // namespace
