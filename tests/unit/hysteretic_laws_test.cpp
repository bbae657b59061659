// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws that remember the largest overlap: their branches, the energy they lose, friction, restitution.

#include "driven_contact.h"
#include "laws/second_order_laws.h"
#include "shape/contact/point_batch.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace contacts;

namespace {

constexpr double k1 = 1e3, k2 = 5e3, kc = 2e3, phi = 0.05, radius = 1.0, r_eff = 0.5;
const Pair luding("luding 1e3 5e3 2e3 0.05 0", radius, radius),
    walton("walton/braun 1e3 5e3 0", radius, radius);
constexpr double plastic = k2 / (k2 - k1) * phi * 2 * r_eff;    // where the slope is k2

double slope(double deepest)
{
  return k1 + (k2 - k1) * deepest / plastic;
}

TEST(Luding, HasTheBranchesOfThePaper)
{
  Driven contact(luding);
  const double m = 0.4 * plastic, k = slope(m), d0 = (1 - k1 / k) * m;
  for (const double x : {0.1, 0.5, 1.0}) EXPECT_NEAR(contact.at(x * m), k1 * x * m, 1e-12 * k1 * m);
  for (const double x : {0.95, 0.8, 0.7})
    EXPECT_NEAR(contact.at(x * m), k * (x * m - d0), 1e-12 * k1 * m);
  EXPECT_NEAR(contact.at(d0), 0.0, 1e-12 * k1 * m);
  EXPECT_NEAR(contact.at(0.9 * m), k * (0.9 * m - d0), 1e-12 * k1 * m);    // and back
  EXPECT_EQ(contact.kept(), m);
  // to where the adhesive branch begins
  const double lowest = k * d0 / (k + kc);
  EXPECT_NEAR(contact.at(lowest), -kc * lowest, 1e-12 * k1 * m);
  EXPECT_NEAR(contact.kept(), m, 1e-12 * m);
  for (const double x : {0.9, 0.5, 0.1})
    EXPECT_NEAR(contact.at(x * lowest), -kc * x * lowest, 1e-12 * k1 * m);
  EXPECT_LT(contact.kept(), 0.5 * m);
}

TEST(Luding, LoadsAgainFromTheAdhesiveBranch)
{
  Driven contact(luding);
  const double m = 0.6 * plastic, lowest = slope(m) * (1 - k1 / slope(m)) * m / (slope(m) + kc);
  contact.go(0, m);
  const double x = 0.6 * lowest;
  EXPECT_NEAR(contact.go(m, x), -kc * x, 1e-12);
  const double again = contact.kept(), k = slope(again);
  EXPECT_NEAR(k * x - (k - k1) * again, -kc * x, 1e-10);
  EXPECT_LT(again, m);
  const double y = 0.5 * (x + again);
  EXPECT_NEAR(contact.go(x, y), k * (y - x) - kc * x, 1e-10);
  EXPECT_NEAR(contact.go(y, again), k1 * again, 1e-10);
  EXPECT_NEAR(contact.go(again, 1.2 * again), k1 * 1.2 * again, 1e-10);
}

TEST(Luding, IsElasticBeyondThePlasticDepth)
{
  Driven contact(luding);
  const double d0 = phi * 2 * r_eff;
  EXPECT_NEAR(contact.go(0, plastic), k1 * plastic, 1e-9);
  for (const double x : {1.5, 2.0, 1.2})
    EXPECT_NEAR(contact.at(x * plastic), k2 * (x * plastic - d0), 1e-9);
  EXPECT_NEAR(contact.kept(), plastic, 1e-15);
  const double x = 0.9 * d0 * k2 / (k2 + kc);
  EXPECT_NEAR(contact.at(x), -kc * x, 1e-9);
}

// The work of a cycle is the area between its branches, less what is stored.
TEST(Luding, StoresWhatItGivesBack)
{
  Driven contact(luding);
  const double m = 0.5 * plastic, k = slope(m), d0 = (1 - k1 / k) * m;
  contact.go(0, m);
  EXPECT_NEAR(luding.stored(-m, contact.history()), 0.5 * k1 * m * k1 * m / k, 1e-12);
  const double work = integral([&](double x) { return contact.at(m - x); }, 0, m - d0);
  EXPECT_NEAR(work, 0.5 * k1 * m * k1 * m / k, 1e-9 * work);
  EXPECT_NEAR(luding.stored(-d0, contact.history()), 0.0, 1e-15);
  const double low = k * d0 / (k + kc);
  contact.at(low);
  EXPECT_NEAR(luding.stored(-low, contact.history()), 0.5 * kc * low * kc * low / k, 1e-12);
}

TEST(Luding, IsTheSameWhereHistoryIsOnlyRead)
{
  Driven contact(luding);
  contact.go(0, 0.5 * plastic);
  for (const double x : {0.45, 0.3, 0.05, 0.2, 0.5, 0.9}) {
    const double force = contact.at(x * plastic);
    EXPECT_NEAR(luding.contact(-x * plastic, {}, contact.history()).force.x, force,
                1e-13 * k1 * plastic);
  }
}

TEST(Luding, LimitsFrictionByTheDistanceFromTheAdhesiveBranch)
{
  const Pair pair("luding 1e3 5e3 2e3 0.05 0 tangential dashpot 1e9 0.3", radius, radius);
  const double overlap = 0.2 * plastic;
  const ContactLanes<double> s = pair.contact(-overlap, {0.0, 1.0, 0.0});
  EXPECT_NEAR(s.force.x, k1 * overlap, 1e-12);
  EXPECT_NEAR(s.force.y, -0.3 * (k1 + kc) * overlap, 1e-12);
  // no limit without a force beyond the adhesive one
  Driven contact(pair);
  contact.at(plastic);
  contact.at(0.1 * plastic);
  EXPECT_NEAR(pair.contact(-0.1 * plastic, {0.0, 1.0, 0.0}, contact.history()).force.y, 0.0, 1e-9);
}

TEST(WaltonBraun, HasItsBranches)
{
  Driven contact(walton);
  const double m = 0.1, d0 = (1 - k1 / k2) * m;
  EXPECT_NEAR(contact.go(0, m), k1 * m, 1e-10);
  EXPECT_NEAR(contact.go(m, 0.9 * m), k2 * (0.9 * m - d0), 1e-10);
  EXPECT_EQ(contact.go(0.9 * m, 0.5 * d0), 0.0);
  EXPECT_EQ(contact.go(0.5 * d0, 0.99 * d0), 0.0);    // what is dented stays so
  EXPECT_NEAR(contact.go(0.99 * d0, m), k1 * m, 1e-10);
  EXPECT_NEAR(contact.go(m, 2 * m), 2 * k1 * m, 1e-10);
}

TEST(WaltonBraun, HasARestitutionAtAllSpeeds)
{
  for (const double speed : {1e-3, 0.1, 3.0})
    EXPECT_NEAR(restitution_of(walton, speed, 2e-6), std::sqrt(k1 / k2), 3e-4) << speed;
}

// Without adhesion that of the slope at the largest overlap, sqrt(k1/k); with it less, and below some speed none.
TEST(Luding, HasARestitutionThatDependsOnSpeed)
{
  const Pair dry("luding 1e3 5e3 0 0.05 0", radius, radius);
  for (const double part : {0.1, 0.3, 0.6}) {
    const double m = part * plastic, speed = m * std::sqrt(2.0 * k1);
    EXPECT_NEAR(restitution_of(dry, speed, 1e-5), std::sqrt(k1 / slope(m)), 1e-3) << part;
    // energy k1^2 m^2/(2 k) less the triangle of the two adhesive branches
    const double k = slope(m), d0 = (1 - k1 / k) * m, low = k * d0 / (k + kc);
    const double left = 0.5 * k1 * m * k1 * m / k - 0.5 * kc * low * d0;
    if (left > 0.0) {
      EXPECT_NEAR(restitution_of(luding, speed, 1e-5), std::sqrt(left / (0.5 * k1 * m * m)), 2e-3)
          << part;
    }
  }
}

TEST(HystereticLaws, AreRefusedWhereTheyCannotBe)
{
  for (const Pair *pair : {&luding, &walton}) {
    const std::string name = pair->law.normal().name;
    EXPECT_NE(reason_against_second_order(pair->law, pair->row).find(name), std::string::npos);
    EXPECT_NE(PointBatch::refusal(pair->law).find(name), std::string::npos);
  }
  EXPECT_NE(problem_of("luding 1e3 1e3 0 0.1 0").find("k2 of unloading"), std::string::npos);
  EXPECT_NE(problem_of("luding 1e3 5e3 0 0.1 0 limit_damping").find("cohesive"), std::string::npos);
  EXPECT_EQ(problem_of("walton/braun 1e3 5e3 0 limit_damping adhesion constant 1"), "");
}

// The steepest branch, which a contact that stays closed moves on.
TEST(HystereticLaws, TellTimeStepsTheirLargestStiffness)
{
  for (const Pair *pair : {&luding, &walton})
    EXPECT_EQ(tangent_stiffness(pair->law, pair->row, 1e-3, 1.0, r_eff), k2);
}

}    // namespace
