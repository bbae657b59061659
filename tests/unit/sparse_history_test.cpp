// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Histories of the candidates of a body, on their way with the particles.

#include "body/contact/sparse_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace Talus;

namespace {

class SparseHistoryTest : public testing::TestWithParam<bool> {
 protected:
  SparseHistoryTest()
  {
    history.keep_impacts(GetParam());
    history.grow(20);
    history.follow({3, 17, 5, 11});
    for (int c = 0; c < 4; c++) set(c, 10.0 * (c + 1));
  }

  void set(int candidate, double value)
  {
    history.record(candidate) = {{value, value + 1.0, value + 2.0, 1.0}};
    if (GetParam()) history.impact(candidate) = {{value + 3.0, value + 4.0, 1.0, 0.0}};
  }

  std::vector<double> packed(int particle) const
  {
    std::vector<double> values(history.size_packed(), 7.0);
    EXPECT_EQ(history.pack(particle, values.data()), history.size_packed());
    return values;
  }

  std::vector<double> expected(double value) const
  {
    std::vector<double> values{value, value + 1.0, value + 2.0, 1.0};
    if (value == 0.0) values.assign(4, 0.0);
    const std::vector<double> more = value == 0.0
                                         ? std::vector<double>(4, 0.0)
                                         : std::vector<double>{value + 3.0, value + 4.0, 1.0, 0.0};
    if (GetParam()) values.insert(values.end(), more.begin(), more.end());
    return values;
  }

  SparseHistory history;
};

TEST_P(SparseHistoryTest, ParticlesKnowTheirRecords)
{
  EXPECT_EQ(history.size_packed(), GetParam() ? 8 : 4);
  const double value[20] = {0, 0, 0, 10, 0, 30, 0, 0, 0, 0, 0, 40, 0, 0, 0, 0, 0, 20};
  for (int i = 0; i < 20; i++) {
    EXPECT_EQ(packed(i), expected(value[i])) << i;
    EXPECT_EQ(history.of_particle(i).c[0], value[i]);
  }
}

TEST_P(SparseHistoryTest, FollowKeepsThoseThatStayAndForgetsTheOthers)
{
  history.follow({11, 4, 3});
  EXPECT_EQ(history.record(0).c[0], 40.0);
  EXPECT_EQ(history.record(1).c[0], 0.0);
  EXPECT_EQ(history.record(2).c[0], 10.0);
  EXPECT_EQ(packed(17), expected(0.0));
  history.follow({});
  history.follow({3, 11});
  EXPECT_EQ(packed(3), expected(0.0));
}

// The last particle takes the place of one that leaves, and new ones come in behind.
TEST_P(SparseHistoryTest, MovesWithItsParticles)
{
  const std::vector<double> of_5 = packed(5), of_0 = packed(0);
  history.copy(17, 5);
  history.forget(17);
  history.grow(40);
  EXPECT_EQ(history.unpack(30, of_5.data()), history.size_packed());
  EXPECT_EQ(history.unpack(31, of_0.data()), history.size_packed());
  EXPECT_EQ(history.unpack(11, of_0.data()), history.size_packed());    // replaces what was there
  const auto check = [this] {
    EXPECT_EQ(packed(5), expected(20.0));
    EXPECT_EQ(packed(17), expected(0.0));
    EXPECT_EQ(packed(30), expected(30.0));
    EXPECT_EQ(packed(31), expected(0.0));
    EXPECT_EQ(packed(11), expected(0.0));
    EXPECT_EQ(packed(3), expected(10.0));
  };
  check();
  history.follow({30, 31, 3, 5, 11});
  check();
}

// The sign of a zero is kept as well, or bits would depend on who owns a particle.
TEST_P(SparseHistoryTest, NegativeZerosTravel)
{
  std::vector<double> values(history.size_packed(), 0.0);
  values[1] = -0.0;
  history.unpack(9, values.data());
  EXPECT_TRUE(std::signbit(packed(9)[1]));
  EXPECT_FALSE(std::signbit(packed(9)[0]));
}

TEST_P(SparseHistoryTest, SeparatedContactsAreForgotten)
{
  history.set_touching(0, 0xfU, 0xdU);    // the second has gone
  EXPECT_EQ(packed(17), expected(0.0));
  EXPECT_EQ(packed(3), expected(10.0));
  history.set_touching(0, 0x3U, 0x1U);    // the others are not asked for
  EXPECT_EQ(packed(5), expected(30.0));
  EXPECT_EQ(packed(11), expected(40.0));
  EXPECT_EQ(history.touched(0) & 0xfU, 0xdU);
  history.set_touching(0, 0xfU, 0x2U);
  set(1, 50.0);
  EXPECT_EQ(packed(17), expected(50.0));
  for (const int i : {3, 5, 11}) EXPECT_EQ(packed(i), expected(0.0));
  EXPECT_EQ(history.touched(1), 0U);    // there are no such candidates
}

TEST_P(SparseHistoryTest, MemoryIsThatOfTheCandidates)
{
  const double few = history.memory_usage();
  history.grow(100000);
  history.follow({3, 17, 5, 11});
  EXPECT_LE(history.memory_usage(), few + 4.0 * 200000);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutOnset, SparseHistoryTest, testing::Bool());

}    // namespace
