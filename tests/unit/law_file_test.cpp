// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact laws from words, and through restart files: names and numbers, nothing else.

#include "comma_locale.h"
#include "laws/contact_words.h"
#include "laws/law_list.h"
#include "material/contact_spec.h"
#include "material/law_file.h"
#include "material/pair_coeffs.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace Talus;

namespace {

ContactSpec read(const std::string &text, double pressure_unit = 1.0)
{
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<const char *> arg;
  for (const std::string &word : words) arg.push_back(word.c_str());
  Words reader("test", static_cast<int>(arg.size()), arg.data(), 0,
               [](int, const std::string &what) { throw std::invalid_argument(what); });
  const ContactSpec spec = parse_contact(reader, pressure_unit);
  if (!reader.at_end()) throw std::invalid_argument("surplus " + reader.peek());
  return spec;
}

const char *const examples[] = {
    "hooke 1e4 20.0",
    "hertz 3e4 50.0 tangential multistep NULL 7.0 0.5 midpoint",
    "hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.5 rolling 0.1 spinning 0.2 "
    "adhesion dmt 5.0",
    "flores/material 1e5 0.6 0.3 2.0 tangential multistep 1e4 NULL 0.5 stock rolling 0.1 delayed "
    "limit_damping",
    "plaincoulomb 2e4 5.0 0.5 vmin 0.01 0.02 0.03 adhesion perko 8.0",
    "hooke/material 1e5 0.6 0.3 2.0 tangential dashpot NULL 0.5 spinning 0.1 adhesion constant 0.0",
    "jkr 1e5 50.0 0.3 20.0 tangential mindlin_rescale/force NULL 1.0 0.5 rolling sds 2e3 20.0 0.2 "
    "twisting marshall damping velocity",
    "dmt 1e5 50.0 0.3 20.0 tangential linear_history 1e4 1.0 0.5 twisting sds 30.0 0.5 0.02",
    "hooke 1e4 0.6 tangential linear_nohistory 1.0 0.5 damping tsuji limit_damping rolling 0.1",
};

TEST(LawFile, BringsBackLawsAndNumbers)
{
  for (const char *words : examples) {
    const ContactSpec spec = read(words), again = from_bytes(to_bytes(spec));
    EXPECT_EQ(again.law, spec.law) << words;
    EXPECT_EQ(again.given.all(), spec.given.all()) << words;
    const ContactCoefficients a = contact_coefficients(spec, spec, FrictionMix::MINIMUM),
                              b = contact_coefficients(again, again, FrictionMix::MINIMUM);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << words;
  }
}

TEST(LawFile, NamesTheLawThatIsMissing)
{
  std::string bytes = to_bytes(read("hertz 3e4 50.0"));
  bytes.replace(bytes.find("hertz"), 5, "hurts");
  try {
    from_bytes(bytes);
    FAIL();
  } catch (const std::runtime_error &problem) {
    EXPECT_NE(
        std::string(problem.what()).find("normal law 'hurts', which this Talus does not have"),
        std::string::npos);
  }
}

TEST(LawFile, NoticesThatItEndsEarly)
{
  const std::string bytes = to_bytes(read(examples[2]));
  int complete = 0;
  for (std::size_t n = 0; n < bytes.size(); n++) {
    try {
      from_bytes(bytes.substr(0, n));
      complete++;    // behind a number
    } catch (const std::runtime_error &) {
    }
  }
  const int numbers = static_cast<int>(read(examples[2]).given.all().size());
  EXPECT_EQ(complete, numbers);    // 0 ... numbers-1 of them
}

TEST(PairCoeffs, TellNumbersInAnyLocale)
{
  PairCoeffs pairs;
  pairs.resize(1);
  pairs.set(1, 1, read("hooke 1e4 0.5"));
  const CommaLocale comma;
  ASSERT_TRUE(comma.works);
  const std::string text = pairs.describe_pair(1, 1);
  EXPECT_NE(text.find(" kn 10000 "), std::string::npos) << text;
  EXPECT_NE(text.find(" 0.5"), std::string::npos) << text;
}

TEST(Words, ChooseTheRuleOfSlip)
{
  const auto law = [](const std::string &words) {
    return std::string(read(words).law.tangential().name);
  };
  const std::string hooke = "hooke 1 1 tangential multistep NULL NULL 0.5 ",
                    material = "hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.5 ";
  EXPECT_EQ(law(hooke), "multistep");
  EXPECT_EQ(law(material), "multistep slider");
  EXPECT_EQ(law(hooke + "slider midpoint"), "multistep slider midpoint");
  EXPECT_EQ(law(material + "midpoint stock"), "multistep midpoint");
  EXPECT_EQ(law("flores 1 1 tangential multistep NULL 1 0.5"), "multistep slider");
}

TEST(Words, BringBothKindsOfResistance)
{
  const ContactSpec spec = read("hooke 1 1 rolling 0.1");
  EXPECT_STREQ(spec.law.rolling().name, "holding");
  EXPECT_STREQ(spec.law.twisting().name, "stopping");
  const ContactCoefficients row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
  EXPECT_EQ(spec.law.coefficient(Stage::ROLLING, "mu_r", row), 0.1);
  EXPECT_EQ(spec.law.coefficient(Stage::TWISTING, "mu_s", row), 0.0);
  EXPECT_TRUE(read("hooke 1 1 spinning 0.1 delayed").law.delayed());
  EXPECT_THROW(read("hooke 1 1 spinning 0.1 delayed rolling 0.1"), std::invalid_argument);
}

std::string names_of(const std::string &words)
{
  return describe_law(read(words).law);
}

TEST(Words, MayComeInAnyOrder)
{
  EXPECT_EQ(names_of("jkr 1e5 2.0 0.3 1.0 twisting marshall damping velocity rolling sds 1 2 3 "
                     "tangential mindlin NULL 1.0 0.5"),
            "jkr + damping velocity + mindlin + rolling sds + twisting marshall");
  EXPECT_EQ(names_of("hooke 1 1 damping mass_velocity"), "hooke + none");    // as without
  EXPECT_EQ(names_of("hooke 1 1 rolling 0.1 twisting sds 1 2 3"),
            names_of("hooke 1 1 twisting sds 1 2 3 rolling 0.1"));
  EXPECT_EQ(names_of("hooke 1 1 rolling sds 1 2 3 spinning 0.1"),
            names_of("hooke 1 1 spinning 0.1 rolling sds 1 2 3"));
  EXPECT_EQ(names_of("hooke 1 1 twisting stopping 0.1"), names_of("hooke 1 1 spinning 0.1"));
  EXPECT_THROW(read("hooke 1 1 twisting marshall"), std::invalid_argument);
  EXPECT_THROW(read("hooke 1 1 spinning 0.1 twisting sds 1 2 3"), std::invalid_argument);
}

TEST(Words, TheSecondNumberIsThatOfTheDamping)
{
  EXPECT_EQ(read("hertz/material 1 0.5 0.2").given.value("e"), 0.5);
  EXPECT_EQ(read("hertz/material 1 0.5 0.2 damping tsuji").given.value("eta"), 0.5);
  EXPECT_EQ(read("hertz/material 1 1.5 0.2 damping velocity").given.value("gn"), 1.5);
  EXPECT_EQ(read("hooke 1 0.5 damping coeff_restitution").given.value("eta"), 0.5);
  EXPECT_EQ(read("dmt 1 0.5 0.2 1").given.value("gn"), 0.5);
  EXPECT_FALSE(read("hertz/material 1 0.5 0.2 damping tsuji").given.has("e"));
  for (const char *damping : {"", " damping tsuji", " damping coeff_restitution"})
    EXPECT_THROW(read(std::string("hertz/material 1 1.5 0.2") + damping), std::invalid_argument);
}

TEST(Words, GranularCoefficientsMixGeometrically)
{
  const std::string words =
      " 0.3 8 tangential mindlin 9 0.25 0.5 rolling sds 1 2 3 twisting sds 1 4 9";
  const ContactSpec a = read("dmt 5 2" + words),
                    b = read("dmt 5 4 0.3 2 tangential mindlin 4 1.0 0.5 "
                             "rolling sds 4 2 3 twisting sds 4 4 1");
  const ContactCoefficients row = contact_coefficients(a, b, FrictionMix::MINIMUM);
  const auto found = [&](Stage stage, const char *name) {
    return a.law.coefficient(stage, name, row);
  };
  EXPECT_DOUBLE_EQ(found(Stage::NORMAL, "gamma"), 4.0);
  EXPECT_DOUBLE_EQ(found(Stage::DAMPING, "gn"), 3.0);    // arithmetic
  EXPECT_DOUBLE_EQ(found(Stage::TANGENTIAL, "kt"), 6.0);
  EXPECT_DOUBLE_EQ(found(Stage::TANGENTIAL, "xt"), 0.5);
  EXPECT_DOUBLE_EQ(found(Stage::ROLLING, "k_roll"), 2.0);
  EXPECT_DOUBLE_EQ(found(Stage::TWISTING, "mu_twist"), 3.0);
}

TEST(Words, ConvertPressures)
{
  EXPECT_EQ(read("dmt 3 1 0.2 5", 10.0).given.value("E"), 30.0);
  EXPECT_EQ(read("dmt 3 1 0.2 5", 10.0).given.value("gamma"), 5.0);
  EXPECT_EQ(read("hooke 3 1 tangential mindlin 2 1 0.5", 10.0).given.value("kt"), 20.0);
  EXPECT_EQ(read("hertz 3 1 tangential linear_history 2 1 0.5", 10.0).given.value("kt"), 2.0);
  EXPECT_EQ(read("hooke 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kn"), 3.0);
  EXPECT_EQ(read("hooke 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kt"), 2.0);
  EXPECT_EQ(read("hertz 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kn"), 30.0);
  EXPECT_EQ(read("hertz 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kt"), 20.0);
  EXPECT_EQ(read("hertz/material 3 1 0.2", 10.0).given.value("E"), 30.0);
}

}    // namespace
