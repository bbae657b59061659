// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Bridges of the liquid that particles have: the law is that of a given volume, caps of neighbors have nothing in
// common, and flows neither make liquid nor take what is not there.

#include "contacts_by_words.h"
#include "laws/cohesion/liquid_of_particles.h"
#include "material/law_file.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace contacts;

namespace {

const std::string dry = "hertz/material 1e8 0.8 0.3 tangential multistep NULL NULL 0.5 adhesion ",
                  viscous = " viscosity 0.01 0.02";

HistoryValues with_volume(const ContactLaw &law, double volume)
{
  HistoryValues history{};
  history[law.history().of_stage[static_cast<int>(Stage::COHESION)][0]] = volume;
  return history;
}

// Queries and kernels, whichever way they are put together; also of dry particles, and of contacts that are not known.
TEST(LiquidOfParticles, BridgesHaveTheVolumeThatTheContactRemembers)
{
  for (const std::string model : {"willett 0.07 20", "rabinovich 0.07 0"}) {
    const Pair shared(dry + model + " volume 1e-9 share 0.5" + viscous, 1e-3, 2e-3),
        given(dry + model + " volume 3e-12" + viscous, 1e-3, 2e-3);
    const Vector3<double> velocity{0.1, -0.2, 0.3};
    const HistoryValues wet = with_volume(shared.law, 3e-12);
    for (const double gap : {-1e-6, 1e-6, 5e-5}) {
      const ContactLanes<double> one = shared.contact(gap, velocity, wet),
                                 other = given.contact(gap, velocity);
      EXPECT_EQ(one.force.x, other.force.x) << model;
      EXPECT_EQ(one.force.y, other.force.y) << model;
      EXPECT_EQ(one.torque_per_radius.z, other.torque_per_radius.z) << model;
      EXPECT_EQ(shared.stored(gap, wet), given.stored(gap)) << model;
    }
    for (const double none : {0.0, -1.0}) {
      EXPECT_EQ(shared.contact(1e-6, velocity, with_volume(shared.law, none)).force.x, 0.0);
      EXPECT_EQ(shared.stored(1e-6, with_volume(shared.law, none)), 0.0);
    }
  }
}

TEST(LiquidOfParticles, KernelsKeepTheVolume)
{
  for (const std::string &law :
       {dry, std::string("hooke 1e4 20 tangential none adhesion "),
        std::string("hertz 1e6 50 tangential mindlin 1e6 1 0.5 rolling sds 1e3 1 0.1 twisting "
                    "marshall adhesion ")}) {
    const Pair shared(law + "willett 0.07 10 volume 1e-9 share 1", 1e-3, 2e-3),
        given(law + "willett 0.07 10 volume 2e-12", 1e-3, 2e-3);
    const int at = shared.law.history().of_stage[static_cast<int>(Stage::COHESION)][0];
    for (const bool uniform : {true, false}) {
      ContactBatch one = shared.touching_and_apart(), other = given.touching_and_apart();
      for (double &volume : one.history[at]) volume = 2e-12;
      contact_kernel(shared.law, uniform, true)(one, 0, ContactBatch::width, &shared.row, 1e-5);
      contact_kernel(given.law, uniform, true)(other, 0, ContactBatch::width, &given.row, 1e-5);
      for (int k = 0; k < ContactBatch::width; k++) {
        for (int d = 0; d < 3; d++) EXPECT_EQ(one.force[d][k], other.force[d][k]) << law;
        EXPECT_EQ(one.history[at][k], 2e-12) << law;
      }
    }
  }
}

// The share of equal spheres is the one that programs have as a number.
TEST(LiquidOfParticles, CapsOfNeighborsHaveNothingInCommon)
{
  EXPECT_NEAR(facing_liquid(1e-3, 1.0, 1e-3, 1.0).first, 0.067, 2e-5);
  for (const auto &[neighbors, ratio] :
       {std::pair{12, 1.0}, {6, 1 / (std::sqrt(2.0) - 1)}, {8, 1 / (std::sqrt(3.0) - 1)}, {2, 1e9}})
    EXPECT_LE(neighbors * facing_liquid(1.0, 1.0, ratio, 0.0).first, 1.0) << neighbors;
}

TEST(LiquidOfParticles, FlowsAreOppositeAndLeaveWhatIsElsewhere)
{
  RandomSource random(5);
  for (int n = 0; n < 10000; n++) {
    const double r = random.decade(-3, -1), s = random.decade(-3, -1), share = random.decade(-3, 0);
    const double had = random.chance(0.2) ? 0.0 : random.decade(-9, -3),
                 has = random.chance(0.2) ? 0.0 : random.decade(-9, -3);
    const FacingLiquid one = facing_liquid(r, had, s, has), other = facing_liquid(s, has, r, had);
    const double volume = random.decade(-12, -3), flow = flow_at_rupture(one, share, volume);
    ASSERT_EQ(flow, -flow_at_rupture(other, share, volume));
    ASSERT_LE(-flow, 0.5 * one.first);
    ASSERT_LE(flow, 0.5 * one.second);
    ASSERT_LE(bridge_volume(one, share, volume), std::min(volume, share * one.sum()));
    // half for each, of what both have given
    const double given = std::min(volume, share * one.sum());
    if (one.sum() > 0.0) {
      ASSERT_NEAR(flow + given * one.first / one.sum(), 0.5 * given, 1e-15 * one.sum());
    }
  }
}

TEST(LiquidOfParticles, WordsAndFilesAreThose)
{
  const ContactSpec a = read(dry + "willett 0.06 0 volume 2e-12 share 0.2" + viscous),
                    b = read(dry + "willett 0.08 60 fraction 0.01" + viscous + " share 0.6");
  EXPECT_EQ(a.law, b.law);
  const ContactCoefficients row = contact_coefficients(a, b, FrictionMix::MINIMUM);
  EXPECT_DOUBLE_EQ(a.law.coefficient(Stage::COHESION, "share", row), 0.4);
  EXPECT_DOUBLE_EQ(a.law.coefficient(Stage::COHESION, "volume", row), 1e-12);
  EXPECT_NE(a.law, read(dry + "willett 0.06 0 volume 2e-12" + viscous).law);
  const ContactSpec again = from_bytes(to_bytes(a));
  EXPECT_EQ(again.law, a.law);
  EXPECT_EQ(again.given.all(), a.given.all());
  // time steps depend on the viscosity, whatever the volume is
  const Pair shared(dry + "willett 0.07 0 volume 1e-10 share 1" + viscous, 1e-3, 1e-3),
      given(dry + "willett 0.07 0 volume 1e-10" + viscous, 1e-3, 1e-3);
  EXPECT_EQ(response(shared.law, shared.row, 1e-5, 1e-6, 5e-4).gn,
            response(given.law, given.row, 1e-5, 1e-6, 5e-4).gn);
}

}    // namespace
