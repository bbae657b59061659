// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Laws of drag against numbers that were computed elsewhere from the published formulas (drag coefficient, beta, or F, which
// have poles at rest); limits; the pressure drop of beds.

#include "fluid/drag_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace Talus;

namespace {

constexpr double pi = 3.14159265358979323846, water = 1000.0, of_water = 1e-3, air = 1.2,
                 of_air = 1.8e-5;

DragLaw law(const std::string &name, bool total = false)
{
  const auto &names = DragLaw::names();
  const auto found = std::find(names.begin(), names.end(), name);
  EXPECT_NE(found, names.end()) << name;
  return DragLaw(static_cast<int>(found - names.begin()), name == "ganser" ? 0.8 : 1.0, total);
}

/// Reynolds numbers 4.5, 3.6, 186 and 3800.
const GrainInFluid grains[4] = {{1e-3, 0.01, 0.45, water, of_water},
                                {2e-4, 0.3, 0.9, air, of_air},
                                {3e-3, 1.5, 0.62, air, of_air},
                                {5e-3, 0.8, 0.95, water, of_water}};

struct Published {
  const char *name;
  double coefficient[4];
};

const Published published[] = {
    {"stokes",
     {9.424777960769379e-06, 3.392920065876977e-08, 5.089380098815465e-07, 4.712388980384690e-05}},
    {"schiller/naumann",
     {1.630119782900984e-05, 4.712027297620198e-08, 4.350770705782137e-06, 3.455751918948773e-03}},
    {"hoelzer/sommerfeld",
     {1.479958470357756e-05, 4.478654486957609e-08, 4.282745675531952e-06, 3.718343236040483e-03}},
    {"difelice",
     {8.886304496118027e-05, 6.463699166322320e-08, 1.097304956092598e-05, 4.277567997740277e-03}},
    {"wen/yu",
     {1.111782560035211e-04, 6.107899032478206e-08, 1.162559649082496e-05, 3.760959087707170e-03}},
    {"ergun",
     {1.051560874326584e-04, 4.461061568097505e-08, 1.744343985481107e-05, 1.834662551866145e-02}},
    {"gidaspow",
     {1.051560874326584e-04, 6.107899032478206e-08, 1.744343985481107e-05, 3.760959087707170e-03}},
    {"koch/hill",
     {1.213803126283569e-04, 8.391141309401825e-08, 1.040869682437736e-05, 8.799974666979758e-03}},
    {"beetstra",
     {1.195808461612434e-04, 8.291402390400114e-08, 1.294053277556223e-05, 5.513115475472805e-03}},
    {"rong",
     {9.394273727428382e-05, 6.911477594900769e-08, 1.196813901759327e-05, 4.581273891605756e-03}},
    {"ganser",
     {2.026937702553535e-05, 5.646685623299313e-08, 7.261278715532738e-06, 1.039699511141635e-02}},
};

}    // namespace

TEST(DragLaw, Published)
{
  EXPECT_EQ(std::size(published), DragLaw::names().size());
  for (const Published &one : published)
    for (int k = 0; k < 4; k++)
      EXPECT_NEAR(law(one.name).coefficient(grains[k]) / one.coefficient[k], 1.0, 1e-13)
          << one.name << " " << k;
}

TEST(DragLaw, Shapes)
{
  const double expected[2][4] = {
      {2.038211313384838e-05, 5.696990632253509e-08, 9.834686455201172e-06, 1.029052759253362e-02},
      {1.883977486161024e-05, 5.517490877648890e-08, 6.266302576734054e-06, 5.617088607920156e-03}};
  const double sphericities[2][2] = {{0.8, 0.6}, {0.6, 1.3}};
  for (int shape = 0; shape < 2; shape++)
    for (int k = 0; k < 4; k++) {
      GrainInFluid grain = grains[k];
      grain.sphericity = sphericities[shape][0];
      grain.crosswise = sphericities[shape][1];
      EXPECT_NEAR(law("hoelzer/sommerfeld").coefficient(grain) / expected[shape][k], 1.0, 1e-13);
    }
}

/* Dallavalle's coefficient at rest is that of Stokes times 4.8^2/24. */

TEST(DragLaw, GrainAloneAtRest)
{
  const GrainInFluid alone{1e-3, 0.0, 1.0, water, of_water};
  const double stokes = 3.0 * pi * of_water * 1e-3;
  for (const char *name : {"stokes", "schiller/naumann", "hoelzer/sommerfeld", "wen/yu", "gidaspow",
                           "koch/hill", "beetstra"})
    EXPECT_NEAR(law(name).coefficient(alone) / stokes, 1.0, 1e-14) << name;
  for (const char *name : {"difelice", "rong"})
    EXPECT_NEAR(law(name).coefficient(alone) / stokes, 4.8 * 4.8 / 24.0, 1e-14) << name;
  EXPECT_EQ(law("ergun").coefficient(alone), 0.0);
  EXPECT_NEAR(DragLaw(2, 1.0).coefficient(alone) / stokes, 1.0, 1e-14);
}

TEST(DragLaw, NoPoleAtRest)
{
  for (const std::string &name : DragLaw::names())
    for (const double porosity : {0.1, 0.4, 0.6, 0.999, 1.0}) {
      const double at_rest = law(name).coefficient({1e-3, 0.0, porosity, water, of_water}),
                   slow = law(name).coefficient({1e-3, 1e-12, porosity, water, of_water});
      EXPECT_TRUE(std::isfinite(at_rest)) << name;
      EXPECT_NEAR(slow, at_rest, 1e-5 * at_rest + 1e-13) << name << porosity;
    }
}

/* All of the force on grains of a bed is (beta w)(1 + s/e) per volume with the gradient that balances beta w = e grad p:
   the whole pressure drop, by c/e. */

TEST(DragLaw, PressureDropOfABed)
{
  const double d = 2e-3, e = 0.42, s = 1.0 - e, superficial = 0.013,
               drop = 150.0 * of_water * s * s * superficial / (e * e * e * d * d) +
                      1.75 * water * s * superficial * superficial / (e * e * e * d);
  const GrainInFluid grain{d, superficial / e, e, water, of_water};
  const double grains_per_volume = s / (pi / 6.0 * d * d * d);
  EXPECT_NEAR(law("ergun", true).coefficient(grain) * grain.speed * grains_per_volume / drop, 1.0,
              1e-14);
  EXPECT_NEAR(law("ergun").coefficient(grain) * grain.speed * grains_per_volume / (e * drop), 1.0,
              1e-14);
  for (const char *name :
       {"koch/hill", "beetstra", "rong", "difelice"}) {    // measured and simulated beds differ
    const double ratio =
        law(name, true).coefficient(grain) * grain.speed * grains_per_volume / drop;
    EXPECT_GT(ratio, 0.8) << name;
    EXPECT_LT(ratio, 1.2) << name;
  }
}

TEST(DragLaw, PorosityCounts)
{
  const GrainInFluid thin{1e-3, 0.01, 0.99, water, of_water},
      dense{1e-3, 0.01, 0.5, water, of_water};
  for (const std::string &name : DragLaw::names()) {
    const bool same = law(name).coefficient(thin) == law(name).coefficient(dense);
    EXPECT_EQ(same, !law(name).depends_on_porosity()) << name;
    EXPECT_TRUE(law(name, true).depends_on_porosity());
    EXPECT_EQ(law(name, true).coefficient(dense), law(name).coefficient(dense) / 0.5) << name;
  }
}
