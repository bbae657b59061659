// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Proxies by reach, on all ranks of a grid in one process: every pair that may touch across a face
// has its proxies on both sides, and no sphere is one where nothing can touch it and its shell ends.

#include "neighbors/proxy_reach.h"

#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace Talus;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Place = std::array<int, 3>;

struct Sphere {
  std::array<double, 3> x;
  double radius;
};

/// A box from 0 to `edge`, divided among ranks; the spheres of each.
struct Ranks {
  std::array<double, 3> edge;
  std::array<bool, 3> periodic;
  Place grid, around;    ///< domains along each edge; how many to either side are looked at
  double skin, unit;
  std::vector<std::vector<Sphere>> owned;

  int number() const { return grid[0] * grid[1] * grid[2]; }
  Place place(int rank) const
  {
    return {rank % grid[0], rank / grid[0] % grid[1], rank / (grid[0] * grid[1])};
  }
  int rank(const Place &at) const { return (at[2] * grid[1] + at[1]) * grid[0] + at[0]; }
  double width(int d) const { return edge[d] / grid[d]; }
};

void scatter(Ranks &ranks, int count, double smallest, double largest, RandomSource &random)
{
  ranks.owned.assign(ranks.number(), {});
  for (int n = 0; n < count; n++) {
    Sphere sphere{};
    Place at{};
    for (int d = 0; d < 3; d++) {
      sphere.x[d] = random.uniform(0.0, ranks.edge[d]);
      at[d] = std::min(static_cast<int>(sphere.x[d] / ranks.width(d)), ranks.grid[d] - 1);
    }
    sphere.radius = std::min(largest, smallest / std::cbrt(random.uniform(1.0e-9, 1.0)));
    ranks.owned[ranks.rank(at)].push_back(sphere);
  }
}

/// Of a step from one place to another: where it ends, and the periods; false: beyond the box.
bool wrap(const Ranks &ranks, const Place &from, const Place &step, Place &to, Place &periods)
{
  for (int d = 0; d < 3; d++) {
    const int n = ranks.grid[d], index = from[d] + step[d];
    to[d] = (index % n + n) % n;
    periods[d] = (index - to[d]) / n;
    if (periods[d] != 0 && !ranks.periodic[d]) return false;
  }
  return true;
}

DomainGrid grid_around(const Ranks &ranks, int rank)
{
  DomainGrid grid;
  const Place at = ranks.place(rank);
  for (int d = 0; d < 3; d++)
    for (int step = -ranks.around[d]; step <= ranks.around[d]; step++) {
      const int index = at[d] + step;
      const bool inside = index >= 0 && index < ranks.grid[d];
      DomainGrid::Edge edge{index * ranks.width(d), (index + 1) * ranks.width(d),
                            inside || ranks.periodic[d]};
      if (!ranks.periodic[d] && index == 0) edge.low = -infinity;
      if (!ranks.periodic[d] && index == ranks.grid[d] - 1) edge.high = infinity;
      grid.along[d].push_back(edge);
    }
  return grid;
}

Place step_to(const Ranks &ranks, int domain)
{
  Place step{};
  for (int d = 0; d < 3; d++) {
    const int edges = 2 * ranks.around[d] + 1;
    step[d] = domain % edges - ranks.around[d];
    domain /= edges;
  }
  return step;
}

struct Proxy {
  int owner, index;
  Place periods;    ///< by which it is shifted
  Sphere sphere;

  bool operator<(const Proxy &other) const
  {
    return std::tie(owner, index, periods) < std::tie(other.owner, other.index, other.periods);
  }
};

/// What messages would bring, and in what order.
class Exchange {
 public:
  explicit Exchange(const Ranks &all) : ranks(all), proxies(all.number())
  {
    ProxyReach::ClassRadii classes;
    classes.fill(-1.0);
    for (int r = 0; r < ranks.number(); r++) {
      const auto of_rank = ProxyReach::classes_of(count(r), radii(r).data(), ranks.unit);
      for (int c = 0; c < ProxyReach::num_classes; c++)
        classes[c] = std::max(classes[c], of_rank[c]);
    }
    for (int r = 0; r < ranks.number(); r++)
      reach.emplace_back(grid_around(ranks, r), classes, ranks.unit, ranks.skin);
    std::vector<ProxyReach::Lists> shells(ranks.number()), beyond(ranks.number());
    for (int r = 0; r < ranks.number(); r++)
      shells[r] = reach[r].in_shells(count(r), places(r).data(), radii(r).data());
    std::vector<std::vector<ProxyReach::Proxies>> from(ranks.number());
    for (int r = 0; r < ranks.number(); r++) from[r] = receive(r, shells);
    for (int r = 0; r < ranks.number(); r++)
      beyond[r] = reach[r].beyond_shells(count(r), places(r).data(), radii(r).data(), from[r]);
    for (int r = 0; r < ranks.number(); r++) receive(r, beyond);
  }

  const std::vector<Proxy> &of(int rank) const { return proxies[rank]; }

 private:
  int count(int r) const { return static_cast<int>(ranks.owned[r].size()); }
  std::vector<double> places(int r) const
  {
    std::vector<double> x;
    for (const Sphere &s : ranks.owned[r]) x.insert(x.end(), s.x.begin(), s.x.end());
    for (const Proxy &p : proxies[r]) x.insert(x.end(), p.sphere.x.begin(), p.sphere.x.end());
    return x;
  }
  std::vector<double> radii(int r) const
  {
    std::vector<double> radius;
    for (const Sphere &s : ranks.owned[r]) radius.push_back(s.radius);
    for (const Proxy &p : proxies[r]) radius.push_back(p.sphere.radius);
    return radius;
  }
  std::vector<ProxyReach::Proxies> receive(int r, const std::vector<ProxyReach::Lists> &lists)
  {
    std::vector<ProxyReach::Proxies> found;
    const int domains = static_cast<int>(lists[r].size());
    for (int source = 0; source < domains; source++) {
      Place to{}, periods{};
      const int begin = count(r) + static_cast<int>(proxies[r].size());
      if (wrap(ranks, ranks.place(r), step_to(ranks, source), to, periods)) {
        const int owner = ranks.rank(to);
        for (const int i : lists[owner][domains - 1 - source]) {
          Sphere image = ranks.owned[owner][i];
          for (int d = 0; d < 3; d++) image.x[d] += periods[d] * ranks.edge[d];
          proxies[r].push_back({owner, i, periods, image});
        }
      }
      found.push_back({source, begin, count(r) + static_cast<int>(proxies[r].size())});
    }
    return found;
  }

  const Ranks &ranks;
  std::vector<ProxyReach> reach;
  std::vector<std::vector<Proxy>> proxies;
};

double distance(const Sphere &a, const std::array<double, 3> &b)
{
  return std::hypot(a.x[0] - b[0], a.x[1] - b[1], a.x[2] - b[2]);
}

/// visit(owner, index, periods, image) for all images of all spheres.
template <class Visit> void for_each_image(const Ranks &ranks, Visit visit)
{
  Place from{}, to{};
  for (int d = 0; d < 3; d++) from[d] = to[d] = ranks.periodic[d] ? 1 : 0;
  for (int owner = 0; owner < ranks.number(); owner++)
    for (int i = 0; i < static_cast<int>(ranks.owned[owner].size()); i++)
      for (int a = -from[0]; a <= to[0]; a++)
        for (int b = -from[1]; b <= to[1]; b++)
          for (int c = -from[2]; c <= to[2]; c++) {
            Sphere image = ranks.owned[owner][i];
            const Place periods{a, b, c};
            for (int d = 0; d < 3; d++) image.x[d] += periods[d] * ranks.edge[d];
            visit(owner, i, periods, image);
          }
}

void expect_partners(const Ranks &ranks)
{
  const Exchange exchange(ranks);
  for (int r = 0; r < ranks.number(); r++) {
    std::set<Proxy> there(exchange.of(r).begin(), exchange.of(r).end());
    EXPECT_EQ(there.size(), exchange.of(r).size()) << "a proxy twice";
    for_each_image(ranks, [&](int owner, int i, const Place &periods, const Sphere &image) {
      if (owner == r && periods == Place{}) return;
      const bool needed =
          std::any_of(ranks.owned[r].begin(), ranks.owned[r].end(), [&](const Sphere &own) {
            return distance(own, image.x) < own.radius + image.radius + ranks.skin;
          });
      if (needed) {
        EXPECT_EQ(there.count({owner, i, periods, image}), 1U) << "rank " << r;
      }
    });
  }
}

Ranks ranks_of(const Place &grid, const std::array<bool, 3> &periodic, double edge, double largest,
               double skin)
{
  Ranks ranks{{edge, edge, edge}, periodic, grid, {}, skin, largest, {}};
  for (int d = 0; d < 3; d++) {
    ranks.around[d] = static_cast<int>((2.0 * largest + skin) / ranks.width(d)) + 1;
    if (!periodic[d]) ranks.around[d] = std::min(ranks.around[d], grid[d] - 1);
  }
  return ranks;
}

}    // namespace

TEST(ProxyReach, EveryPairHasItsProxies)
{
  RandomSource random(7);
  const std::array<Place, 5> grids{{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {3, 2, 2}, {4, 1, 3}}};
  for (const Place &grid : grids)
    for (const bool periodic : {true, false})
      for (const double ratio : {1.0, 1.3, 5.0, 30.0}) {
        SCOPED_TRACE(std::to_string(grid[0]) + std::to_string(grid[1]) + std::to_string(grid[2]) +
                     " 1:" + std::to_string(ratio));
        Ranks ranks = ranks_of(grid, {true, periodic, periodic}, 1.0, 0.12, 0.02);
        scatter(ranks, 600, 0.12 / ratio, 0.12, random);
        expect_partners(ranks);
      }
}

/* Two sizes: those beside the face, and those around the large ones there. */

TEST(ProxyReach, SmallOnesOnlyWhereALargeOneIs)
{
  RandomSource random(11);
  Ranks ranks = ranks_of({2, 1, 1}, {false, false, false}, 1.0, 0.1, 0.002);
  scatter(ranks, 20000, 0.004, 0.004, random);
  const Sphere large{{0.55, 0.5, 0.5}, 0.1};
  ranks.owned[1].push_back(large);
  const Exchange exchange(ranks);
  int near = 0, shell = 0;
  for (const Sphere &s : ranks.owned[0]) {
    const bool in_shell = 0.5 - s.x[0] < 0.01;
    shell += in_shell;
    near += !in_shell && distance(large, s.x) < 0.106;
  }
  EXPECT_NEAR(static_cast<double>(exchange.of(1).size()), shell + near, 3.0);
  EXPECT_LT(exchange.of(1).size(), 800U);    // a slab as wide as the large one has 4000
  int of_large = 0;
  for (const Proxy &p : exchange.of(0)) of_large += p.sphere.radius == large.radius;
  EXPECT_EQ(of_large, 1);
}

/* Points are spheres too, and a sphere larger than all that were expected. */

TEST(ProxyReach, AnySize)
{
  RandomSource random(3);
  Ranks ranks = ranks_of({2, 2, 1}, {true, true, true}, 1.0, 0.1, 0.05);
  scatter(ranks, 300, 0.01, 0.1, random);
  ranks.owned[0].push_back({{0.45, 0.2, 0.3}, 0.0});
  ranks.owned[1].push_back({{0.51, 0.2, 0.3}, 0.0});
  expect_partners(ranks);
  ranks.unit = 0.05;
  expect_partners(ranks);
}

TEST(ProxyReach, NoSpheres)
{
  Ranks ranks = ranks_of({2, 1, 1}, {true, false, false}, 1.0, 0.1, 0.05);
  ranks.owned.assign(2, {});
  EXPECT_TRUE(Exchange(ranks).of(0).empty());
}
