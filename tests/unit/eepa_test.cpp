// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// EEPA: its branches, its limits hertz/material and walton/braun, energies, friction, restitution.

#include "base/power.h"
#include "driven_contact.h"
#include "laws/second_order_laws.h"
#include "shape/contact/point_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace contacts;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radius = 1.0, r_eff = 0.5, young = 1e6 / (2 * (1 - 0.3 * 0.3));
constexpr double k1 = 4.0 / 3.0 * young * r_eff * r_eff;    // of overlaps over r_eff

/// Words and what follows from them, by functions of the C library.
struct Material {
  double gamma, lambda, f0, n, chi;

  std::string words() const
  {
    std::ostringstream text;
    text.precision(17);
    text << "eepa 1e6 1 0.3 " << gamma << " " << lambda << " " << f0 << " " << n << " " << chi;
    return text.str();
  }
  double k2() const { return k1 / (1 - lambda); }
  double loading(double x) const { return k1 * std::pow(x, n) - f0; }
  double unloading(double x, double deepest) const
  {
    return k2() * (std::pow(x, n) - lambda * std::pow(deepest, n)) - f0;
  }
  double most(double deepest) const
  {
    const double plastic = lambda * std::pow(deepest, n);
    const double a = r_eff * std::sqrt(2 * std::pow(plastic, 1 / n));
    return std::min(1.5 * pi * gamma * a, 0.5 * k2() * plastic);
  }
  /// Where the adhesive branch begins.
  double begin(double deepest) const
  {
    return std::pow(lambda * std::pow(deepest, n) - most(deepest) / k2(), 1 / n);
  }
  double pulling(double x, double deepest) const
  {
    return -most(deepest) * std::pow(x / begin(deepest), chi) - f0;
  }
};

const Material materials[] = {
    {1e3, 0.6, 0.0, 1.5, 1.5},
    {1e3, 0.6, 50.0, 1.5, 5.0},
    {400., 0.3, 20.0, 1.0, 1.0},
    {2e3, 0.9, 0.0, 1.27, 2.2},
    {1e9, 0.5, 10.0, 1.5, 2.0}};    // the last pulls with half of k2 x_p^n
constexpr double tiny = 1e-11 * k1;

TEST(Eepa, HasTheBranchesOfThePapers)
{
  for (const Material &its : materials) {
    SCOPED_TRACE(its.words());
    const Pair pair(its.words(), radius, radius);
    Driven contact(pair);
    const double deepest = 0.08;
    for (const double x : {0.1, 0.5, 1.0})
      EXPECT_NEAR(contact.at(r_eff * x * deepest), its.loading(x * deepest), tiny);
    const double from = its.begin(deepest);
    for (const double part : {0.9, 0.3, 0.6, 0.0}) {    // up and down the same line
      const double x = from + part * (deepest - from);
      EXPECT_NEAR(contact.at(r_eff * x), its.unloading(x, deepest), tiny);
      EXPECT_NEAR(contact.kept(1), std::pow(deepest, its.n), 1e-13);
    }
    EXPECT_NEAR(contact.at(r_eff * from), -its.most(deepest) - its.f0, tiny);
    for (const double part : {0.9, 0.5, 0.1})
      EXPECT_NEAR(contact.at(r_eff * part * from), its.pulling(part * from, deepest), tiny);
    EXPECT_LT(contact.kept(0), 0.7 * contact.kept(1));
    EXPECT_NEAR(contact.kept(1), std::pow(deepest, its.n), 1e-13);
  }
}

TEST(Eepa, PullsByTheAreaOfDeepContactsAndByHalfOfShallowOnes)
{
  const Material &its = materials[0];
  EXPECT_LT(its.most(0.08), 0.4 * its.k2() * its.lambda * std::pow(0.08, 1.5));
  EXPECT_EQ(its.most(1e-3), 0.5 * its.k2() * its.lambda * std::pow(1e-3, 1.5));
  const Pair pair(its.words(), radius, radius);
  Driven contact(pair);
  contact.at(r_eff * 1e-3);
  const double begin = its.begin(1e-3);
  EXPECT_NEAR(begin, std::pow(0.5 * its.lambda, 1 / 1.5) * 1e-3, 1e-15);
  EXPECT_NEAR(contact.at(r_eff * begin), -its.most(1e-3), 1e-9 * its.most(1e-3));
}

TEST(Eepa, LoadsAgainFromTheAdhesiveBranch)
{
  for (const Material &its : materials) {
    SCOPED_TRACE(its.words());
    const Pair pair(its.words(), radius, radius);
    Driven contact(pair);
    const double deepest = 0.08, x = 0.6 * its.begin(deepest);
    contact.go(0, r_eff * deepest);
    EXPECT_NEAR(contact.go(r_eff * deepest, r_eff * x), its.pulling(x, deepest), tiny);
    const double again = std::pow(contact.kept(), 1 / its.n);    // where it meets loading
    EXPECT_LT(again, deepest);
    EXPECT_NEAR(its.unloading(x, again), its.pulling(x, deepest), tiny);
    const double y = 0.5 * (x + again);
    EXPECT_NEAR(contact.go(r_eff * x, r_eff * y), its.unloading(y, again), tiny);
    EXPECT_NEAR(contact.go(r_eff * y, r_eff * again), its.loading(again), tiny);
    // the adhesive branch stays that of the deepest state
    EXPECT_NEAR(contact.go(r_eff * again, r_eff * x), its.pulling(x, deepest), tiny);
    EXPECT_NEAR(contact.go(r_eff * x, r_eff * 1.2 * deepest), its.loading(1.2 * deepest), tiny);
    const double deeper = 0.5 * its.begin(1.2 * deepest);
    EXPECT_NEAR(contact.go(r_eff * 1.2 * deepest, r_eff * deeper),
                its.pulling(deeper, 1.2 * deepest), tiny);
  }
}

TEST(Eepa, IsHertzMaterialWithoutPlasticity)
{
  const std::string more = " tangential multistep NULL NULL 0.5";
  const Pair pair("eepa 1e6 0.6 0.3 0 0 0 1.5 1.5" + more, radius, 3.0),
      hertz("hertz/material 1e6 0.6 0.3" + more, radius, 3.0);
  for (const double overlap : {1e-4, 1e-2, 0.2}) {
    const ContactLanes<double> s = pair.contact(-overlap, {-0.4, 0.3, 0.1}),
                               h = hertz.contact(-overlap, {-0.4, 0.3, 0.1});
    EXPECT_NEAR(s.force.x, h.force.x, 1e-13 * h.force.x);
    EXPECT_NEAR(s.gn, h.gn, 1e-13 * h.gn);
    EXPECT_NEAR(s.kt, h.kt, 1e-13 * h.kt);
    EXPECT_NEAR(s.gt, h.gt, 1e-13 * h.gt);
    EXPECT_NEAR(s.tangent_n, h.tangent_n, 1e-13 * h.tangent_n);
    EXPECT_NEAR(pair.stored(-overlap), hertz.stored(-overlap), 1e-13 * hertz.stored(-overlap));
  }
}

TEST(Eepa, IsWaltonAndBraunsWithTheExponent1)
{
  const double stiffness = k1 / r_eff;
  std::ostringstream words;
  words.precision(17);
  words << "walton/braun " << stiffness << " " << stiffness / 0.4 << " 0";
  const Pair walton(words.str(), radius, radius),
      pair("eepa 1e6 1 0.3 0 0.6 0 1 1", radius, radius);
  Driven contact(pair), expected(walton);
  for (const double x : {0.02, 0.05, 0.04, 0.032, 0.045, 0.06, 0.037, 0.02}) {
    const double force = expected.at(x);
    EXPECT_NEAR(contact.at(x), force, tiny) << x;
    EXPECT_NEAR(pair.stored(-x, contact.history()), walton.stored(-x, expected.history()), tiny);
  }
}

TEST(Eepa, StoresWhatItGivesBack)
{
  for (const Material &its : materials) {
    SCOPED_TRACE(its.words());
    const Pair pair(its.words(), radius, radius);
    Driven contact(pair);
    const double deepest = 0.08 * r_eff;
    const double end = r_eff * std::pow(its.lambda, 1 / its.n) * 0.08;    // no elastic force
    contact.go(0, deepest);
    const double stored = pair.stored(-deepest, contact.history());
    const double work =
        integral([&](double x) { return contact.at(deepest - x); }, 0, deepest - end, 4000);
    EXPECT_NEAR(stored - pair.stored(-end, contact.history()), work, 1e-9 * std::abs(stored));
    EXPECT_NEAR(pair.stored(-end, contact.history()), -its.f0 * end, 1e-12 * std::abs(stored));
    // on the adhesive branch what the way up to no force gives
    const double low = 0.7 * r_eff * its.begin(0.08);
    contact.go(end, low);
    const double here = pair.stored(-low, contact.history());
    const double up = r_eff * std::pow(its.lambda * contact.kept(), 1 / its.n);
    const double back = integral([&](double x) { return contact.at(x); }, low, up, 4000);
    EXPECT_NEAR(here - pair.stored(-up, contact.history()), -back, 1e-8 * stored);
  }
}

TEST(Eepa, IsTheSameWhereHistoryIsOnlyRead)
{
  for (const Material &its : materials) {
    const Pair pair(its.words(), radius, radius);
    Driven contact(pair);
    contact.go(0, 0.04);
    for (const double x : {0.036, 0.02, 0.004, 0.001, 0.01, 0.04, 0.06}) {
      const double force = contact.at(x);
      const ContactLanes<double> s = pair.contact(-x, {}, contact.history());
      EXPECT_EQ(s.force.x, force) << its.words() << " at " << x;
    }
  }
}

TEST(Eepa, LimitsFrictionByTheDistanceFromTheAdhesiveBranch)
{
  const Material &its = materials[1];
  const Pair pair(its.words() + " tangential dashpot 1e9 0.3", radius, radius);
  Driven contact(pair);
  contact.at(0.08 * r_eff);
  const double begin = its.begin(0.08);
  for (const double x : {0.08, 1.1 * begin, 0.6 * begin}) {
    contact.at(r_eff * x);
    const double beyond = x > begin ? its.unloading(x, 0.08) - its.pulling(x, 0.08) : 0.0;
    const ContactLanes<double> s = pair.contact(-r_eff * x, {0.0, 1.0, 0.0}, contact.history());
    EXPECT_NEAR(s.force.y, -0.3 * beyond, tiny) << x;
  }
}

/// Without adhesion that of a power law, at all speeds; with exponent 1 sqrt(k1/k2).
TEST(Eepa, HasARestitutionAtAllSpeedsWithoutAdhesion)
{
  for (const double n : {1.0, 1.5, 2.0}) {
    const double lambda = 0.6, p = std::pow(lambda, 1 / n);
    const double back = (1 - std::pow(p, n + 1) - (n + 1) * lambda * (1 - p)) / (1 - lambda);
    if (n == 1.0) {
      EXPECT_NEAR(back, 1 - lambda, 1e-12);
    }
    const Pair pair(Material{0.0, lambda, 0.0, n, 1.0}.words(), radius, radius);
    for (const double speed : {0.1, 3.0})
      EXPECT_NEAR(restitution_of(pair, speed, 2e-7 * std::pow(speed, -0.3)), std::sqrt(back), 2e-3)
          << n << " " << speed;
  }
}

/// Of a contact that has been loaded to `deepest`, over the work of loading: what it gives until bodies part.
double given_back(const Pair &pair, const Material &its, double deepest)
{
  Driven contact(pair);
  contact.at(r_eff * deepest);
  const auto force = [&](double x) { return contact.at(r_eff * (deepest - x)); };
  const double load = k1 * std::pow(deepest, its.n + 1) / (its.n + 1);
  return integral(force, 0, deepest, 20000) / load;
}

TEST(Eepa, HasARestitutionThatDependsOnSpeedWithAdhesionAndSticksBelowOne)
{
  const Material its{400., 0.6, 0.0, 1.5, 1.5};
  const Pair pair(its.words(), radius, radius);
  const double deepest = 0.08, back = given_back(pair, its, deepest);
  ASSERT_GT(back, 0.1);
  // 1/m = 2
  const double speed = std::sqrt(4.0 * k1 * r_eff * std::pow(deepest, its.n + 1) / (its.n + 1));
  EXPECT_NEAR(restitution_of(pair, speed, 1e-7), std::sqrt(back), 2e-3);
  EXPECT_GT(given_back(pair, its, 0.16), back + 0.02);
  EXPECT_LT(given_back(pair, its, 0.001), -0.05);
}

TEST(Eepa, IsRefusedWhereItCannotBe)
{
  const Pair pair(materials[0].words(), radius, radius);
  EXPECT_NE(reason_against_second_order(pair.law, pair.row).find("eepa"), std::string::npos);
  EXPECT_NE(PointBatch::refusal(pair.law).find("eepa"), std::string::npos);
  EXPECT_NE(problem_of("eepa 1e6 1 0.3 0 1 0 1.5 1.5").find("plasticity ratio"), std::string::npos);
  EXPECT_NE(problem_of("eepa 1e6 1 0.3 0 0.5 0 0.9 1.5").find("exponent n"), std::string::npos);
  EXPECT_NE(problem_of(materials[0].words() + " limit_damping").find("cohesive"),
            std::string::npos);
}

TEST(Eepa, TellsTimeStepsItsLargestStiffness)
{
  const Material &its = materials[0];
  const Pair pair(its.words(), radius, radius);
  const double x = 0.01, expected = its.n * its.k2() / r_eff * std::pow(x, its.n - 1);
  EXPECT_NEAR(tangent_stiffness(pair.law, pair.row, r_eff * x, 1.0, r_eff), expected,
              1e-12 * expected);
}

TEST(RealPower, IsAPower)
{
  for (const double e : {0.1, 1.0, 1.5, 3.7, 20.0})
    for (const double x : {1e-200, 3e-9, 0.02, 0.7, 1.0, 12.5}) {
      const double expected = std::pow(x, e);
      if (expected < 1e-299)
        EXPECT_EQ(real_power(x, e), 0.0);
      else
        EXPECT_NEAR(real_power(x, e), expected, 4e-16 * (1 + std::abs(e * std::log(x))) * expected);
    }
  EXPECT_EQ(real_power(0.0, 1.5), 0.0);
}

}    // namespace
