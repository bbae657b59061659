// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random particles, owned and ghosts, random pairs of them, and these divided into chunks.

#ifndef TALUS_TEST_RANDOM_PAIRS_H
#define TALUS_TEST_RANDOM_PAIRS_H

#include "neighbor_lists.h"
#include "neighbors/pair_list.h"
#include "neighbors/pair_rows.h"
#include "neighbors/work_partition.h"
#include "particles/particle_order.h"
#include "random_source.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace slow {

/// Particles with few different keys, so that tags decide often; the last third are images of
/// others.
struct Particles {
  std::vector<std::uint64_t> key;
  std::vector<std::int64_t> tag;
  int owned = 0;

  int size() const { return static_cast<int>(tag.size()); }
};

inline Particles random_particles(int n, RandomSource &random)
{
  Particles p;
  for (int a = 0; a < n; a++) {
    p.key.push_back(random.bits() % 5 << (random.chance(0.5) ? 60 : 0));
    p.tag.push_back(1 + a);
  }
  random.shuffle(p.tag);
  const int originals = (2 * n + 2) / 3;
  for (int a = originals; a < n; a++) {
    const int original = random.below(originals);
    p.key[a] = p.key[original];
    p.tag[a] = p.tag[original];
  }
  p.owned = n / 2;
  return p;
}

/// By the second slot, then the first.
struct InOrder {
  bool operator()(const std::pair<int, int> &a, const std::pair<int, int> &b) const
  {
    return std::tie(a.second, a.first) < std::tie(b.second, b.first);
  }
};
template <class T> using BySlots = std::map<std::pair<int, int>, T, InOrder>;

/// Random pairs of particles of which at least one is owned, as weights by slots.
struct Pairs {
  NeighborLists lists;
  BySlots<double> by_slots;    // in the order wanted

  Pairs(const Talus::ParticleOrder &order, double chance, double odd_weight, RandomSource &random) :
      lists(order.owned)
  {
    std::vector<std::tuple<int, int, double>> pairs;
    for (int i = 0; i < order.owned; i++)
      for (int j = i + 1; j < order.size(); j++)
        if (random.chance(chance)) pairs.emplace_back(i, j, random.chance(0.8) ? 1.0 : odd_weight);
    random.shuffle(pairs);
    for (auto [i, j, weight] : pairs) {
      by_slots[std::minmax({order.slot_of_atom[i], order.slot_of_atom[j]})] = weight;
      if (random.chance(0.5)) std::swap(i, j);
      lists.add(i, j, weight);
    }
  }
};

/// Particles, pairs and their division.
struct Divided {
  Talus::ParticleOrder order;
  Pairs pairs;
  Talus::PairRows rows;
  Talus::WorkPartition work;
  std::vector<Talus::PairList> lists;

  Divided(int n, int threads, bool two_phases, RandomSource &random) :
      order(arranged(n, random)), pairs(order, 0.02, 0.5, random),
      rows(order, pairs.lists.view(), threads), work(order, rows, threads, two_phases),
      lists(work.num_chunks())
  {
    for (int c = 0; c < work.num_chunks(); c++) lists[c].collect(order, work, rows, c);
  }

  static Talus::ParticleOrder arranged(int n, RandomSource &random)
  {
    const Particles p = random_particles(n, random);
    Talus::ParticleOrder order;
    order.arrange(p.owned, p.key, p.tag);
    return order;
  }
};

}    // namespace slow

#endif
