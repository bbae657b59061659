// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of second order against the reference that shares no code with them, over whole impacts
// of two spheres and of a sphere and a plane: every step makes the same forces.

#include "crystal_of_spheres.h"
#include "random_source.h"
#include "second_order_engine.h"

#include "laws/contact_energy.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

using namespace second_order;

namespace {

const std::vector<Particle> head_on = {sphere({-0.507, 0, 0}, {0.5, 0, 0}),
                                       sphere({0.507, 0, 0}, {-0.5, 0, 0})};
const std::vector<Particle> oblique = {
    sphere({-0.505, -0.1, 0.05}, {0.5, 0.4, 0.1}, {1, 2, -3}),
    sphere({0.405, 0.1, -0.02}, {-0.5, -0.4, 0.2}, {-2, 0.5, 1.5}, 0.4)};

/// Particles of `start` with its law in the reference. zeta is a polynomial in the engine, to 4e-8
/// of the force of one step; `times` of its error are allowed.
void expect_same_motion(const System &start, const std::string &words, double times)
{
  SCOPED_TRACE(words);
  constexpr double time = 0.12;
  ASSERT_EQ(Engine::reason_against(words), "");
  const Engine::Kernels kernels(words);
  for (int steps : {60, 61, 157, 400}) {
    const Engine::Motion engine(kernels, start, time, steps, true);
    EXPECT_TRUE(engine.sets_up_alike()) << steps;
    System reference = start;
    reference.run(time, steps);
    EXPECT_TRUE(reference.parted || !reference.adhesive) << steps;
    for (std::size_t n = 0; n < start.particles.size(); n++) {
      const Particle &a = engine.result()[n], &b = reference.particles[n];
      EXPECT_LT(norm(a.x - b.x), times * 1e-9) << steps;
      EXPECT_LT(norm(a.v - b.v), times * 1e-8) << steps;
      EXPECT_LT(norm(a.w - b.w), times * 1e-7) << steps;
    }
  }
}

/// Impacts of two spheres, and of one with a plane.
void expect_same(System start, const std::string &words, double times)
{
  for (const auto &particles : {head_on, oblique}) {
    start.particles = particles;
    expect_same_motion(start, words, times);
  }
  start.gravity = {0, 0, -9.81};
  start.planes = {{{0, 0, 0}, {0, 0, 1}}};
  start.particles = {sphere({0, 0, 0.51}, {0.3, 0.1, -0.5}, {0, 3, 1})};
  expect_same_motion(start, words, times);
}

void expect_same(const Law &law, const std::string &words, double times = 1.0)
{
  System start;
  start.law = law;
  expect_same(start, words, times);
}

Law numbers(bool hertz, double kn, double gn, double mu)
{
  Law law;
  law.hertz = hertz;
  law.damping = hertz ? Damping::RADIUS : Damping::MASS;
  law.kn = kn;
  law.gn = gn;
  law.kt = 2.0 / 7.0 * kn;
  law.gt = 0.5 * gn;
  law.mu = mu;
  return law;
}

using Talus::ContactBatch;

const char *const fused_words[] = {
    "hooke 2e4 80 tangential multistep NULL NULL 0.3 slider midpoint limit_damping",
    "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider midpoint limit_damping",
    "hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.3 slider midpoint limit_damping"};

enum class Phase { MIDDLE, BEGIN, END };    // what a contact is in

/// Spheres of radius about 1/2 in which they stick, slide, and are held at zero by damping.
void put(ContactBatch &b, int k, RandomSource &random, Phase phase, double dt)
{
  const auto set = [k](double(&to)[3][ContactBatch::width], const std::array<double, 3> &v) {
    for (int d = 0; d < 3; d++) to[d][k] = v[d];
  };
  const std::array<double, 3> n = random.unit_vector();
  const double speed = random.decade(-2.0, 0.5);
  std::array<double, 3> v = random.in_cube(0.5 * speed);
  const double along = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
  double wanted = random.uniform(-speed, speed), overlap = random.decade(-5.0, -2.0);
  if (phase == Phase::BEGIN) overlap = -dt * (wanted = -speed) * random.uniform(0.0, 1.0);
  if (phase == Phase::END) overlap = -dt * (wanted = speed) * random.uniform(0.0, 1.0);
  for (int d = 0; d < 3; d++) v[d] += (wanted - along) * n[d];
  set(b.normal, n);
  set(b.velocity, v);
  set(b.surface_rotation, random.in_cube(speed));
  set(b.velocity_change, random.in_cube(0.1 * speed));
  set(b.rotation_change, random.in_cube(0.1 * speed));
  b.overlap[k] = overlap;
  b.inverse_mass[k] = random.uniform(1.0, 4.0);
  b.inverse_radius[k] = random.uniform(2.0, 6.0);
  b.inverse_distance[k] = random.chance(0.2) ? 0.0 : random.uniform(0.9, 1.1);
  const std::array<double, 3> spring = random.in_cube(random.decade(-6.0, -2.0));
  for (int d = 0; d < 3; d++) b.history[d][k] = phase == Phase::BEGIN ? 0.0 : spring[d];
  const double force = random.chance(0.1) ? 1.0e-200 : random.decade(0.0, 3.0);
  b.history[3][k] = phase == Phase::BEGIN ? 0.0 : -force;
}

bool same_bits(const ContactBatch &a, const ContactBatch &b, int k, bool works)
{
  const auto same = [k](const auto &x, const auto &y) {
    for (std::size_t n = 0; n < std::size(x); n++)
      if (std::memcmp(&x[n][k], &y[n][k], sizeof(double)) != 0) return false;
    return true;
  };
  return same(a.force, b.force) && same(a.torque_per_radius, b.torque_per_radius) &&
         same(a.history, b.history) && (!works || same(a.work, b.work));
}

}    // namespace

// Vectors in which no contact begins or ends have a shorter way, with the same bits: the last lane
// of each decides which they go.
TEST(SecondOrderLaws, FusedAreTheirStages)
{
  RandomSource random(7);
  const double dt = 1.0e-3;
  for (const char *words : fused_words) {
    const Engine::Kernels kernels(words);
    ASSERT_FALSE(kernels.advancing == Talus::staged_kernel(kernels.law, true, true)) << words;
    for (int turn = 0; turn < 400; turn++) {
      ContactBatch batch[2];
      for (ContactBatch &one : batch) one.clear();
      for (int k = 0; k < ContactBatch::width; k++) put(batch[0], k, random, Phase::MIDDLE, dt);
      batch[0].lag = 0.5 * dt;
      batch[1] = batch[0];
      for (int k = Talus::lanes - 1; k < ContactBatch::width; k += Talus::lanes)
        put(batch[1], k, random, random.chance(0.5) ? Phase::BEGIN : Phase::END, dt);
      ContactBatch fused[2];
      for (int n = 0; n < 2; n++)
        for (bool works : {false, true}) {
          ContactBatch staged = fused[n] = batch[n];
          const auto kernel = works ? Talus::accounting_kernel : Talus::contact_kernel;
          kernel(kernels.law, true, true)(fused[n], 0, ContactBatch::width, &kernels.row, dt);
          Talus::staged_kernel(kernels.law, true, true)(staged, 0, ContactBatch::width,
                                                        &kernels.row, dt);
          for (int k = 0; k < ContactBatch::width; k++)
            ASSERT_TRUE(same_bits(fused[n], staged, k, false)) << words << " lane " << k;
        }
      for (int k = 0; k < ContactBatch::width; k++) {
        if (k % Talus::lanes == Talus::lanes - 1) continue;
        ASSERT_TRUE(same_bits(fused[0], fused[1], k, true)) << words << " lane " << k;
      }
    }
  }
}

// Of the step in which it ends overlap and springs are known, of the last one: nothing of them is
// left.
TEST(SecondOrderLaws, WhatHasEndedStoresNothing)
{
  const Engine::Kernels kernels(
      "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider midpoint "
      "adhesion constant 1 limit_damping");
  Talus::ContactState<double> state;
  state.normal = {0.0, 0.0, 1.0};
  state.velocity = {0.1, 0.0, 1.0};
  state.inverse_mass = state.inverse_radius = 4.0;
  state.inverse_distance = 1.0;
  state.lag = 5e-4;
  const Talus::HistoryValues history{{1e-4, 2e-4, 0.0, 3.0}};
  for (const Talus::ContactData requested :
       {Talus::ContactData::ENERGIES, Talus::ContactData::ALL}) {
    Talus::ContactReport found;
    state.overlap = -1e-5;
    Talus::report_contact(kernels.law, kernels.row, state, 1e-3, history, requested, found);
    EXPECT_EQ(found.stored.total(), 0.0);
    state.overlap = 1e-5;
    Talus::report_contact(kernels.law, kernels.row, state, 1e-3, history, requested, found);
    EXPECT_NE(found.stored.normal, 0.0);
    EXPECT_GT(found.stored.tangential, 0.0);
  }
}

TEST(SecondOrderLaws, AreThoseOfTheReference)
{
  expect_same(numbers(false, 2e4, 80, 0.3),
              "hooke 2e4 80 tangential multistep NULL NULL 0.3 slider midpoint limit_damping");
  expect_same(numbers(true, 1.75e5, 400, 0.3),
              "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider midpoint limit_damping");
  expect_same(numbers(true, 1.75e5, 400, 5.0),
              "hertz 1.75e5 400 tangential multistep NULL NULL 5 slider midpoint limit_damping");
  Law stiff = numbers(true, 1.75e5, 80, 0.3);
  stiff.damping = Damping::MASS;
  expect_same(stiff, "hertz 1.75e5 80 damping mass_velocity tangential multistep NULL NULL 0.3 "
                     "slider midpoint limit_damping");
  expect_same(numbers(true, 1.75e5, 0, 0.2),
              "hertz 1.75e5 0 tangential multistep NULL 0 0.2 slider midpoint");
  expect_same(numbers(false, 2e4, 80, 0.0), "hooke 2e4 80 limit_damping");
  expect_same(numbers(true, 1.75e5, 400, 0.0), "hertz 1.75e5 400 limit_damping");
}

TEST(SecondOrderLaws, WithAdhesion)
{
  for (double mu : {0.0, 0.3}) {
    Law law = numbers(true, 1.75e5, 400, mu);
    law.adhesion = 3.0;
    const std::string friction =
        mu > 0.0 ? " tangential multistep NULL NULL 0.3 slider midpoint" : "";
    expect_same(law, "hertz 1.75e5 400" + friction + " adhesion constant 3 limit_damping");
    law = numbers(false, 2e4, 0, mu);
    law.adhesion = 3.0;
    expect_same(law, "hooke 2e4 0" + friction + " adhesion constant 3");
  }
}

// Over impacts after which the bodies separate, some of them by pull-off; the dashpot of the last
// law meets its limit at once.
TEST(SecondOrderLaws, OfDmtAndJkr)
{
  const double young = 1.5e5 / (2.0 * (1.0 - 0.3 * 0.3));
  for (const AdhesiveLaw &law : {AdhesiveLaw{true, young, 1.0, 0.0, 0.0, 0.0},
                                 {true, young, 2.0, 200.0, 0.0, 0.0},
                                 {true, young, 1.0, 200.0, 0.7, 0.02},
                                 {true, young, 1.0, 200.0, 0.7, 0.5},
                                 {false, young, 0.5, 400.0, 0.0, 0.0},
                                 {false, young, 0.5, 200.0, 0.7, 0.5},
                                 {false, young, 0.5, 200.0, 0.7, 0.1}}) {
    const auto number = [](double x) { return " " + std::to_string(x); };
    std::string words = std::string(law.detaches ? "jkr" : "dmt") + " 1.5e5" + number(law.damping) +
                        " 0.3" + number(law.gamma);
    if (law.mu > 0.0) words += " tangential linear_nohistory" + number(law.xt) + number(law.mu);
    System start;
    start.adhesive = law;
    expect_same(start, words, 1.0);
  }
}

TEST(SecondOrderLaws, WithResistanceToRollingAndSpinning)
{
  for (double mu : {0.02, 0.1, 0.3}) {
    const std::string resistance =
        " rolling " + std::to_string(mu) + " spinning " + std::to_string(mu) + " limit_damping";
    Law law = numbers(true, 1.75e5, 400, 0.3);
    law.resistance.mu_r = law.resistance.mu_s = mu;
    expect_same(law,
                "hertz 1.75e5 400 tangential multistep NULL NULL 0.3 slider midpoint" + resistance);
    law = numbers(false, 2e4, 80, 0.0);
    law.resistance.mu_r = law.resistance.mu_s = mu;
    expect_same(law, "hooke 2e4 80" + resistance);
  }
}

TEST(SecondOrderLaws, WithSpringsOfRolling)
{
  for (const char *gamma : {"0", "0.3", "4"})
    for (bool is_hertz : {false, true}) {
      Law law = is_hertz ? numbers(true, 1.75e5, 400, 0.3) : numbers(false, 2e4, 80, 0.3);
      law.resistance.k_roll = 2000.0;
      law.resistance.gamma_roll = std::stod(gamma);
      law.resistance.mu_roll = 0.1;
      expect_same(law,
                  std::string(is_hertz ? "hertz 1.75e5 400" : "hooke 2e4 80") +
                      " tangential multistep NULL NULL 0.3 slider midpoint rolling sds 2000 " +
                      gamma + " 0.1 limit_damping",
                  4.0);    // explicit dashpots pass it on
    }
}

TEST(SecondOrderLaws, WithDampingOfTheStiffness)
{
  Law law = numbers(true, 0, 0, 0.4);
  const double young = 1e5, nu = 0.3;
  law.damping = Damping::ROOT;
  law.kn = 4.0 / 3.0 * young / (2.0 * (1.0 - nu * nu));
  law.kt = 8.0 * young / (4.0 * (2.0 - nu) * (1.0 + nu));
  const Engine::Kernels kernels(
      "hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.4 slider "
      "midpoint limit_damping");
  law.gn = law.gt = kernels.law.coefficients(Talus::Stage::DAMPING, kernels.row)[0];
  expect_same(law, "hertz/material 1e5 0.6 0.3 tangential multistep NULL NULL 0.4 slider midpoint "
                   "limit_damping");
}

// Many contacts hold each other's bodies: what is left of a rotation must die away, not be pushed
// on.
TEST(SecondOrderLaws, HeldRotationsOfACrystalComeToRest)
{
  const Engine::Kernels kernels("hooke 2e4 80 adhesion constant 10 rolling 0.1 spinning 0.1 "
                                "limit_damping");
  System crystal;
  crystal.particles = crystal_of_spheres();
  EXPECT_GT(spin_of(crystal.particles), 1e-2);
  EXPECT_LT(spin_of(Engine::Motion(kernels, crystal, 0.08, 200).result()), 1e-4);
}

TEST(SecondOrderLaws, OthersAreRefusedWithTheCure)
{
  const auto reason = Engine::reason_against;
  const auto expect_cure = [&](const std::string &words, const std::string &part) {
    EXPECT_NE(reason(words).find(part), std::string::npos) << words << ": " << reason(words);
  };
  expect_cure("hooke 2e4 80", "limit_damping");
  EXPECT_EQ(reason("hooke 2e4 0"), "");
  EXPECT_EQ(reason("hooke 2e4 0 damping none"), "");
  EXPECT_EQ(reason("hertz/material 1e5 1 0.3"), "");
  const std::string limit = " limit_damping";
  expect_cure("hooke 2e4 80 tangential multistep NULL NULL 0.3" + limit, "slider midpoint");
  expect_cure("hertz/material 2e4 0.8 0.3 tangential multistep NULL NULL 0.3 stock" + limit,
              "gt = 0");
  expect_cure("hooke 2e4 0.6 damping tsuji tangential multistep NULL NULL 0.3 midpoint" + limit,
              "slider midpoint");
  EXPECT_EQ(reason("hooke 2e4 80 tangential multistep NULL 0 0.3 midpoint" + limit), "");
  EXPECT_EQ(reason("hooke 2e4 80 tangential multistep NULL NULL 0.3 slider" + limit), "");
  EXPECT_EQ(reason("hooke 2e4 80 tangential dashpot NULL 0.3" + limit), "");
  EXPECT_EQ(reason("plaincoulomb 2e4 80 0.3" + limit), "");
  expect_cure("hooke 2e4 80 tangential linear_history 1e3 1 0.3" + limit, "xt = 0");
  EXPECT_EQ(reason("hooke 2e4 80 tangential linear_history 1e3 0 0.3" + limit), "");
  EXPECT_EQ(reason("hooke 2e4 0 tangential linear_history 1e3 1 0.3"), "");
  for (const std::string spring :
       {"linear_history", "linear_history_classic", "mindlin", "mindlin/force", "mindlin_rescale",
        "mindlin_rescale/force", "mindlin_classic"}) {
    EXPECT_EQ(reason("hooke 2e4 80 tangential " + spring + " 1e3 0 0.3" + limit), "") << spring;
    expect_cure("hooke 2e4 80 tangential " + spring + " 1e3 1 0.3" + limit, "xt = 0");
  }
  expect_cure("hooke 2e4 0 tangential onestep 1e3 0 0.3", "slider midpoint");
  EXPECT_EQ(reason("hertz 2e4 0 rolling 0.1 spinning 0.1"), "");
  EXPECT_EQ(reason("hertz 2e4 0 rolling sds 1e3 1 0.1"), "");
  expect_cure("hertz 2e4 0 twisting sds 1e3 1 0.1", "use 'spinning mu'");
  expect_cure("hertz 2e4 0 tangential linear_history 1e3 0 0.3 twisting marshall",
              "use 'spinning mu'");
  expect_cure("hertz 2e4 0 rolling 0.1 delayed", "delayed");
  const std::string impact = "hooke/material 1e5 1 0.3 1 limit_damping tangential ";
  for (const std::string spring : {"multistep NULL NULL 0.3 slider midpoint",
                                   "linear_history 1e3 0 0.3", "mindlin 1e3 0 0.3"}) {
    for (const std::string resistance : {"", " rolling 0.1", " spinning 0.1"})
      EXPECT_EQ(reason(impact + spring + resistance), "");
    EXPECT_EQ(reason("hertz/material 1e5 1 0.3 rolling 0.1 spinning 0.1 tangential " + spring), "");
  }
  EXPECT_EQ(reason(impact + "dashpot 0 0.3 rolling 0.1 spinning 0.1"), "");
  expect_cure("hertz 2e4 0 rolling 0.1 vmin 0 1e-4 0", "vmin");
  EXPECT_EQ(reason("hertz 2e4 0 adhesion constant 1"), "");
  EXPECT_EQ(reason("dmt 1e5 0 0.3 1"), "");
  EXPECT_EQ(reason("dmt 1e5 1 0.3 1 damping none"), "");
  EXPECT_EQ(reason("dmt 1e5 1 0.3 1"), "");
  EXPECT_EQ(reason("jkr 1e5 1 0.3 1 damping mass_velocity"), "");
  expect_cure("jkr 1e5 1 0.3 1 tangential mindlin NULL 1 0.3", "xt = 0");
  expect_cure("jkr 1e5 1 0.3 1 tangential mindlin/force NULL 1 0.3", "xt = 0");
  expect_cure("flores 1e5 1 tangential multistep NULL 1 0.3 slider midpoint", "limit_damping");
  EXPECT_EQ(reason("hertz 2e4 0 heat radius 1"), "");
  const std::string friction = " tangential multistep NULL NULL 0.3 slider midpoint limit_damping";
  EXPECT_EQ(reason("hertz 2e4 1 damping mass_velocity" + friction), "");
  EXPECT_EQ(reason("hooke 2e4 1 damping velocity" + friction), "");
}
