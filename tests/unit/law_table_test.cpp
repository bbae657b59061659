// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/law_table.h"

#include "named_law.h"

#include <gtest/gtest.h>

#include <set>

using namespace Talus;
using namespace named;

namespace {

constexpr NamedLaw hertz_none{Normal::HERTZ, Tangential::NONE};
constexpr NamedLaw hooke_dashpot{Normal::HOOKE, Tangential::DASHPOT};
constexpr NamedLaw hertz_multistep{Normal::HERTZ, Tangential::MULTISTEP};
constexpr Numbers basic{1.0, 2.0, 3.0, 4.0, 5.0, 0.0};

LawTable filled(int ntypes, NamedLaw law)
{
  LawTable table;
  table.reset(ntypes);
  for (int i = 1; i <= ntypes; i++)
    for (int j = i; j <= ntypes; j++) set(table, i, j, law, basic);
  return table;
}

TEST(LawTable, GivesEveryPairOfTypesARowOfItsOwn)
{
  const LawTable table = filled(4, hertz_none);
  std::set<int> rows;
  for (int i = 1; i <= 4; i++)
    for (int j = 1; j <= 4; j++) rows.insert(table.row(i, j));
  EXPECT_EQ(rows.size(), 16U);
  EXPECT_EQ(*rows.begin(), 0);
  EXPECT_EQ(*rows.rbegin(), 15);
}

TEST(LawTable, IsSymmetric)
{
  LawTable table = filled(3, hertz_none);
  const Numbers other{9.0, 8.0, 7.0, 6.0, 5.0, 0.0};
  set(table, 3, 1, hooke_dashpot, other);
  table.finish();
  for (int row : {table.row(1, 3), table.row(3, 1)}) {
    EXPECT_EQ(table.law(row), hooke_dashpot.law());
    EXPECT_EQ(table.coefficients(row).c[0], 9.0);    // kn
    EXPECT_EQ(table.coefficients() + row, &table.coefficients(row));
  }
  EXPECT_EQ(table.law(table.row(1, 2)), hertz_none.law());
  EXPECT_EQ(table.coefficients(table.row(3, 3)).c[0], 1.0);
}

TEST(LawTable, IsUniformIfNothingDiffers)
{
  LawTable table = filled(3, hertz_multistep);
  table.finish();
  EXPECT_TRUE(table.uniform());
  EXPECT_EQ(table.num_laws(), 1);

  LawTable one_type = filled(1, hooke_dashpot);
  one_type.finish();
  EXPECT_TRUE(one_type.uniform());
}

TEST(LawTable, IsNotUniformIfOneNumberDiffers)
{
  for (int member = 0; member < 6; member++) {
    Numbers changed = basic;
    double *const members[] = {&changed.kn, &changed.gn, &changed.kt,
                               &changed.gt, &changed.mu, &changed.force_floor};
    *members[member] += 1.0;
    LawTable table = filled(3, hertz_multistep);
    set(table, 2, 3, hertz_multistep, changed);
    table.finish();
    EXPECT_FALSE(table.uniform()) << member;
    EXPECT_EQ(table.num_laws(), 1);
  }
}

TEST(LawTable, IsNotUniformIfOnlyTheLawDiffers)
{
  LawTable table = filled(2, hertz_multistep);
  set(table, 2, 2, hertz_none, basic);
  table.finish();
  EXPECT_FALSE(table.uniform());
  EXPECT_EQ(table.num_laws(), 2);
}

TEST(LawTable, NumbersTheLawsThatOccur)
{
  LawTable table = filled(3, hertz_none);
  set(table, 1, 2, hooke_dashpot, basic);
  set(table, 3, 3, hertz_multistep, basic);
  table.finish();
  EXPECT_EQ(table.num_laws(), 3);
  std::set<int> seen;
  for (int i = 1; i <= 3; i++)
    for (int j = 1; j <= 3; j++) {
      const int row = table.row(i, j), index = table.law_index(row);
      ASSERT_LT(index, table.num_laws());
      EXPECT_EQ(table.distinct_law(index), table.law(row));
      for (bool advance : {false, true})
        EXPECT_TRUE(table.kernel(index, advance) == contact_kernel(table.law(row), false, advance));
      seen.insert(index);
    }
  EXPECT_EQ(seen.size(), 3U);
}

TEST(LawTable, PicksTheUniformKernelForAUniformScene)
{
  LawTable table = filled(2, hooke_dashpot);
  table.finish();
  EXPECT_TRUE(table.kernel(0, true) == contact_kernel(hooke_dashpot, true, true));
  EXPECT_TRUE(table.kernel(0, false) == contact_kernel(hooke_dashpot, true, false));
}

TEST(LawTable, KnowsWhatTheSceneNeeds)
{
  struct Need {
    NamedLaw law;
    bool friction, history;
  };
  for (const Need &need : {Need{hertz_none, false, false}, Need{hooke_dashpot, true, false},
                           Need{hertz_multistep, true, true}}) {
    LawTable table = filled(3, hertz_none);
    set(table, 1, 3, need.law, basic);    // one pair of types is enough
    table.finish();
    EXPECT_EQ(table.has_friction(), need.friction);
    EXPECT_EQ(table.has_history(), need.history);
  }
}

TEST(LawTable, StartsAnewAfterReset)
{
  LawTable table = filled(3, hertz_multistep);
  set(table, 1, 1, hooke_dashpot, basic);
  table.finish();
  table.reset(2);
  for (int i = 1; i <= 2; i++)
    for (int j = i; j <= 2; j++) set(table, i, j, hertz_none, basic);
  table.finish();
  EXPECT_EQ(table.num_laws(), 1);
  EXPECT_TRUE(table.uniform());
  EXPECT_FALSE(table.has_history());
}

}    // namespace
