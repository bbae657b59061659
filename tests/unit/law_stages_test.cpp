// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws as stages: fused kernels against the stages they are made of; what rows and histories hold; the list.

#include "law_states.h"
#include "laws/contact_energy.h"
#include "laws/fused_kernels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

using namespace Talus;
using namespace named;
using namespace reference;

namespace {

template <class Array> bool same_bits(const Array &a, const Array &b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// To the last bit, for every number of vectors, histories included.
TEST(FusedKernels, AreTheirStages)
{
  const std::vector<ContactLaw> laws = fused_laws();
  EXPECT_EQ(laws.size(), 16U);
  RandomSource random(12);
  ContactBatch fused, staged;
  for (const ContactLaw &law : laws) {
    if (law.tangential().lever_arms) continue;      // granular_laws_test
    if (law.tangential().second_order) continue;    // second_order_laws_test
    NamedLaw named = named_law(law);
    ASSERT_EQ(named.law(), law);
    ASSERT_FALSE(contact_kernel(law, true, true) == staged_kernel(law, true, true)) << title(named);
    for (int n = 0; n < 2000; n++) {
      const ContactSpec spec = random_spec(random, named, random.chance(0.3));
      const Composite mixed = compose(spec, spec, FrictionMix::MINIMUM);
      const ContactCoefficients row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
      const double dt = random.decade(-6.0, -3.0);
      fused.clear();
      for (int lane = 0; lane < ContactBatch::width; lane++)
        put(fused, lane, random_contact(random, named, mixed, dt), 0);
      staged = fused;
      const int end = lanes * (1 + n % (ContactBatch::width / lanes));
      contact_kernel(law, true, true)(fused, 0, end, &row, dt);
      staged_kernel(law, true, true)(staged, 0, end, &row, dt);
      ASSERT_TRUE(same_bits(fused.force, staged.force)) << title(named);
      if (law.has_friction()) {
        ASSERT_TRUE(same_bits(fused.torque_per_radius, staged.torque_per_radius)) << title(named);
      }
      ASSERT_TRUE(same_bits(fused.history, staged.history)) << title(named);
    }
  }
}

TEST(Laws, HaveDistinctNamesAndKnowTheirStage)
{
  int count = 0;
  for (int s = 0; s < num_stages; s++) {
    const Stage stage = static_cast<Stage>(s);
    std::set<std::string> names;
    for (const Law *law : laws_of(stage)) {
      EXPECT_EQ(law->stage, stage);
      EXPECT_TRUE(names.insert(law->name).second) << law->name;
      EXPECT_EQ(find_law(stage, law->name), law);
      count++;
    }
    EXPECT_EQ(find_law(stage, "no such law"), nullptr);
  }
  EXPECT_EQ(count, 73);
}

TEST(Laws, RowsHoldTheCoefficientsOfAllStagesOneBehindTheOther)
{
  const NamedLaw law{Normal::HERTZ, Tangential::MULTISTEP, true, false, Adhesion::DMT};
  const ContactLaw first_order = law;
  EXPECT_EQ(first_order.first_coefficient(Stage::NORMAL), 0);
  EXPECT_EQ(first_order.first_coefficient(Stage::DAMPING), 2);
  EXPECT_EQ(first_order.first_coefficient(Stage::TANGENTIAL), 5);
  EXPECT_EQ(first_order.first_coefficient(Stage::ROLLING), 6);
  EXPECT_EQ(first_order.num_coefficients(), 11);
  Numbers numbers;
  numbers.mu = 0.5;
  numbers.mu_roll = 0.1;
  const ContactCoefficients row = row_of(first_order, numbers);
  EXPECT_EQ(first_order.coefficient(Stage::TANGENTIAL, "mu", row), 0.5);
  EXPECT_EQ(first_order.coefficient(Stage::ROLLING, "mu_r", row), 0.1);
  EXPECT_EQ(first_order.coefficient(Stage::ROLLING, "mu", row), 0.0);
}

TEST(Laws, OnlyWhatALawRemembersHasAPlace)
{
  const auto size = [](NamedLaw law) { return law.law().history().size; };
  EXPECT_EQ(size({Normal::HERTZ, Tangential::ONESTEP, true}), 0);
  EXPECT_EQ(size({Normal::HERTZ, Tangential::MULTISTEP, true}), 4);
  EXPECT_EQ(size({Normal::HERTZ, Tangential::MULTISTEP, true, true}), 7);
  EXPECT_EQ(size({Normal::HOOKE_MATERIAL, Tangential::MULTISTEP}), 7);
  EXPECT_EQ(size({Normal::HOOKE_MATERIAL, Tangential::ONESTEP}), 0);
  const HistoryLayout layout = NamedLaw{Normal::HOOKE_MATERIAL, Tangential::SLIDER}.law().history();
  EXPECT_TRUE(layout.keeps_impact);
  const HistoryIndices expected{0, 1, 2, 3};
  EXPECT_EQ(layout.of_stage[static_cast<int>(Stage::TANGENTIAL)], expected);
  EXPECT_EQ(layout.impact[0], 4);
}

// Energy of each stage on its own: springs, less what adhesion has drawn together.
TEST(Laws, StoreTheEnergyOfTheirSprings)
{
  NamedLaw law{Normal::HOOKE, Tangential::MULTISTEP, false, false, Adhesion::CONSTANT};
  Numbers c;
  c.kn = 4.0;
  c.kt = 2.0;
  c.mu = 1e9;
  c.force_floor = -1e300;
  c.adhesion = 0.25;
  ContactState<double> s;
  s.normal = {1.0, 0.0, 0.0};
  s.overlap = 0.5;
  s.inverse_mass = s.inverse_radius = 1.0;
  ContactReport e;
  report_contact(law, row_of(law, c), s, 1e-3, {{0.0, 0.3, 0.4}}, ContactData::ENERGIES, e);
  EXPECT_DOUBLE_EQ(e.stored.normal, 0.5 * 4.0 * 0.25 - 0.25 * 0.5);
  EXPECT_DOUBLE_EQ(e.stored.tangential, 0.5 * 2.0 * 0.25);
  EXPECT_EQ(e.stored.resistance, 0.0);
  law.normal = Normal::HERTZ;
  report_contact(law, row_of(law, c), s, 1e-3, {}, ContactData::ALL, e);
  EXPECT_NEAR(e.stored.normal, 0.4 * 4.0 * std::sqrt(0.5) * 0.25 - 0.125, 1e-15);
}

}    // namespace
