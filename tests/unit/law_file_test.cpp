// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contact laws from words, and through restart files: names and numbers, nothing else.

#include "laws/contact_words.h"
#include "laws/law_list.h"
#include "material/contact_spec.h"
#include "material/law_file.h"

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
    EXPECT_NE(std::string(problem.what())
                  .find("normal law 'hurts' (version 1), which this Talus does not have"),
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

TEST(LawFile, RefusesOtherVersions)
{
  EXPECT_EQ(complaint_about_law_file(law_file_mark, law_file_version), "");
  EXPECT_NE(complaint_about_law_file(0, 0).find(
                "before they had versions, this Talus reads version 1: write a data file"),
            std::string::npos);
  EXPECT_NE(
      complaint_about_law_file(law_file_mark, 7).find("of version 7, this Talus reads version 1"),
      std::string::npos);
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

TEST(Words, ConvertPressures)
{
  EXPECT_EQ(read("hooke 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kn"), 3.0);
  EXPECT_EQ(read("hooke 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kt"), 2.0);
  EXPECT_EQ(read("hertz 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kn"), 30.0);
  EXPECT_EQ(read("hertz 3 1 tangential multistep 2 1 0.5", 10.0).given.value("kt"), 20.0);
  EXPECT_EQ(read("hertz/material 3 1 0.2", 10.0).given.value("E"), 30.0);
}

}    // namespace
