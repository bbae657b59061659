// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Ranks that have nothing but contact histories, without a host: what is known of all contacts, and
// what each rank has of them in its lists. Ghosts are images of particles of other ranks, or of its
// own across a periodic border.

#ifndef TALUS_TEST_HISTORY_RANKS_H
#define TALUS_TEST_HISTORY_RANKS_H

#include "history/contact_history.h"
#include "neighbor_lists.h"
#include "random_source.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace slow {

/// What is to be in the lists of all ranks: by particle, wherever it is.
struct World {
  struct Particle {
    std::int64_t tag;
    std::uint64_t key;
    int owner;
    bool exists;
  };
  std::vector<Particle> particles;
  /// Candidate pairs by ascending particle. Across a border the two are images of each other.
  struct Pair {
    bool touches = false, across = false;
  };
  std::map<std::pair<int, int>, Pair> pairs;
  /// As the particle with the lower number sees it; of contacts of the last lists.
  std::map<std::pair<int, int>, Talus::HistoryValues> histories;
};

/// How the work of all ranks is divided, and what their lists hold.
struct Settings {
  int ranks, threads;
  bool two_phases, periodic;
  int records;    ///< of each contact
};

/// What a pair style does for the history store: one rank with its numbering of owned particles and
/// ghosts, its pairs and their contacts.
class Rank {
 public:
  Rank(int which, const Settings &given) : me(which), settings(given), store(which)
  {
    store.keep(settings.records);
  }

  /// What a particle brings along when it comes to this rank.
  using Luggage = std::map<int, std::vector<double>>;

  /// New lists, with the histories that the store knows.
  void rebuild(const World &world, const Luggage &luggage, RandomSource &random)
  {
    number_particles(world, luggage, random);
    std::vector<std::uint64_t> key;
    std::vector<std::int64_t> tag;
    for (const int i : particle) {
      key.push_back(world.particles[i].key);
      tag.push_back(world.particles[i].tag);
    }
    NeighborLists neighbors(owned);
    for (const auto &[a, b] : local_pairs) neighbors.add(a, b, 1.0);
    order.arrange(owned, key, tag);
    work = Talus::WorkPartition(order, Talus::PairRows(order, neighbors.view(), settings.threads),
                                settings.threads, settings.two_phases);
    pairs.resize(work.num_chunks());
    live.resize(work.num_chunks());
    store.open(order, 1);
    for (int c = 0; c < work.num_chunks(); c++) {
      pairs[c].collect(order, work, Talus::PairRows(order, neighbors.view()), c);
      live[c].fetch(pairs[c], store);
    }
    store.number(order);
  }

  /// visit(history, pair, particle i, particle j) for all pairs, i being the first.
  template <class Visit> void for_each_pair(Visit visit)
  {
    for (std::size_t c = 0; c < pairs.size(); c++)
      for (std::int64_t n = 0; n < pairs[c].num_pairs(); n++)
        visit(live[c], n, atom_of(pairs[c].first[n]), atom_of(pairs[c].second[n]));
  }

  void put_aside(bool particles_may_leave, bool pairs_stay)
  {
    store.begin(work, {particles_may_leave, settings.periodic});
    for (std::size_t c = 0; c < pairs.size(); c++)
      live[c].put_aside(pairs[c], store.chunk(static_cast<int>(c)), pairs_stay);
    store.finish(order, settings.threads);
  }

  /// Its pairs get the histories of `saved`, which were put aside in the present order.
  void take_back(const Talus::HistoryStore &saved)
  {
    store = saved;
    store.open_unmoved(order);
    for (std::size_t c = 0; c < pairs.size(); c++) live[c].fetch(pairs[c], store);
    store.close();
  }

  bool is_owned(int atom) const { return atom < owned; }

  int me;
  Settings settings;
  Talus::HistoryStore store;
  int owned = 0;
  std::vector<int> particle;    // by host's index
  std::map<int, Talus::HistoryStore::Origin> last;

 private:
  int atom_of(int slot) const { return order.atom_of_slot[slot]; }

  /// Owned particles in any order, then a ghost for every pair that needs one.
  void number_particles(const World &world, const Luggage &luggage, RandomSource &random)
  {
    particle.clear();
    for (std::size_t i = 0; i < world.particles.size(); i++)
      if (world.particles[i].exists && world.particles[i].owner == me)
        particle.push_back(static_cast<int>(i));
    random.shuffle(particle);
    owned = static_cast<int>(particle.size());
    std::map<int, int> atom;
    for (int a = 0; a < owned; a++) atom[particle[a]] = a;

    local_pairs.clear();
    std::map<std::pair<int, bool>, int> ghost;    // an image of its own for pairs across a border
    const auto ghost_of = [&](int i, bool across) {
      const auto [place, is_new] = ghost.insert({{i, across}, static_cast<int>(particle.size())});
      if (is_new) particle.push_back(i);
      return place->second;
    };
    for (const auto &[ij, pair] : world.pairs) {
      const auto [i, j] = ij;
      const bool mine_i = atom.count(i), mine_j = atom.count(j);
      if (mine_i && mine_j && !pair.across) {
        local_pairs.emplace_back(atom[i], atom[j]);
        continue;
      }
      if (mine_i) local_pairs.emplace_back(atom[i], ghost_of(j, pair.across));
      if (mine_j) local_pairs.emplace_back(atom[j], ghost_of(i, pair.across));
    }
    carry(world, luggage);
  }

  void carry(const World &world, const Luggage &luggage)
  {
    const int total = static_cast<int>(particle.size());
    store.resize(total);
    for (int a = 0; a < total; a++) {
      const auto found = luggage.find(particle[a]);
      if (is_owned(a)) {
        store.forget(a);
        if (found != luggage.end()) store.unpack(a, found->second.data());
      } else {
        const int owner = world.particles[particle[a]].owner;
        store.set_ghost(owned, a,
                        found != luggage.end() ? Talus::HistoryStore::read(found->second.data())
                                               : Talus::HistoryStore::Origin{},
                        owner);
      }
    }
  }

  Talus::ParticleOrder order;
  Talus::WorkPartition work;
  std::vector<std::pair<int, int>> local_pairs;
  std::vector<Talus::PairList> pairs;
  std::vector<Talus::ContactHistory> live;
};

}    // namespace slow

#endif
