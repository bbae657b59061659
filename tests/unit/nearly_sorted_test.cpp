// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/nearly_sorted.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

using namespace Talus;

namespace {

void expect_sorted(std::vector<int> values)
{
  std::vector<int> expected = values;
  std::sort(expected.begin(), expected.end());
  sort_nearly_sorted(values, std::less<>());
  EXPECT_EQ(values, expected);
}

TEST(MergeRuns, ListsBehindEachOther)
{
  RandomSource random(22);
  for (const int lists : {1, 2, 3, 4, 7, 26}) {
    std::vector<int> values;
    for (int list = 0; list < lists; list++) {
      std::vector<int> one(random.below(200));
      for (int &value : one) value = random.below(300);
      std::sort(one.begin(), one.end());
      values.insert(values.end(), one.begin(), one.end());
    }
    std::vector<int> expected = values;
    std::sort(expected.begin(), expected.end());
    expect_sorted(values);
    std::vector<int> merged = values;
    merge_runs(merged, std::less<>());
    EXPECT_EQ(merged, expected);

    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    sort_and_unite(values);
    EXPECT_EQ(values, expected);
  }
}

TEST(NearlySorted, SortsAnyOrder)
{
  RandomSource random(21);
  for (const int n : {0, 1, 2, 3, 10, 1000}) {
    std::vector<int> ascending(n);
    std::iota(ascending.begin(), ascending.end(), 0);
    expect_sorted(ascending);
    expect_sorted({ascending.rbegin(), ascending.rend()});
    std::vector<int> any = ascending;
    random.shuffle(any);
    expect_sorted(any);
    for (int &value : any) value = random.below(5);    // many alike
    expect_sorted(any);
  }
}

/// As where a few particles have come and gone: some stand too early, some too late.
TEST(NearlySorted, SortsWhatIsOutOfPlace)
{
  RandomSource random(22);
  for (int trial = 0; trial < 50; trial++) {
    std::vector<int> values(200);
    std::iota(values.begin(), values.end(), 0);
    for (int k = 0; k < 5; k++) std::swap(values[random.below(200)], values[random.below(200)]);
    expect_sorted(values);
  }
}

/// Comparisons say whether it pays: sorting all takes n log2 n of them.
TEST(NearlySorted, ComparesHardlyMoreThanOnceIfFewAreOutOfPlace)
{
  constexpr int n = 10000;
  std::vector<int> values(n);
  std::iota(values.begin(), values.end(), 0);
  std::swap(values[17], values[n - 3]);
  std::rotate(values.begin() + 500, values.begin() + 501, values.begin() + 700);
  int compared = 0;
  sort_nearly_sorted(values, [&](int a, int b) {
    compared++;
    return a < b;
  });
  EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  EXPECT_LT(compared, 3 * n);
}

}    // namespace
