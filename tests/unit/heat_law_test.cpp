// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Nusselt numbers against those computed elsewhere from the published formulas, and their limits.

#include "fluid/heat_law.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Talus;

namespace {

enum { RANZ_MARSHALL, GUNN };

constexpr double water = 1000.0, of_water = 1e-3, air = 1.2, of_air = 1.8e-5;

/// Reynolds numbers 10, 4, 300, 4000 and 0.
const GrainInFluid grains[5] = {{1e-3, 0.01, 0.45, water, of_water},
                                {2e-4, 0.3, 0.9, air, of_air},
                                {3e-3, 1.5, 0.62, air, of_air},
                                {5e-3, 0.8, 0.95, water, of_water},
                                {1e-3, 0.0, 0.4, air, of_air}};
const double prandtl[5] = {7.0, 0.7, 0.7, 7.0, 0.7};

const double published[2][5] = {
    {5.629531726832360e+00, 3.065484802091121e+00, 1.122736905957145e+01, 7.459063453664720e+01,
     2.000000000000000e+00},
    {1.256931432580145e+01, 4.005260732417106e+00, 1.797726265820492e+01, 9.756958016826391e+01,
     3.800000000000000e+00}};

}    // namespace

TEST(HeatLaw, Published)
{
  ASSERT_EQ(HeatLaw::names().size(), 2U);
  EXPECT_EQ(HeatLaw::names()[RANZ_MARSHALL], "ranz/marshall");
  EXPECT_EQ(HeatLaw::names()[GUNN], "gunn");
  for (int law = 0; law < 2; law++)
    for (int k = 0; k < 5; k++)
      EXPECT_NEAR(HeatLaw(law).nusselt(grains[k], prandtl[k]) / published[law][k], 1.0, 1e-13);
}

TEST(HeatLaw, GrainAloneAtRest)
{
  const GrainInFluid alone{1e-3, 0.0, 1.0, air, of_air};
  EXPECT_NEAR(HeatLaw(RANZ_MARSHALL).nusselt(alone, 0.7), 2.0, 1e-15);
  EXPECT_NEAR(HeatLaw(GUNN).nusselt(alone, 0.7), 2.0, 1e-15);
}

TEST(HeatLaw, PorosityCounts)
{
  EXPECT_FALSE(HeatLaw(RANZ_MARSHALL).depends_on_porosity());
  EXPECT_TRUE(HeatLaw(GUNN).depends_on_porosity());
  GrainInFluid dense = grains[2];
  dense.porosity = 0.4;
  EXPECT_EQ(HeatLaw(RANZ_MARSHALL).nusselt(dense, 0.7),
            HeatLaw(RANZ_MARSHALL).nusselt(grains[2], 0.7));
  EXPECT_GT(std::fabs(HeatLaw(GUNN).nusselt(dense, 0.7) - HeatLaw(GUNN).nusselt(grains[2], 0.7)),
            0.1);
}
