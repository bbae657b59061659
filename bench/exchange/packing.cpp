// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What it costs to pack and unpack a proxy, without MPI: a cube of spheres on a lattice with
// neighbor ranks on all 26 sides, records in canonical order. Times are stated per proxy (items of
// Google Benchmark). Between two exchanges the caches are filled with something else, as a step of
// that many spheres does.

#include "exchange/record_packer.h"
#include "particles/canonical_key.h"
#include "particles/particle_records.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

using namespace Talus;

namespace {

constexpr double spacing = 0.9;    // of the lattice, in diameters: as dense as a settled bed
constexpr int rim = 1;             // layers of proxies

/// A site of the lattice; its owner is the cube in direction `side`, each entry -1, 0 or 1.
struct Site {
  std::array<int, 3> place, side;
  std::uint64_t key;

  bool is_owned() const { return side == std::array<int, 3>{}; }
};

int rank_towards(const std::array<int, 3> &side)
{
  return 9 * (side[0] + 1) + 3 * (side[1] + 1) + side[2] + 1;
}

/// One rank of many that are all alike: what a neighbor wants of it, it wants of the neighbor on
/// the other side.
class Cube {
 public:
  explicit Cube(int spheres, bool friction) : across(static_cast<int>(std::cbrt(spheres)))
  {
    make_sites();
    make_plan();
    records.resize(sites.size(), friction, false);
    for (Record &record : records.position) record = {{1.0, 2.0, 3.0, 0.5}};
    for (Record &record : records.motion) record = {{0.1, 0.2, 0.3, 2.0}};
    packer.set_plan(plan, slot_of_atom.data());
    for (const ExchangeNeighbor &neighbor : plan.neighbors())
      messages.emplace_back(9L * neighbor.send_count());
  }

  int num_proxies() const { return plan.num_proxies(); }

  void exchange()
  {
    packer.set_state(records, {});
    const auto &neighbors = plan.neighbors();
    for (std::size_t n = 0; n < neighbors.size(); n++)
      packer.pack(neighbors[n], messages[n].data());
    for (std::size_t n = 0; n < neighbors.size(); n++)    // as long as what the other one sends
      packer.unpack(neighbors[n], messages[message_from(neighbors[n].rank)].data());
  }

 private:
  static int opposite(int rank) { return 26 - rank; }

  std::size_t message_from(int rank) const
  {
    const auto &neighbors = plan.neighbors();
    const auto found =
        std::find_if(neighbors.begin(), neighbors.end(),
                     [rank](const auto &neighbor) { return neighbor.rank == opposite(rank); });
    return found - neighbors.begin();
  }

  void make_sites()
  {
    std::array<int, 3> p;
    for (p[0] = -rim; p[0] < across + rim; p[0]++)
      for (p[1] = -rim; p[1] < across + rim; p[1]++)
        for (p[2] = -rim; p[2] < across + rim; p[2]++) {
          Site site{p, {}, 0};
          double x[3];
          for (int d = 0; d < 3; d++) {
            site.side[d] = p[d] < 0 ? -1 : p[d] >= across ? 1 : 0;
            x[d] = spacing * p[d];
          }
          site.key = canonical_key(x, 4.0);
          sites.push_back(site);
        }
    std::sort(sites.begin(), sites.end(),
              [](const Site &a, const Site &b) { return a.key < b.key; });
  }

  /// Owned spheres are numbered in the order of their keys, as LAMMPS sorts them for Talus; proxies
  /// neighbor by neighbor, in the order of their owner.
  void make_plan()
  {
    std::map<std::array<int, 3>, int> index;
    std::vector<std::tuple<int, int, int>> proxies;    // rank, index on it, slot
    for (int slot = 0; slot < static_cast<int>(sites.size()); slot++)
      if (sites[slot].is_owned()) {
        index.emplace(sites[slot].place, static_cast<int>(slot_of_atom.size()));
        slot_of_atom.push_back(slot);
      }
    for (int slot = 0; slot < static_cast<int>(sites.size()); slot++) {
      const Site &site = sites[slot];
      if (site.is_owned()) continue;
      std::array<int, 3> home = site.place;
      for (int d = 0; d < 3; d++) home[d] -= across * site.side[d];
      proxies.emplace_back(rank_towards(site.side), index.at(home), slot);
    }
    std::sort(proxies.begin(), proxies.end());
    const int owned = static_cast<int>(slot_of_atom.size());
    std::vector<ProxyOrigin> origins;
    for (const auto &[rank, owner_index, slot] : proxies) {
      origins.push_back({rank, owner_index, {0, 0, 0}});
      slot_of_atom.push_back(slot);
    }
    plan.build(rank_towards({}), owned, origins);
    for (int rank = 0; rank < 27; rank++)
      if (rank != rank_towards({})) plan.accept_request(rank, plan.request_for(opposite(rank)));
  }

  int across;
  std::vector<Site> sites;    // in canonical order: a place is a slot
  std::vector<int> slot_of_atom;
  ExchangePlan plan;
  ParticleRecords records;
  RecordPacker packer;
  std::vector<std::vector<double>> messages;
};

/// More than the caches hold.
double fill_caches()
{
  static std::vector<double> other(std::size_t{12} << 20, 1.0);
  for (double &value : other) value += 1.0;
  return std::accumulate(other.begin(), other.end(), 0.0);
}

/// Of this thread: others may use the core in between.
double cpu_seconds()
{
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void exchange_records(benchmark::State &state, bool friction)
{
  Cube cube(static_cast<int>(state.range(0)), friction);
  for (auto _ : state) {
    benchmark::DoNotOptimize(fill_caches());
    const double start = cpu_seconds();
    cube.exchange();
    state.SetIterationTime(cpu_seconds() - start);
  }
  state.SetItemsProcessed(state.iterations() * cube.num_proxies());
  state.counters["ns"] =
      benchmark::Counter(1e-9 * static_cast<double>(state.iterations()) * cube.num_proxies(),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["proxies"] = cube.num_proxies();
}

void sizes(benchmark::internal::Benchmark *benchmark)
{
  benchmark->UseManualTime();
  for (const int spheres : {3000, 50000, 400000, 1240000}) benchmark->Arg(spheres);
}
BENCHMARK_CAPTURE(exchange_records, friction, true)->Apply(sizes);
BENCHMARK_CAPTURE(exchange_records, frictionless, false)->Apply(sizes);

}    // namespace

BENCHMARK_MAIN();
