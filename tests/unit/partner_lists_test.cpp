// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/partner_lists.h"
#include "particles/record.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace Talus;

namespace {

constexpr int entry_size = 1 + 4;    // doubles: the tag and four values

struct Entry {
  std::int64_t tag;
  Record history;
};
using Model = std::vector<std::vector<Entry>>;    // what the lists should hold, by particle

Record random_history(RandomSource &random)
{
  return {{random.uniform(-1.0, 1.0), random.decade(-300.0, 300.0), -random.decade(-9.0, 0.0),
           random.chance(0.5) ? 1.0 : 0.0}};
}

/// Particles with 0 to 12 partners; every bit of a tag must survive.
Model random_model(int n, RandomSource &random)
{
  Model model(n);
  for (auto &entries : model)
    for (int k = random.below(13); k > 0; k--)
      entries.push_back({static_cast<std::int64_t>(random.bits() >> 1), random_history(random)});
  return model;
}

/// Entries of different particles arrive in any order.
void fill(PartnerLists &lists, const Model &model, RandomSource &random)
{
  std::vector<std::pair<int, Entry>> all;
  for (std::size_t a = 0; a < model.size(); a++)
    for (const Entry &e : model[a]) all.emplace_back(a, e);
  random.shuffle(all);
  lists.begin();
  for (const auto &item : all) lists.count(item.first);
  lists.layout();
  for (const auto &[atom, entry] : all)
    std::copy_n(entry.history.c, 4, lists.append(atom, entry.tag));
}

void expect_holds(const PartnerLists &lists, int atom, const std::vector<Entry> &entries)
{
  ASSERT_EQ(lists.size(atom), static_cast<int>(entries.size()));
  for (const Entry &e : entries) {
    const double *values = lists.find(atom, e.tag);
    ASSERT_NE(values, nullptr);
    ASSERT_TRUE(std::equal(values, values + 4, e.history.c));
  }
  EXPECT_EQ(lists.find(atom, -1), nullptr);
}

TEST(PartnerLists, HoldWhatWasFiledAndCanBeRefilled)
{
  RandomSource random(1);
  PartnerLists lists;
  for (int n : {5, 0, 200, 30}) {
    lists.resize(n);
    for (int round = 0; round < 3; round++) {
      const Model model = random_model(n, random);
      fill(lists, model, random);
      for (int a = 0; a < n; a++) expect_holds(lists, a, model[a]);
    }
  }
}

TEST(PartnerLists, NewParticlesHaveNoPartners)
{
  RandomSource random(2);
  PartnerLists lists;
  lists.resize(3);
  const Model model = random_model(3, random);
  fill(lists, model, random);
  lists.resize(6);
  for (int a = 0; a < 3; a++) expect_holds(lists, a, model[a]);
  for (int a = 3; a < 6; a++) expect_holds(lists, a, {});
}

TEST(PartnerLists, SurvivePackingAndUnpacking)
{
  RandomSource random(3);
  constexpr int n = 60;
  const Model model = random_model(n, random);
  PartnerLists from, to;
  from.resize(n);
  to.resize(n);
  fill(from, model, random);
  fill(to, random_model(n, random), random);    // replaced by what is unpacked

  std::vector<double> buffer(n * (1 + 13 * entry_size), -1.0);
  int written = 0, read = 0;
  for (int a = 0; a < n; a++) {
    const int size = from.pack(a, &buffer[written]);
    EXPECT_EQ(size, 1 + entry_size * from.size(a));
    EXPECT_EQ(size, from.packed_size(a));
    written += size;
    EXPECT_EQ(buffer[written], -1.0);    // nothing beyond the announced length
  }
  for (int a = n - 1; a >= 0; a--) {    // in the order of the buffer, into other particles
    read += to.unpack(a, &buffer[read]);
    expect_holds(to, a, model[n - 1 - a]);
  }
  EXPECT_EQ(read, written);
  for (int a = 0; a < n; a++) expect_holds(to, a, model[n - 1 - a]);
}

TEST(PartnerLists, PackEveryBitOfATag)
{
  const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  const std::int64_t signalling_nan = 0x7ff0000000000001;    // as the bits of a double
  RandomSource random(4);
  for (std::int64_t tag : {std::int64_t{1}, (std::int64_t{1} << 53) + 1, signalling_nan, largest}) {
    PartnerLists lists;
    lists.resize(2);
    fill(lists, {{{tag, {{1.0, 2.0, 3.0, 1.0}}}}, {}}, random);
    double buffer[1 + entry_size];
    lists.pack(0, buffer);
    lists.unpack(1, buffer);
    expect_holds(lists, 1, {{tag, {{1.0, 2.0, 3.0, 1.0}}}});
  }
}

TEST(PartnerLists, ChangeOfValuesKeepsWhatIsFiled)
{
  RandomSource random(6);
  const Model model = random_model(30, random);
  PartnerLists lists;
  lists.resize(30);
  fill(lists, model, random);
  lists.set_values(8);
  for (int a = 0; a < 30; a++) {
    expect_holds(lists, a, model[a]);
    for (const Entry &e : model[a])
      for (int k = 4; k < 8; k++) EXPECT_EQ(lists.find(a, e.tag)[k], 0.0);
    EXPECT_EQ(lists.packed_size(a), 1 + 9 * lists.size(a));
  }
  lists.set_values(4);
  for (int a = 0; a < 30; a++) expect_holds(lists, a, model[a]);
}

// What the host does when particles leave: the last one takes the place of the one that left.
TEST(PartnerLists, CopyAndClear)
{
  RandomSource random(5);
  constexpr int n = 20;
  Model model = random_model(n, random);
  PartnerLists lists;
  lists.resize(n);
  fill(lists, model, random);
  for (int step = 0; step < 200; step++) {
    const int from = random.below(n), to = random.below(n);
    if (random.chance(0.1)) {
      lists.clear(to);
      model[to].clear();
    } else {
      lists.copy(from, to);
      model[to] = std::vector<Entry>(model[from]);
    }
    for (int a = 0; a < n; a++) expect_holds(lists, a, model[a]);
  }
  const Model again = random_model(n, random);
  fill(lists, again, random);
  for (int a = 0; a < n; a++) expect_holds(lists, a, again[a]);
  lists.begin();
  for (int a = 0; a < n; a++) expect_holds(lists, a, {});
  fill(lists, again, random);
  for (int a = 0; a < n; a++) expect_holds(lists, a, again[a]);
  EXPECT_GT(lists.memory_usage(), 0.0);
}

}    // namespace
