// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Counts of pairs and of bytes near and above 2^31 on one rank. Limits are checked on the counts
// alone; arrays are above 2^31 bytes (4 GB in all) if TALUS_LARGE_TESTS is set in the environment.

#include "base/aligned_vector.h"
#include "contact/narrow_phase.h"
#include "exchange/exchange_plan.h"
#include "history/contact_history.h"
#include "history/history_store.h"
#include "neighbors/pair_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

using namespace Talus;

namespace {

constexpr std::int64_t two31 = std::int64_t{1} << 31, two32 = std::int64_t{1} << 32;

// what counts or numbers pairs, blocks of pairs and entries is 64 bits wide
static_assert(std::is_same<decltype(std::declval<PairList>().num_pairs()), std::int64_t>::value,
              "");
static_assert(std::is_same<decltype(std::declval<PairList>().find(0, 0)), std::int64_t>::value, "");
static_assert(
    std::is_same<decltype(find_contacts(std::declval<PairList>(), 0, 0, nullptr, nullptr, nullptr)),
                 std::int64_t>::value,
    "");
static_assert(
    std::is_invocable<decltype(&ContactHistory::touches), ContactHistory, std::int64_t>::value, "");

TEST(IndexArithmetic, PairsAreCountedUpTo32Bits)
{
  for (const std::int64_t n : {std::int64_t{0}, two31 - 1, two31, two31 + 1, two32 - 9})
    EXPECT_NO_THROW(PairList::require_countable(n)) << n;
  for (const std::int64_t n : {two32 - 8, two32, 3 * two32})
    EXPECT_THROW(PairList::require_countable(n), std::length_error) << n;
}

TEST(IndexArithmetic, ParticlesAreCountedUpTo31Bits)
{
  EXPECT_NO_THROW(ParticleOrder::require_countable(two31 - 100));
  for (const std::int64_t n : {two31 - 1, two31, two32 + 5})
    EXPECT_THROW(ParticleOrder::require_countable(n), std::length_error) << n;
}

TEST(IndexArithmetic, MessagesHaveUpTo31BitsOfNumbers)
{
  const std::int64_t most = std::numeric_limits<int>::max();
  EXPECT_EQ(message_length(9, 1000), 9000);
  EXPECT_EQ(message_length(1, most), most);
  EXPECT_EQ(message_length(9, most / 9), most / 9 * 9);
  EXPECT_THROW(message_length(9, most / 9 + 1), std::length_error);
  EXPECT_THROW(message_length(1, two31), std::length_error);
  EXPECT_THROW(message_length(9, two31), std::length_error);
  EXPECT_EQ(message_length(0, two32), 0);
}

TEST(IndexArithmetic, RequestsForParticlesBeyondTheLastAreRejected)
{
  ExchangePlan plan;
  plan.build(0, 10, {});
  const int last = std::numeric_limits<int>::max();
  EXPECT_THROW(plan.accept_request(1, {3, last}), std::invalid_argument);
  EXPECT_THROW(plan.accept_request(1, {-last - 1, 3}), std::invalid_argument);
  EXPECT_NO_THROW(plan.accept_request(1, {3, 4}));
}

TEST(IndexArithmetic, BigMemoryAbove2GBytesIsReachable)
{
  const std::size_t bytes = std::size_t{5}
                            << 30;    // only the pages that are written become resident
  auto *memory = static_cast<unsigned char *>(allocate_aligned(bytes));
  const std::size_t places[] = {0, std::size_t{1} << 31, std::size_t{1} << 32, bytes - 1};
  for (std::size_t k = 0; k < 4; k++) memory[places[k]] = static_cast<unsigned char>(k + 1);
  for (std::size_t k = 0; k < 4; k++) EXPECT_EQ(memory[places[k]], k + 1);
  release_aligned(memory, bytes);
}

/// Every pair of n particles is a candidate. All touch, and then the last few particles only.
TEST(IndexArithmetic, HistoriesAbove2GBytes)
{
  const bool large = std::getenv("TALUS_LARGE_TESTS");
  const int n = large ? 12000 : 1200, close = 5;    // 7.2e7 pairs, 2.3 GB of records
  std::vector<int> particle(n), size(n);
  std::vector<const int *> entries(n);
  std::iota(particle.begin(), particle.end(), 0);
  for (int i = 0; i < n; i++) {
    size[i] = n - 1 - i;
    entries[i] = particle.data() + i + 1;
  }
  const NeighborView view{n,  particle.data(),     size.data(), entries.data(), ~0,
                          30, {1.0, 0.0, 0.0, 0.0}};
  std::vector<std::int64_t> tag(n);
  std::iota(tag.begin(), tag.end(), 1);
  ParticleOrder order;
  order.arrange(n, std::vector<std::uint64_t>(n, 0), tag);
  const WorkPartition work(order);

  PairList pairs;
  pairs.collect(order, work, PairRows(order, view), 0);
  ASSERT_EQ(pairs.num_pairs(), std::int64_t{n} * (n - 1) / 2);
  EXPECT_EQ(pairs.find(n - 2, n - 1), pairs.num_pairs() - 1);

  HistoryStore store;
  store.keep(1);
  store.resize(n);
  store.number(order);
  ContactHistory history;
  history.fetch(pairs, store);
  AlignedVector<Record> position(n);
  for (int i = 0; i < n; i++) position[i] = {{1.0e-5 * i, 0.0, 0.0, 0.5}};
  const std::int64_t end = pairs.num_pairs();
  AlignedVector<std::uint32_t> contacts;
  renew(contacts, end + 8);
  ASSERT_EQ(find_contacts(pairs, 0, end, position.data(), &history, contacts.data()), end);
  const std::int64_t last = reinterpret_cast<const char *>(&history.record(end - 1)) -
                            reinterpret_cast<const char *>(history.all_records());
  ASSERT_EQ(last, (end - 1) * static_cast<std::int64_t>(sizeof(Record)));
  ASSERT_EQ(large, last > two31);

  // all but a few separate
  for (int i = 0; i < n; i++)
    position[i] = {{i < n - close ? 10.0 * i : 10.0 * n + 0.01 * i, 0.0, 0.0, 0.5}};
  const std::int64_t touching =
      find_contacts(pairs, 0, end, position.data(), &history, contacts.data());
  ASSERT_EQ(touching, close * (close - 1) / 2);
  EXPECT_EQ(contacts[touching - 1], end - 1);

  history.record(end - 1) = {{1.0, 2.0, 3.0, 1.0}};
  store.begin(work, {true, false});
  history.put_aside(pairs, store.chunk(0), false);
  store.finish(order, 1);
  EXPECT_EQ(store.list_size(n - 1), 1 + (close - 1) * (3 + 4));
  store.open(order, 1);
  history.fetch(pairs, store);
  EXPECT_EQ(history.record(end - 1).c[1], 2.0);
  EXPECT_TRUE(history.touches(end - 1));
}

}    // namespace
