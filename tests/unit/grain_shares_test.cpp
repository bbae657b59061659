// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Shares that are kept while grains stay: found once, the same as without keeping them, with any limit.

#include "fluid/grain_shares.h"
#include "fluid/grid_cells.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace Talus;

namespace {

using Grains = std::vector<GrainShares::Grain>;

GridCells ten_cubed()
{
  const double lo[3] = {0, 0, 0}, hi[3] = {10, 10, 10};
  const int cells[3] = {10, 10, 10};
  return GridCells({FluidKernel::Shape::TOP_HAT, 1.5}, lo, hi, cells, {{0, 0, 0}, {0, 0, 0}});
}

Grains some_grains()
{
  RandomSource random(4711);
  Grains grains;
  for (int n = 0; n < 100; n++)
    grains.push_back({{random.uniform(0, 10), random.uniform(0, 10), random.uniform(0, 10)},
                      random.uniform(0.2, 0.6),
                      n % 7 != 0});
  return grains;
}

std::vector<FluidCells::Share> shares_of(GrainShares &kept, int grain)
{
  std::vector<FluidCells::Share> found;
  kept.for_each(grain, [&](int slot, double share) {
    found.push_back({kept.touched_cells()[slot], share});
  });
  return found;
}

}    // namespace

TEST(GrainShares, AreThoseOfTheCellsWithAnyLimit)
{
  const GridCells cells = ten_cubed();
  const Grains grains = some_grains();
  for (const std::size_t most : {std::size_t{0}, std::size_t{300}, std::size_t{1'000'000}}) {
    GrainShares kept(cells, most);
    kept.update(grains);
    std::vector<FluidCells::Share> expected;
    for (int g = 0; g < 100; g++) {
      ASSERT_TRUE(cells.find_shares(grains[g].x, grains[g].radius, expected));
      const auto found = shares_of(kept, g);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); k++) {
        EXPECT_EQ(found[k].cell, expected[k].cell);
        EXPECT_EQ(found[k].weight, expected[k].weight);
      }
    }
  }
}

TEST(GrainShares, AreFoundOnceUntilGrainsMove)
{
  const GridCells cells = ten_cubed();
  Grains grains = some_grains();
  GrainShares kept(cells);
  const auto ask_all = [&] {
    kept.update(grains);
    for (int g = 0; g < 100; g++)
      if (grains[g].in_fluid) shares_of(kept, g);
  };
  for (int round = 0; round < 3; round++) ask_all();
  const auto once = kept.num_found();
  EXPECT_EQ(once, 85);    // of 100, all but every seventh
  grains[3].x[1] += 1e-14;
  ask_all();
  EXPECT_EQ(kept.num_found(), 2 * once);
  grains[5].radius *= 1.5;
  ask_all();
  EXPECT_EQ(kept.num_found(), 3 * once);
  std::swap(grains[1], grains[2]);
  ask_all();
  EXPECT_EQ(kept.num_found(), 4 * once);
  grains[7].in_fluid = true;
  ask_all();
  EXPECT_EQ(kept.num_found(), 5 * once + 1);
}

TEST(GrainShares, TellTheFirstGrainOutside)
{
  const GridCells cells = ten_cubed();
  Grains grains = some_grains();
  GrainShares kept(cells);
  kept.update(grains);
  EXPECT_EQ(kept.first_outside(), -1);
  grains[0].x[2] = 11;    // not in the fluid
  grains[40].x[2] = 11;
  grains[30] = {{9.5, 0.5, -3}, 0.5, true};
  kept.update(grains);
  EXPECT_EQ(kept.first_outside(), 30);
  const auto nearest = shares_of(kept, 30);
  ASSERT_EQ(nearest.size(), 1U);
  EXPECT_EQ(nearest[0].cell, 9);
  EXPECT_EQ(nearest[0].weight, 1.0);
  kept.update(some_grains());
  EXPECT_EQ(kept.first_outside(), -1);
}
