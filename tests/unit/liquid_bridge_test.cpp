// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Liquid bridges: forces of the papers, energies by quadrature, viscosity, ends of what else acts, kernels.

#include "contacts_by_words.h"
#include "laws/second_order_laws.h"
#include "material/law_table.h"
#include "random_source.h"
#include "shape/contact/point_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace contacts;

namespace {

constexpr double pi = 3.14159265358979323846;
const std::string dry = "hertz/material 1e8 0.8 0.3 tangential multistep NULL NULL 0.5 adhesion ";

// Willett et al. 2000: spheres of 2.381 mm, 20.6 mN/m, 74.2 nl, complete wetting.
TEST(LiquidBridge, IsThatOfTheExperiment)
{
  const double radius = 2.381e-3, gamma = 0.0206, volume = 7.42e-11;
  const Pair pair(dry + "willett 0.0206 0 volume 7.42e-11", radius, radius);
  EXPECT_NEAR(pair.attraction(1e-12), 3.08e-4, 0.005e-4);
  EXPECT_NEAR(pair.reach(), 0.42e-3, 0.001e-3);
  for (const double gap : {1e-5, 1e-4, 3e-4}) {
    const double s = gap * std::sqrt(radius / volume);
    const double expected = 2 * pi * radius * gamma / (1 + 1.05 * s + 2.5 * s * s);
    EXPECT_NEAR(pair.attraction(gap), expected, 1e-13 * expected);
  }
}

TEST(LiquidBridge, TakesTheRadiusOfDerjaguin)
{
  const Pair pair(dry + "willett 0.07 60 volume 1e-12", 1e-3, 3e-3);
  const double radius = 1.5e-3, expected = 2 * pi * radius * 0.07 * 0.5;
  EXPECT_NEAR(pair.attraction(1e-14), expected, 1e-8 * expected);
  EXPECT_NEAR(pair.reach(), (1 + pi / 6) * 1e-4, 1e-16);
}

// With functions of the C library and the equations as the paper has them.
TEST(LiquidBridge, IsThatOfRabinovich)
{
  const double radius = 1.2e-3, gamma = 0.05;
  for (const double degrees : {0.0, 25.0, 80.0})
    for (const double volume : {1e-14, 1e-11, 2e-9}) {
      std::ostringstream words;
      words << dry << "rabinovich " << gamma << " " << degrees << " volume " << volume;
      const Pair pair(words.str(), radius, radius);
      const double theta = degrees * pi / 180;
      for (const double share : {1e-3, 0.1, 0.5, 1.0}) {
        const double gap = share * pair.reach();
        const double d = 0.5 * gap * (-1 + std::sqrt(1 + 2 * volume / (pi * radius * gap * gap)));
        const double alpha = std::sqrt(2 * d / radius);
        const double expected =
            2 * pi * radius * gamma *
            (std::cos(theta) / (1 + gap / (2 * d)) + std::sin(alpha) * std::sin(theta + alpha));
        EXPECT_NEAR(pair.attraction(gap), expected, 1e-11 * expected) << words.str();
      }
    }
}

TEST(LiquidBridge, HasAVolumeOfTheParticles)
{
  const double r = 1e-3, s = 2.5e-3, fraction = 0.004;
  const double volume = fraction * 4.0 / 3.0 * pi * (r * r * r + s * s * s);
  std::ostringstream words;
  words.precision(17);
  words << dry << "rabinovich 0.07 20 volume " << volume;
  const Pair by_volume(words.str(), r, s),
      by_fraction(dry + "rabinovich 0.07 20 fraction 0.004", r, s);
  EXPECT_NEAR(by_fraction.reach(), by_volume.reach(), 1e-14 * by_volume.reach());
  for (const double gap : {-1e-6, 1e-5, 1e-4}) {
    const double expected = by_volume.contact(gap).force.x;
    EXPECT_NEAR(by_fraction.contact(gap).force.x, expected, 1e-11 * std::fabs(expected));
  }
  // against a flat body: that of the one particle
  const double one = fraction * 4.0 / 3.0 * pi * r * r * r;
  EXPECT_NEAR(pulloff_distance_of(by_fraction.law, by_fraction.row, r),
              (1 + pi / 18) * std::cbrt(one), 1e-15);
}

TEST(LiquidBridge, StoresTheWorkOfItsForce)
{
  for (const char *model : {"willett 0.07 30", "rabinovich 0.07 30", "rabinovich 0.07 0"})
    for (const char *volume : {" volume 1e-13", " volume 1e-10", " volume 1e-9"}) {
      const Pair pair("hooke 1e3 0 adhesion " + std::string(model) + volume, 1e-3, 2e-3);
      const auto force = [&](double root) { return 2 * root * pair.attraction(root * root); };
      for (const double share : {0.01, 0.3, 1.0}) {
        const double gap = share * pair.reach();
        const double expected = integral(force, 1e-9, std::sqrt(gap));
        EXPECT_NEAR(pair.stored(gap), expected, 2e-8 * expected) << model << volume;
      }
      const double overlap = 1e-5, at_touch = pair.attraction(1e-15);
      EXPECT_NEAR(pair.stored(-overlap), 0.5e3 * overlap * overlap - at_touch * overlap,
                  1e-8 * at_touch * overlap);
    }
}

TEST(LiquidBridge, IsViscous)
{
  const double eta = 0.1, least = 0.01, r = 1e-3, radius = 0.5 * r;
  const std::string words = dry + "willett 0 0 volume 1e-10 viscosity 0.1 0.01";
  const Pair pair(words, r, r);
  for (const double gap : {1e-7, 2e-5, 2e-4}) {
    const double g = std::max(least, gap / radius), stokes = 6 * pi * eta * radius;
    const ContactLanes<double> s = pair.contact(gap, {0.3, 0.2, -0.1});
    EXPECT_NEAR(s.force.x, -stokes * 0.3 / g, 1e-12 * stokes / g);
    const double shear = stokes * (0.9588 - 8.0 / 15.0 * std::log(g));
    EXPECT_NEAR(s.force.y, -shear * 0.2, 1e-12 * shear);
    EXPECT_NEAR(s.force.z, shear * 0.1, 1e-12 * shear);
    // n x F_t
    EXPECT_NEAR(s.torque_per_radius.y, -s.force.z, 1e-12 * shear);
    EXPECT_NEAR(s.torque_per_radius.z, s.force.y, 1e-12 * shear);
  }
  // what time steps depend on
  const Pair still(dry + "willett 0 0 volume 1e-10", r, r);
  const ContactResponse wet = response(pair.law, pair.row, 1e-5, 1e-6, radius),
                        not_viscous = response(still.law, still.row, 1e-5, 1e-6, radius);
  const double stokes = 6 * pi * eta * radius;
  EXPECT_NEAR(wet.gn - not_viscous.gn, stokes / least, 1e-9 * stokes / least);
  EXPECT_NEAR(wet.gt - not_viscous.gt, stokes * (0.9588 - 8.0 / 15.0 * std::log(least)),
              1e-9 * stokes);
  EXPECT_EQ(wet.kn, not_viscous.kn);
}

// Resistance, friction, heat and impacts end where surfaces part, whatever the laws are.
TEST(LiquidBridge, IsAllThatActsWhereBodiesAreApart)
{
  for (const std::string law :
       {"hooke 1e4 20", "hertz 1e6 0.5 damping tsuji", "plaincoulomb 2e4 5 0.5",
        "hooke/material 1e7 0.6 0.3 1 tangential multistep NULL NULL 0.5 rolling 0.1 delayed "
        "spinning 0.1 delayed",
        "hertz/material 1e7 0.6 0.3 tangential multistep NULL NULL 0.5 midpoint rolling cdt 0.1",
        "hertz 1e6 50 tangential mindlin 1e6 1 0.5 rolling sds 1e3 1 0.1 twisting marshall",
        "hertz/material 1e7 0.6 0.3 tangential multistep NULL NULL 0.5 heat area 1"}) {
    const Pair pair(law + " adhesion willett 0.07 10 volume 1e-11", 1e-3, 2e-3);
    ContactBatch batch = pair.touching_and_apart();
    accounting_kernel(pair.law, true, true)(batch, 0, ContactBatch::width, &pair.row, 1e-5);
    for (int k = 0; k < ContactBatch::width; k += 2) {
      const double attraction = pair.attraction(1e-6 * (k + 1));
      EXPECT_EQ(batch.force[0][k], -attraction) << law;
      EXPECT_EQ(batch.force[1][k], 0.0) << law;
      EXPECT_EQ(batch.force[2][k], 0.0) << law;
      for (int d = 0; d < 3; d++) {
        EXPECT_EQ(batch.torque_per_radius[d][k], 0.0) << law;
        EXPECT_EQ(batch.twisting_torque[d][k], 0.0) << law;
      }
      if (pair.law.conducts_heat()) {
        EXPECT_EQ(batch.heat_flow[k], 0.0);
      }
      for (int n = 0; n < pair.law.history().size; n++) EXPECT_EQ(batch.history[n][k], 0.0) << law;
      EXPECT_NEAR(batch.work[0][k], 1e-5 * attraction * 0.1, 1e-12 * attraction) << law;
      EXPECT_EQ(batch.work[1][k], 0.0);
      EXPECT_EQ(batch.work[2][k], 0.0);
    }
  }
}

// Asked in each step, without a root.
double limit_of_contact(const LawTable &table, double radius, double other)
{
  const Vec8 limits = table.limits_of_contacts(0, splat<Vec8>(radius),
                                               Vec8{other, 1.0, 0.0, other, 2.0, 3.0, 4.0, 5.0});
  EXPECT_EQ(limits[2], 0.0);    // that is no sphere
  EXPECT_EQ(limits[0], limits[3]);
  return limits[0];
}

TEST(LawTable, TellsHowFarContactsLast)
{
  for (const std::string &words :
       {dry + "willett 0.07 35 volume 1e-11", dry + "rabinovich 0.07 0 fraction 0.01",
        std::string("jkr 1e5 20 0.3 2.0"), std::string("jkr 1e5 20 0.3 0.0"),
        dry.substr(0, dry.find(" adhesion"))}) {
    for (const double other : {1e-3, 4e-3}) {
      const Pair pair(words, 1e-3, other);
      LawTable table;
      table.reset(1);
      table.set(1, 1, pair.law, pair.row);
      table.finish();
      const double distance = 1e-3 + other + pair.reach();
      const double expected = pair.reach() > 0.0 ? -distance * distance : 0.0;
      EXPECT_NEAR(limit_of_contact(table, 1e-3, other), expected, 1e-15 * distance * distance)
          << words;
    }
  }
}

/// Contacts in all directions, which move and remember something; half of them apart, if such are computed.
ContactBatch random_contacts(RandomSource &random, const Pair &pair)
{
  ContactBatch batch;
  batch.clear();
  for (int k = 0; k < ContactBatch::width; k++) {
    const bool apart = pair.law.lasts_beyond_contact() && random.chance(0.5);
    const ContactState<double> s = pair.at((apart ? 1.0 : -1.0) * random.decade(-7.0, -5.0));
    batch.overlap[k] = s.overlap;
    batch.inverse_mass[k] = 1e6;
    batch.inverse_radius[k] = s.inverse_radius;
    batch.inverse_distance[k] = s.inverse_distance;
    batch.temperature_difference[k] = random.uniform(-10.0, 10.0);
    const double angle = random.uniform(0.0, 2 * pi);
    batch.normal[0][k] = std::cos(angle);
    batch.normal[1][k] = std::sin(angle);
    for (int d = 0; d < 3; d++) {
      batch.velocity[d][k] = random.uniform(-1.0, 1.0);
      batch.surface_rotation[d][k] = random.uniform(-1.0, 1.0);
      batch.history[d][k] = random.uniform(-1e-6, 1e-6);
    }
  }
  return batch;
}

// One function for the first stages and one for the last, against all stages; with a normal law that needs no radius there
// are two ways to find masses.
TEST(FusedKernels, MayBeFollowed)
{
  RandomSource random(5);
  const std::string lasts[] = {"adhesion willett 0.07 20 volume 1e-11 viscosity 0.01 0.01",
                               "adhesion rabinovich 0.07 20 fraction 0.01",
                               "heat radius 50",
                               "heat area 1e4",
                               "heat radius 50 modulus 1e10 0.3",
                               "heat gas 50 0.02 0.5 0.1"};
  for (int k = 0; k < 12; k++) {
    const bool hertzian = k < 6;
    const std::string last = lasts[k % 6];
    const Pair pair((hertzian ? "hertz/material 1e8 0.8 0.3" : "hooke 1e4 0.1") +
                        (" tangential multistep NULL NULL 0.5 " + last),
                    1e-3, 1e-3);
    const ContactKernel kernel = contact_kernel(pair.law, true, true),
                        stages = staged_kernel(pair.law, true, true);
    if (hertzian) {
      ASSERT_FALSE(kernel == stages) << last;
    }
    for (int n = 0; n < 200; n++) {
      ContactBatch fused = random_contacts(random, pair), staged = fused;
      kernel(fused, 0, ContactBatch::width, &pair.row, 1e-6);
      stages(staged, 0, ContactBatch::width, &pair.row, 1e-6);
      const auto same = [](const auto &a, const auto &b) { return !std::memcmp(a, b, sizeof a); };
      ASSERT_TRUE(same(fused.force, staged.force)) << last;
      ASSERT_TRUE(same(fused.torque_per_radius, staged.torque_per_radius)) << last;
      ASSERT_TRUE(same(fused.history, staged.history)) << last;
      if (!pair.law.conducts_heat()) continue;
      ASSERT_TRUE(same(fused.heat_flow, staged.heat_flow)) << last;
    }
  }
}

TEST(LiquidBridge, IsRefusedWhereItCannotBe)
{
  const Pair pair(dry + "willett 0.07 0 volume 1e-12", 1e-3, 1e-3);
  EXPECT_NE(reason_against_second_order(pair.law, pair.row).find("adhesion willett"),
            std::string::npos);
  EXPECT_NE(PointBatch::refusal(pair.law).find("adhesion willett"), std::string::npos);
  EXPECT_NE(problem_of("jkr 1e5 1 0.3 1 adhesion willett 0.07 0 volume 1e-12").find("of its own"),
            std::string::npos);
  const auto has = [](const std::string &words, const std::string &text) {
    const std::string problem = problem_of(dry + words);
    EXPECT_NE(problem.find(text), std::string::npos) << words << ": " << problem;
  };
  has("willett -1 0 volume 1", "surface tension gamma");
  has("willett 0.07 91 volume 1", "contact angle in degrees");
  has("willett 0.07 0 liters 1", "volume of the bridge");
  has("willett 0.07 0 volume 0", "volume of the bridge");
  has("rabinovich 0.07 0 fraction -1", "fraction of the particles' volume");
  has("rabinovich 0.07 0 fraction 0.1 viscosity -1 0.1", "viscosity eta");
  has("rabinovich 0.07 0 fraction 0.1 viscosity 1 0", "least gap");
}

TEST(LiquidBridge, MixesTwoMaterials)
{
  const ContactSpec a = read(dry + "willett 0.06 0 volume 2e-12 viscosity 0.2 0.05"),
                    b = read(dry + "willett 0.08 60 fraction 0.01");
  const ContactCoefficients row = contact_coefficients(a, b, FrictionMix::MINIMUM);
  const auto number = [&](const char *name) {
    return a.law.coefficient(Stage::COHESION, name, row);
  };
  EXPECT_DOUBLE_EQ(number("gamma"), 0.07);
  EXPECT_DOUBLE_EQ(number("cos_theta"), 0.75);
  EXPECT_DOUBLE_EQ(number("sin_theta"), 0.25 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(number("reach"), 1 + pi / 12);
  EXPECT_DOUBLE_EQ(number("volume"), 1e-12);
  EXPECT_DOUBLE_EQ(number("fraction"), 0.005);
  EXPECT_DOUBLE_EQ(number("viscosity"), 0.1);
  EXPECT_DOUBLE_EQ(number("least_gap"), 0.05);
}

}    // namespace
