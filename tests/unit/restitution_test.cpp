// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Damping from restitution: every law, with and without limit_damping, gives the restitution that
// was asked for. Measured by integrating an impact with a Runge-Kutta scheme of its own around the
// kernels' own normal forces.

#include "laws/contact_energy.h"
#include "laws/contact_kernel.h"
#include "laws/restitution.h"
#include "material/contact_spec.h"
#include "named_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace Talus;
using namespace named;

namespace {

/// Normal force of a law at an overlap and a speed of separation (negative: approach), as queries
/// give it.
struct Impact {
  NamedLaw law;
  ContactCoefficients c;
  bool limited = false;
  double mass = 0.7, radius = 0.2;

  double force(double overlap, double separation) const
  {
    ContactState<double> s{};
    s.normal = {1.0, 0.0, 0.0};
    s.overlap = std::max(overlap, 0.0);
    s.velocity = {separation, 0.0, 0.0};
    s.inverse_mass = 1.0 / mass;
    s.inverse_radius = 1.0 / radius;
    return single_contact(law, c, s, 1e-5).normal_force;
  }

  /// Speed after an impact over that before. The contact ends at overlap zero; with limit_damping
  /// no force acts after it has vanished, so what follows may be cut off.
  double restitution(double speed) const
  {
    const double young = numbers_of(law, c).kn;
    const double hertz_time = std::pow(mass * mass / (radius * young * young * speed), 0.2);
    const double h = 5e-4 * hertz_time;
    double x = 0.0, v = speed, x_before = 0.0, v_before = 0.0;    // overlap and its rate
    for (long step = 0; step < 2000000; step++) {
      const auto rate = [&](double at_x, double at_v) { return -force(at_x, -at_v) / mass; };
      const double a1 = rate(x, v);
      if (v < 0.0 && limited && a1 == 0.0) return -v / speed;
      if (v < 0.0 && x <= 0.0) return -(v + x / (x_before - x) * (v - v_before)) / speed;
      if (v < 0.0 && v > -1e-7 * speed && a1 > 0.0) return 0.0;    // over-damped: creeps back
      const double v2 = v + 0.5 * h * a1, a2 = rate(x + 0.5 * h * v, v2);
      const double v3 = v + 0.5 * h * a2, a3 = rate(x + 0.5 * h * v2, v3);
      const double v4 = v + h * a3, a4 = rate(x + h * v3, v4);
      x_before = x;
      v_before = v;
      x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    ADD_FAILURE() << "the contact does not end";
    return -1.0;
  }
};

Impact impact_of(Normal normal, double e, bool limited)
{
  Impact i;
  i.law = {normal, normal == Normal::PLAINCOULOMB_MATERIAL ? Tangential::TANH : Tangential::NONE};
  i.limited = limited;
  ContactSpec spec;
  spec.law = i.law;
  spec.given["E"] = 1e6;
  spec.given["nu"] = 0.25;
  spec.given["e"] = e;
  if (limited) spec.given["limit_damping"] = 1.0;
  spec.given["vchar"] = 0.5;
  i.c = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
  return i;
}

TEST(Restitution, IsTheOneAskedForInAnIndependentIntegration)
{
  std::cout << "largest |e_out - e|\n" << std::scientific << std::setprecision(1);
  for (Normal law : {Normal::HOOKE_MATERIAL, Normal::HERTZ_MATERIAL, Normal::PLAINCOULOMB_MATERIAL})
    for (bool limited : {false, true}) {
      double worst = 0.0;
      for (double e :
           {0.02, 0.05, 0.1, 0.135, 0.136, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0})
        for (double speed : {0.1, 3.0}) {
          const double out = impact_of(law, e, limited).restitution(speed);
          worst = std::max(worst, std::fabs(out - e));
          EXPECT_NEAR(out, e, 1e-4) << name_of(law) << " limited " << limited << " speed " << speed;
        }
      std::cout << name_of(law) << (limited ? " limited " : " ") << worst << "\n";
    }
}

TEST(Restitution, ZeroIsReachedOrAlmost)
{
  EXPECT_LT(impact_of(Normal::HERTZ_MATERIAL, 0.0, false).restitution(1.0), 1e-6);
  EXPECT_LT(impact_of(Normal::PLAINCOULOMB_MATERIAL, 0.0, false).restitution(1.0), 1e-6);
  EXPECT_LT(impact_of(Normal::HOOKE_MATERIAL, 0.0, false).restitution(1.0), 1e-6);
  for (double e : {0.0, 1e-6, 0.005})    // limited: no finite damping gives less than .01's
    EXPECT_EQ(hertz_damping_factor_limited(e), hertz_damping_factor_limited(0.01));
  EXPECT_NEAR(impact_of(Normal::HERTZ_MATERIAL, 0.0, true).restitution(1.0), 0.01, 1e-4);
}

TEST(Restitution, FactorsAreMonotonic)
{
  for (auto factor : {linear_damping_factor, hertz_damping_factor, linear_damping_factor_limited,
                      hertz_damping_factor_limited, flores_damping_factor})
    for (double e = 0.02; e < 0.999; e += 0.001) EXPECT_GT(factor(e), factor(e + 0.001)) << e;
  EXPECT_LT(linear_damping_factor(1.0), 1e-15);
  EXPECT_EQ(hertz_damping_factor(1.0), 0.0);
  EXPECT_EQ(linear_damping_factor_limited(1.0), 0.0);
  EXPECT_EQ(hertz_damping_factor_limited(1.0), 0.0);
  EXPECT_LT(flores_damping_factor(1.0), 1e-15);
}

// Thornton, Cummins and Cleary 2013 fit the limited Hertzian contact; their damping is 2 beta
// sqrt(S_n m). The fit loses its digits near e = 1.
TEST(Restitution, ThorntonsFitIsClose)
{
  const double h[] = {-6.918798, -16.41105, 146.8049,  -796.4559, 2928.711,
                      -7206.864, 11494.29,  -11342.18, 6276.757,  -1489.915};
  double worst = 0.0;
  for (double e = 0.02; e < 0.901; e += 0.01) {
    double alpha = 0.0;
    for (int n = 9; n >= 0; n--) alpha = e * (h[n] + alpha);
    const double beta = std::sqrt(1.0 / (1.0 - (1.0 + e) * (1.0 + e) * std::exp(alpha)) - 1.0);
    worst = std::max(worst, std::fabs(2.0 * beta / hertz_damping_factor_limited(e) - 1.0));
  }
  std::cout << "largest deviation of Thornton's damping, e from .02 to .9: " << worst << "\n";
  EXPECT_LT(worst, 5e-3);
}

// gn/(2 sqrt(m k)): of a linear contact the usual one; of hertz/material half its factor, at any
// overlap, mass and radius.
TEST(Restitution, DampingRatio)
{
  Numbers c;
  c.kn = 4.0;
  c.gn = 0.4;    // 1/time
  const auto ratio = [&c](Normal normal, double overlap, double mass, double radius) {
    const NamedLaw law{normal};
    return damping_ratio(law, row_of(law, c), overlap, mass, radius);
  };
  EXPECT_DOUBLE_EQ(ratio(Normal::HOOKE, 0.1, 1.0, 0.5), 0.1);
  c.gn = hertz_damping_factor(0.9);
  for (double overlap : {1e-6, 0.1})
    for (double mass : {1e-3, 10.0})
      EXPECT_NEAR(ratio(Normal::HERTZ_MATERIAL, overlap, mass, 0.2), 0.5 * c.gn, 1e-14);
  c.kn = 0.0;
  EXPECT_EQ(ratio(Normal::HOOKE, 0.1, 1.0, 0.5), 0.0);
}

}    // namespace
