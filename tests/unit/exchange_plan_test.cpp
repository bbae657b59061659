// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The plan of the direct exchange, for several ranks in one process: what the owners would send is
// followed to the proxies.

#include "exchange/exchange_plan.h"

#include "random_source.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <vector>

using namespace Talus;

namespace {

int integer(RandomSource &random, int low, int high)
{
  return low + random.below(high - low + 1);
}

using Ranks = std::vector<ExchangePlan>;
using Origins = std::vector<std::vector<ProxyOrigin>>;    // by rank

/// All requests delivered, in an order that no rank may depend on.
Ranks negotiate(const std::vector<int> &owned, const Origins &origins)
{
  const int n = static_cast<int>(owned.size());
  Ranks ranks(n);
  for (int r = 0; r < n; r++) ranks[r].build(r, owned[r], origins[r]);
  for (int to = n - 1; to >= 0; to--)
    for (int from = 0; from < n; from++)
      if (from != to) ranks[to].accept_request(from, ranks[from].request_for(to));
  return ranks;
}

/// Identity of each proxy as it arrives: {owner, index, shift}.
using Arrival = std::vector<int>;

void deliver(const ExchangeNeighbor &send, const ExchangeNeighbor &receive, int owner,
             int first_proxy, std::vector<Arrival> &arrivals)
{
  ASSERT_EQ(send.send_count(), receive.receive_count());
  const int *place = receive.receive_place.data();
  for (const ProxyRun &run : receive.receive)
    for (int k = 0; k < run.count; k++) {
      Arrival &arrival = arrivals.at(run.first + k - first_proxy);
      ASSERT_TRUE(arrival.empty());
      arrival = {owner, send.send_index.at(*place++), run.shift[0], run.shift[1], run.shift[2]};
    }
  ASSERT_EQ(place, receive.receive_place.data() + receive.receive_place.size());
}

void expect_each_sent_once(const ExchangeNeighbor &to)
{
  const std::set<int> different(to.send_index.begin(), to.send_index.end());
  EXPECT_EQ(different.size(), to.send_index.size());
}

const ExchangeNeighbor *find(const ExchangePlan &plan, int rank)
{
  for (const ExchangeNeighbor &n : plan.neighbors())
    if (n.rank == rank) return &n;
  return nullptr;
}

void expect_every_proxy_from_its_owner(const Ranks &ranks, const std::vector<int> &owned,
                                       const Origins &origins)
{
  for (int r = 0; r < static_cast<int>(ranks.size()); r++) {
    std::vector<Arrival> arrivals(origins[r].size());
    deliver(ranks[r].self(), ranks[r].self(), r, owned[r], arrivals);
    for (const ExchangeNeighbor &n : ranks[r].neighbors()) {
      expect_each_sent_once(n);
      if (!n.receive_count()) continue;
      const ExchangeNeighbor *sender = find(ranks[n.rank], r);
      ASSERT_NE(sender, nullptr);
      deliver(*sender, n, n.rank, owned[r], arrivals);
    }
    for (std::size_t k = 0; k < arrivals.size(); k++) {
      const ProxyOrigin &o = origins[r][k];
      EXPECT_EQ(arrivals[k], (Arrival{o.owner, o.index, o.shift[0], o.shift[1], o.shift[2]}))
          << "rank " << r << ", proxy " << k;
    }
  }
}

}    // namespace

TEST(ExchangePlan, RunsJoinWhatFollowsWithOneOwnerAndShift)
{
  const PeriodicShift none{0, 0, 0}, left{-1, 0, 0};
  ExchangePlan plan;
  plan.build(0, 10, {{1, 4, none}, {1, 2, none}, {1, 2, left}, {2, 0, none}, {1, 7, none}});
  ASSERT_EQ(plan.neighbors().size(), 2u);
  const ExchangeNeighbor &one = plan.neighbors()[0];
  EXPECT_EQ(one.rank, 1);
  ASSERT_EQ(one.receive.size(), 3u);
  EXPECT_EQ(one.receive[0].first, 10);
  EXPECT_EQ(one.receive[0].count, 2);
  EXPECT_FALSE(one.receive[0].shifted());
  EXPECT_EQ(one.receive[1].first, 12);
  EXPECT_TRUE(one.receive[1].shifted());
  EXPECT_EQ(one.receive[2].first, 14);
  EXPECT_EQ(plan.request_for(1), (std::vector<int>{2, 4, 7}));    // an image is not sent again
  EXPECT_EQ(one.receive_place, (std::vector<int>{1, 0, 0, 2}));
  EXPECT_TRUE(plan.request_for(5).empty());
}

TEST(ExchangePlan, NeighborsAboveUsComeFirst)
{
  const PeriodicShift none{0, 0, 0};
  ExchangePlan plan;
  plan.build(3, 1, {{0, 0, none}, {5, 0, none}, {1, 0, none}, {4, 0, none}});
  std::vector<int> order;
  for (const ExchangeNeighbor &n : plan.neighbors()) order.push_back(n.rank);
  EXPECT_EQ(order, (std::vector<int>{4, 5, 0, 1}));
}

TEST(ExchangePlan, ImagesOfOurOwnParticlesNeedNoRequest)
{
  ExchangePlan plan;
  plan.build(0, 3, {{0, 2, {1, 0, 0}}, {0, 1, {1, 0, 0}}, {0, 1, {0, 0, -2}}});
  EXPECT_TRUE(plan.neighbors().empty());
  EXPECT_EQ(plan.self().send_index, (std::vector<int>{1, 2}));
  EXPECT_EQ(plan.self().receive_place, (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(plan.num_interior(), 1);
  EXPECT_EQ(plan.num_proxies(), 3);
}

TEST(ExchangePlan, OneWayNeighbors)
{
  const Origins origins{{{1, 0, {0, 0, 0}}}, {}};
  const std::vector<int> owned{2, 3};
  const Ranks ranks = negotiate(owned, origins);
  EXPECT_EQ(ranks[1].neighbors().at(0).send_count(), 1);
  EXPECT_EQ(ranks[1].neighbors().at(0).receive_count(), 0);
  EXPECT_EQ(ranks[0].neighbors().at(0).send_count(), 0);
  EXPECT_EQ(ranks[1].num_interior(), 2);
  EXPECT_EQ(ranks[0].num_interior(), 2);
  expect_every_proxy_from_its_owner(ranks, owned, origins);
}

TEST(ExchangePlan, AnyOriginsOnAnyNumberOfRanks)
{
  RandomSource random(5);
  for (const int n : {1, 2, 4, 8, 27}) {
    std::vector<int> owned(n);
    for (int &count : owned) count = integer(random, 0, 20);
    owned[0] = 7;
    Origins origins(n);
    for (int r = 0; r < n; r++)
      for (int k = integer(random, 0, 200); k > 0; k--) {
        const int owner = integer(random, 0, n - 1);
        if (!owned[owner]) continue;
        ProxyOrigin o{owner, integer(random, 0, owned[owner] - 1), {0, 0, 0}};
        for (int &s : o.shift) s = integer(random, -1, 1);
        for (int again = integer(random, 1, 3); again > 0; again--) origins[r].push_back(o);
      }
    expect_every_proxy_from_its_owner(negotiate(owned, origins), owned, origins);
  }
}

TEST(ExchangePlan, BuildForgetsThePlanBefore)
{
  ExchangePlan plan;
  plan.build(0, 4, {{1, 0, {0, 0, 0}}});
  plan.accept_request(2, {3});
  plan.build(0, 5, {});
  EXPECT_TRUE(plan.neighbors().empty());
  EXPECT_EQ(plan.num_owned(), 5);
  EXPECT_EQ(plan.num_interior(), 5);
}

TEST(ExchangePlan, WrongRequestsAreRejected)
{
  ExchangePlan plan;
  plan.build(0, 4, {});
  const std::vector<std::vector<int>> wrong{{4},    // not ours: a proxy
                                            {-1},
                                            {1, 2, 4},
                                            {1, 1},    // twice
                                            {2, 1}};
  for (const auto &message : wrong)
    EXPECT_THROW(plan.accept_request(1, message), std::invalid_argument);
  EXPECT_NO_THROW(plan.accept_request(1, {1, 3}));
}
