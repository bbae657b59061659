// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a pair style does for the pipeline, without a host: one rank with its numbering of owned and
// ghost particles, rebuilds, and particles that move to another rank together with their histories.

#ifndef TALUS_TEST_TEST_RANK_H
#define TALUS_TEST_TEST_RANK_H

#include "contact/contact_survey.h"
#include "neighbor_lists.h"
#include "packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace slow {

/// Particles under way as HistoryStore packs them, by particle.
using Luggage = std::map<int, std::vector<double>>;

class TestRank {
 public:
  Talus::ContactPipeline pipeline;
  std::vector<int> particle;    ///< host's number -> particle of the packing, owned ones first
  int owned = 0;
  std::vector<Vector> force, torque;    ///< by particle of the packing; of owned ones
  std::vector<Talus::TalliedContact> tally;
  std::array<double, Talus::VirialSums::size> virial{};

  explicit TestRank(const Talus::LawTable &laws, int rank = 0) : store(rank)
  {
    pipeline.set_laws(laws);
    store.keep(std::max(laws.history_records(), 1));
  }

  bool reports = true;    ///< ask for reports, with which parts take turns

  /// How the work is divided, from the next rebuild on. In two phases the state of ghosts is
  /// spoiled until the first one is over.
  void divide(int threads, bool two_phases) { pipeline.set_work(threads, two_phases); }

  /// Before a rebuild: histories leave with their particles, all of them, as in a restart file.
  void depart(Luggage &luggage)
  {
    put_aside();
    for (int a = 0; a < owned && !particle.empty(); a++) {
      std::vector<double> &buffer = luggage[particle[a]];
      buffer.resize(Talus::HistoryStore::size_origin + store.list_size(a));
      Talus::HistoryStore::write({store.origin(a).name, -1, -1}, buffer.data());
      buffer.resize(Talus::HistoryStore::size_origin +
                    store.pack_list(a, buffer.data() + Talus::HistoryStore::size_origin));
    }
    store.clear();
    was_here.clear();
  }

  /// The same as in a run: only those of the particles that leave, the others are kept.
  template <class Stays> void depart_and_keep(Luggage &luggage, Stays stays)
  {
    put_aside();
    was_here.clear();
    for (int a = 0; a < owned && !particle.empty(); a++) {
      std::vector<double> buffer(Talus::HistoryStore::size_origin + store.list_size(a));
      buffer.resize(store.pack(a, buffer.data()));
      was_here[particle[a]] = buffer;
      if (!stays(particle[a])) luggage[particle[a]] = buffer;
    }
  }

  /// Takes the given particles in an order of its own, and what it needs of the others as ghosts.
  void rebuild(const Packing &p, std::vector<int> mine, const std::vector<Neighbors> &near,
               const Luggage &luggage, RandomSource &random)
  {
    random.shuffle(mine);
    owned = static_cast<int>(mine.size());
    particle = mine;
    std::vector<int> number(p.size(), -1);
    for (int a = 0; a < owned; a++) number[mine[a]] = a;
    const auto is_mine = [&](int i) { return number[i] >= 0 && number[i] < owned; };
    for (const Neighbors &n : near)
      for (const auto &[i, j] : {std::pair(n.i, n.j), std::pair(n.j, n.i)})
        if (is_mine(i) && number[j] < 0) {
          number[j] = static_cast<int>(particle.size());
          particle.push_back(j);
        }

    store.resize(static_cast<int>(particle.size()));
    for (int a = 0; a < static_cast<int>(particle.size()); a++) {
      const auto stayed = was_here.find(particle[a]);
      const auto came = luggage.find(particle[a]);
      if (a >= owned) {    // of ghosts this rank may know the slot
        const std::int64_t tag = p.tag[particle[a]];
        store.set_ghost(owned, a,
                        stayed != was_here.end() ? Talus::HistoryStore::read(stayed->second.data())
                                                 : Talus::HistoryStore::Origin{tag, -1, -1},
                        elsewhere);
        continue;
      }
      store.forget(a);
      if (came != luggage.end())
        store.unpack(a, came->second.data());
      else if (stayed != was_here.end())
        store.unpack(a, stayed->second.data());
    }
    start(p, near, number, random);
  }

  void compute(const Packing &p, double dt, bool advance)
  {
    const int total = static_cast<int>(particle.size());
    std::vector<double> x, v, omega, radius, mass, mass_override;
    for (const int i : particle) {
      x.insert(x.end(), p.x[i].begin(), p.x[i].end());
      v.insert(v.end(), p.v[i].begin(), p.v[i].end());
      omega.insert(omega.end(), p.omega[i].begin(), p.omega[i].end());
      radius.push_back(p.radius[i]);
      mass.push_back(p.mass[i]);
      mass_override.push_back(p.mass_override[i]);
    }
    std::vector<double> f(3 * total, 0.0), t(3 * total, 0.0);
    const Talus::ParticleView view{x.data(),      v.data(),    omega.data(),
                                   radius.data(), mass.data(), mass_override.data(),
                                   f.data(),      t.data()};
    tally.clear();
    const std::function<void(const Talus::TalliedContact &)> keep =
        [this](const Talus::TalliedContact &contact) { tally.push_back(contact); };
    Talus::VirialSums sums;
    run(view, {dt, advance, reports ? &keep : nullptr, &sums});
    for (int n = 0; n < Talus::VirialSums::size; n++) virial[n] = sums.value(n);

    force.assign(p.size(), Vector{});
    torque.assign(p.size(), Vector{});
    for (int a = 0; a < total; a++)
      for (int d = 0; d < 3; d++) {
        force[particle[a]][d] = f[3 * a + d];
        torque[particle[a]][d] = t[3 * a + d];
      }
  }

  /// History of a pair as particle i sees it.
  Talus::Record history_of(int i, int j) const
  {
    const auto number = [this](int wanted) {
      return static_cast<int>(std::find(particle.begin(), particle.end(), wanted) -
                              particle.begin());
    };
    const auto h = Talus::ContactSurvey(pipeline)
                       .history_of(number(i), number(j))
                       .value_or(Talus::HistoryValues{});
    return {{h[0], h[1], h[2], h[3]}};
  }

 private:
  void start(const Packing &p, const std::vector<Neighbors> &near, const std::vector<int> &number,
             RandomSource &random)
  {
    const auto is_mine = [&](int i) { return number[i] >= 0 && number[i] < owned; };
    std::vector<std::uint64_t> key;
    std::vector<std::int64_t> tag;
    std::vector<int> type;
    for (const int i : particle) {
      key.push_back(p.key[i]);
      tag.push_back(p.tag[i]);
      type.push_back(p.type[i]);
    }
    slow::NeighborLists lists(owned);
    std::vector<Neighbors> shuffled = near;
    random.shuffle(shuffled);
    for (Neighbors n : shuffled) {
      if (!is_mine(n.i) && !is_mine(n.j)) continue;
      if (random.chance(0.5)) std::swap(n.i, n.j);
      lists.add(number[n.i], number[n.j], n.weight);
    }
    pipeline.set_pairs({owned, key, tag, type.data()}, lists.view());
    pipeline.start_pairs(store);
    store.number(pipeline.particle_order());
  }

  void put_aside()
  {
    if (particle.empty()) return;
    pipeline.keep_history(store, {true, false}, false);
    pipeline.release();
  }

  void run(const Talus::ParticleView &view, const Talus::ContactStep &step)
  {
    if (!pipeline.in_two_phases()) {
      pipeline.compute(view, step);
      return;
    }
    const auto spoiled = [this](const double *values, int width) {
      std::vector<double> copy(values, values + width * particle.size());
      std::fill(copy.begin() + width * owned, copy.end(), std::nan(""));
      return copy;
    };
    std::vector<double> x = spoiled(view.x, 3), v = spoiled(view.v, 3),
                        omega = spoiled(view.omega, 3);
    Talus::ParticleView early = view;
    early.x = x.data();
    early.v = v.data();
    early.omega = omega.data();
    pipeline.compute_early(early, step);
    pipeline.compute_late(view, step);
  }

  static constexpr int elsewhere = -2;    // a rank that is not this one
  Talus::HistoryStore store;
  Luggage was_here;    // at the time of keeping
};

inline std::vector<int> everyone(const Packing &p)
{
  std::vector<int> all(p.size());
  for (int i = 0; i < p.size(); i++) all[i] = i;
  return all;
}

}    // namespace slow

#endif
