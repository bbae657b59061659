// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Lift and drag of rotation against numbers that were computed by hand from the published formulas, their directions, and limits.

#include "fluid/lift_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace Talus;

namespace {

constexpr double pi = 3.14159265358979323846, water = 1000.0, of_water = 1e-3;

LiftLaw law(const std::string &name)
{
  const auto &names = LiftLaw::names();
  LiftLaw one;
  EXPECT_TRUE(
      one.take(static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin())));
  return one;
}

/// A grain of 1 mm in water that lags behind it by `slip` along x, in a shear du_x/dy (vorticity -shear along z), and turns
/// with `omega` about z.
TurningGrain grain(double slip, double shear, double omega)
{
  return {1e-3, {slip, 0.0, 0.0}, {0.0, 0.0, omega}, {0.0, 0.0, -shear}, water, of_water};
}

double lift(const std::string &name, const TurningGrain &g)
{
  const Vector3<double> force = law(name).force(g);
  EXPECT_EQ(force.x, 0.0);
  EXPECT_EQ(force.z, 0.0);
  return force.y;
}

/* 6.46 mu r^2 w (shear/nu)^1/2 */

TEST(LiftLaw, SaffmanLiftsLaggingGrainsToTheFasterFluid)
{
  const double r = 5e-4, w = 0.002, shear = 40.0;
  EXPECT_NEAR(lift("saffman", grain(w, shear, 0.0)) /
                  (6.46 * of_water * r * r * w * std::sqrt(shear / 1e-6)),
              1.0, 1e-12);
  EXPECT_LT(lift("saffman", grain(-w, shear, 0.0)), 0.0);
  EXPECT_EQ(lift("saffman", grain(w, 0.0, 0.0)), 0.0);
}

/* Re = 2 and Re_s = 40: beta = 10; Re = 100, Re_s = 40: beta = .2. */

TEST(LiftLaw, MeiCorrectsForLargerReynoldsNumbers)
{
  const auto ratio = [](double slip, double shear) {
    return lift("saffman/mei", grain(slip, shear, 0.0)) / lift("saffman", grain(slip, shear, 0.0));
  };
  const double root = 0.3314 * std::sqrt(10.0);
  EXPECT_NEAR(ratio(0.002, 40.0), (1.0 - root) * std::exp(-0.2) + root, 1e-12);
  EXPECT_NEAR(ratio(0.1, 40.0), 0.0524 * std::sqrt(0.2 * 100.0), 1e-12);
  EXPECT_NEAR(ratio(1e-6, 1e-6), 1.0, 1e-3);
  EXPECT_NEAR(ratio(0.0399999, 40.0), ratio(0.0400001, 40.0), 0.02);
  EXPECT_EQ(lift("saffman/mei", grain(0.0, 40.0, 0.0)), 0.0);
}

/* Backspin lifts: with w = u - v along x the grain moves along -x through the fluid, and with omega < 0 its upper side goes along
   x, with the fluid that passes. */

TEST(LiftLaw, MagnusLiftsByRotationAgainstTheFluid)
{
  const double w = 1e-4;
  EXPECT_NEAR(lift("magnus", grain(w, 0.0, 2.0)) / (pi * water * 1.25e-10 * 2.0 * w), 1.0, 1e-12);
  EXPECT_LT(lift("magnus", grain(w, 0.0, -2.0)), 0.0);
  EXPECT_EQ(lift("magnus", grain(w, 40.0, -20.0)), 0.0);    // it turns with the fluid
  EXPECT_NEAR(lift("magnus/oesterle", grain(1e-7, 0.0, 1e-3)) /
                  lift("magnus", grain(1e-7, 0.0, 1e-3)),
              1.0, 1e-3);
  EXPECT_EQ(lift("magnus/oesterle", grain(0.0, 0.0, 1.0)), 0.0);
}

/* Re = 50, Re_O = 100: C = .45 + (2 - .45) exp(-.05684 100^.4 50^.3), F = C pi/8 rho d^2 w^2. */

TEST(LiftLaw, OesterleAndBuiDinhAtIntermediateReynoldsNumbers)
{
  const double c = 0.45 + 1.55 * std::exp(-0.05684 * std::pow(100.0, 0.4) * std::pow(50.0, 0.3));
  EXPECT_NEAR(lift("magnus/oesterle", grain(0.05, 0.0, 100.0)) /
                  (c * pi / 8.0 * water * 1e-6 * 0.0025),
              1.0, 1e-12);
}

TEST(LiftLaw, RotationIsDraggedByStokesTorqueAndMoreAbove)
{
  const auto torque = [](double omega) {
    return LiftLaw::rotation_coefficient(grain(0.0, 0.0, omega));
  };
  EXPECT_NEAR(torque(1.0) / (8.0 * pi * of_water * 1.25e-10), 1.0, 1e-12);
  EXPECT_NEAR(torque(31.999) / torque(32.001), 1.0, 2e-3);
  // Re_O = 400: rho/2 r^5 (12.9/20 + 128.4/400) omega
  EXPECT_NEAR(torque(400.0) / (0.5 * water * std::pow(5e-4, 5) * (0.645 + 0.321) * 400.0), 1.0,
              1e-12);
}

TEST(LiftLaw, OneOfAKind)
{
  LiftLaw one;
  for (const int which : {0, 2, 4}) EXPECT_TRUE(one.take(which));
  for (int which = 0; which < 5; which++) EXPECT_FALSE(one.take(which));
  EXPECT_TRUE(one.any() && one.needs_vorticity() && one.drags_rotation());
  EXPECT_FALSE(law("magnus").needs_vorticity());
  EXPECT_FALSE(LiftLaw().any());
}

}    // namespace
