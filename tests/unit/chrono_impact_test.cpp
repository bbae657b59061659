// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Chrono's own test of restitution: two equal spheres in a central impact, of radius .5 and mass 1, each at speed 1;
// Young's modulus 2e5, Poisson's ratio .3, mu .3, time step 3e-5, .5 time units. With displacement history the
// characteristic speed of hooke/material is the impact velocity (2), else the setting (1): its default in Chrono.

#include "material/contact_spec.h"
#include "two_spheres.h"

#include <gtest/gtest.h>

#include <iomanip>
#include <iostream>

using namespace Talus;
using namespace named;
using namespace reference;

namespace {

struct Impact {
  double restitution, duration;
};

Impact collide(NamedLaw law, double e, bool limited)
{
  ContactSpec spec;
  spec.law = law;
  spec.given["E"] = 2e5;
  spec.given["nu"] = 0.3;
  spec.given["e"] = e;
  if (limited) spec.given["limit_damping"] = 1.0;
  spec.given["mu"] = 0.3;
  spec.given["vchar"] = 1.0;
  TwoSpheres scene({0.5, 1.0, {0.0, 0.625, 0.0}, {0.0, -1.0, 0.0}},
                   {0.5, 1.0, {0.0, -0.625, 0.0}, {0.0, 1.0, 0.0}});
  scene.law = law;
  scene.coefficients = numbers_of(law, contact_coefficients(spec, spec, FrictionMix::MINIMUM));
  scene.dt = 3e-5;
  int steps = 0;
  for (double time = 0.0; time < 0.5; time += scene.dt) {
    scene.compute();
    steps += scene.overlap() > 0.0;
    scene.move();
  }
  // central: no spin, no sideways motion
  EXPECT_EQ(norm(scene.body[0].omega), 0.0);
  EXPECT_EQ(scene.body[0].v[0], 0.0);
  EXPECT_EQ(scene.body[0].v[1], -scene.body[1].v[1]);
  return {scene.body[0].v[1], steps * scene.dt};
}

TEST(ChronoImpact, RestitutionIsTheOneAskedFor)
{
  const Normal hooke = Normal::HOOKE_MATERIAL, hertz = Normal::HERTZ_MATERIAL;
  const NamedLaw laws[] = {{hooke, Tangential::ONESTEP},
                           {hooke, Tangential::MULTISTEP},
                           {hertz, Tangential::ONESTEP},
                           {hertz, Tangential::MULTISTEP},
                           {Normal::PLAINCOULOMB_MATERIAL, Tangential::TANH}};
  std::cout << "e_out - e for e =            0        .25       .5        .75       1      "
               "limited: .25, .5, .75, 1\n"
            << std::setprecision(1) << std::scientific << std::left;
  for (const NamedLaw &law : laws) {
    std::cout << std::setw(14) << name_of(law.normal) << " " << std::setw(9)
              << name_of(law.tangential);
    for (bool limited : {false, true})
      for (double e : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        if (limited && e == 0.0) continue;    // no finite damping does that
        const Impact out = collide(law, e, limited);
        std::cout << std::setw(9) << std::showpos << out.restitution - e << std::noshowpos << " ";
        EXPECT_LE(std::fabs(out.restitution - e), 1e-3)
            << name_of(law.normal) << " " << e << " limited " << limited << " contact of "
            << out.duration;
      }
    std::cout << "\n";
  }
}

// The impact velocity of a history law enters: elastic contacts last pi sqrt(m/k) with k ~ v^(2/5).
TEST(ChronoImpact, CharacteristicSpeedIsAtLeastTheImpactSpeed)
{
  const double one = collide({Normal::HOOKE_MATERIAL, Tangential::ONESTEP}, 1.0, false).duration;
  const double two = collide({Normal::HOOKE_MATERIAL, Tangential::MULTISTEP}, 1.0, false).duration;
  const double scale = 16.0 / 15.0 * 0.5 * (2e5 / (2.0 * 0.91));    // 16/15 sqrt(R) E
  const auto expected = [=](double v) {
    return std::acos(-1.0) * std::sqrt(0.5 / (scale * std::pow(0.5 * v * v / scale, 0.2)));
  };
  EXPECT_NEAR(one, expected(1.0), 1e-4);
  EXPECT_NEAR(two, expected(2.0), 1e-4);
}

}    // namespace
