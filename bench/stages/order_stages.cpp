// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What it costs that every sum is taken in canonical order. The baseline takes pairs as the
// neighbor list gives them, each of them once on a rank, through the same narrow phase, kernels and
// integrator: no keys, no sorting of particles or pairs, and nothing is computed twice for the sake
// of threads or phases. On two threads, what the second one has added is brought to the sums of the
// first, particle by particle. On two ranks both compute the pairs between them, as the stock
// styles do for friction with history: the alternative sends forces back, one message more.

#include "stages.h"

#include "contact/contact_pipeline.h"

#include <algorithm>
#include <memory>
#include <numeric>

using namespace Talus;

namespace Bench {
namespace {

const std::vector<RecordStep> at_rest{{0.0, 0.0, {0.0, 0.0, 0.0}, 0.4}};

/// Forces stay in the records; particles are there already, but for the first step.
ContactStep in_records(bool first = false)
{
  ContactStep step{dt, true};
  step.read = step.read_ghosts = first;
  step.deliver = false;
  return step;
}

LawTable law()
{
  return one_law("hertz", "multistep");
}

/// Room for the spheres; ghosts are of the other rank.
void prepare(HistoryStore &store, const Bed &bed)
{
  store.resize(bed.size());
  for (int a = bed.owned; a < bed.size(); a++)
    store.set_ghost(bed.owned, a, {bed.tag[a], -1, -1}, 1);
}

/// Talus as it is, on one rank of one or several.
struct Canonical {
  Bed &bed;
  ContactPipeline pipeline;
  HistoryStore histories;

  Canonical(Bed &given, int threads, bool two_phases) : bed(given)
  {
    pipeline.set_laws(law());
    pipeline.set_work(threads, two_phases);
    prepare(histories, bed);
    rebuild();
    run(in_records(true));
  }

  void rebuild()
  {
    if (pipeline.num_particles())
      pipeline.keep_history(histories, {bed.size() > bed.owned, false}, false);
    pipeline.release();
    pipeline.set_pairs({bed.owned, bed.key, bed.tag, bed.type.data()}, bed.neighbors.view());
    pipeline.start_pairs(histories);
    histories.number(pipeline.particle_order());
  }
  void run(const ContactStep &how)
  {
    if (pipeline.in_two_phases()) {
      pipeline.compute_early(bed.view(), how);
      pipeline.compute_late(bed.view(), how);
    } else {
      pipeline.compute(bed.view(), how);
    }
  }
  void start()
  {
    pipeline.motion().prepare(
        [](int begin, int end, signed char *to) { std::fill_n(to, end - begin, 0); }, {});
  }
  void step()
  {
    pipeline.motion().advance(at_rest);
    run(in_records());
  }
};

/// The same work in whatever order is at hand.
struct AsListed {
  Bed &bed;
  ContactScene scene = scene_of(law());
  ParticleOrder order;
  WorkPartition work;
  ParticleRecords records;
  HistoryStore histories;
  ContactChunk part;
  AlignedVector<Record> of_other_thread;
  std::vector<std::uint64_t> index;
  std::vector<ParticleRecords::Role> role;

  AsListed(Bed &given, int threads) : bed(given), index(bed.size())
  {
    std::iota(index.begin(), index.end(), 0);
    order.arrange(bed.owned, index, bed.tag);
    work = WorkPartition(order);
    // knows the order from now on
    part.pairs.collect(order, work, PairRows(order, bed.neighbors.view()), 0);
    records.resize(order.size(), scene.with_friction, scene.with_resistance);
    records.read(order, bed.view(), {0, order.size()});
    if (bed.size() > bed.owned) {
      role.assign(bed.size(), ParticleRecords::GHOST);
      std::fill_n(role.begin(), bed.owned, ParticleRecords::MOVES);
    }
    if (threads == 2) of_other_thread.resize(records.load.size());
    prepare(histories, bed);
    take_pairs();
    start_pairs();
    step();
  }

  void rebuild()
  {
    histories.begin(work, {bed.size() > bed.owned, false});
    part.history.put_aside(part.pairs, histories.chunk(0), false);
    histories.finish(order, 1);
    take_pairs();
    start_pairs();
  }
  void start_pairs()
  {
    histories.open(order, 1);
    part.start_pairs(scene, histories);
    histories.number(order);
  }

  /// Rows and entries, one after the other.
  void take_pairs()
  {
    const NeighborView view = bed.neighbors.view();
    PairList &pairs = part.pairs;
    renew(pairs.first, bed.neighbors.entries.size());
    renew(pairs.second, bed.neighbors.entries.size());
    pairs.distant.clear();
    std::uint32_t c = 0;
    view.for_each_pair([&](int i, int j, double) {
      pairs.first[c] = j;
      pairs.second[c] = i;
      if (i - j > 2048) pairs.distant.push_back({c, j});
      c++;
    });
  }

  void start() {}    // of steps: nothing to prepare
  void step()
  {
    part.compute(scene, records, in_records(),
                 [this](int begin, int end) {
                   SlotChoice slots{begin, end};
                   slots.next_end = order.size();
                   records.advance(at_rest, role, slots);
                 },
                 {});
    for (std::size_t k = 0; k < of_other_thread.size(); k++) {
      store(records.load[k].c, load4(records.load[k].c) + load4(of_other_thread[k].c));
      of_other_thread[k] = Record{};
    }
  }
};

// ---- one rank -----------------------------------------------------------------------------------

void canonical_step(benchmark::State &state, int threads, bool two_phases)
{
  Canonical scene(bed_of(state), threads, two_phases);
  scene.start();
  for (auto _ : state) scene.step();
  count_spheres(state, scene.bed.owned);
}
BENCHMARK_CAPTURE(canonical_step, one_part, 1, false)->Apply(sizes);
BENCHMARK_CAPTURE(canonical_step, two_threads, 2, false)->Apply(sizes);

void canonical_rebuild(benchmark::State &state, int threads, bool two_phases)
{
  Canonical scene(bed_of(state), threads, two_phases);
  for (auto _ : state) scene.rebuild();
  count_spheres(state, scene.bed.owned);
}
BENCHMARK_CAPTURE(canonical_rebuild, one_part, 1, false)->Apply(sizes);
BENCHMARK_CAPTURE(canonical_rebuild, two_threads, 2, false)->Apply(sizes);

void listed_step(benchmark::State &state, int threads)
{
  AsListed scene(bed_of(state), threads);
  for (auto _ : state) scene.step();
  count_spheres(state, scene.bed.owned);
}
BENCHMARK_CAPTURE(listed_step, one_part, 1)->Apply(sizes);
BENCHMARK_CAPTURE(listed_step, two_threads, 2)->Apply(sizes);

void listed_rebuild(benchmark::State &state)
{
  AsListed scene(bed_of(state), 1);
  for (auto _ : state) scene.rebuild();
  count_spheres(state, scene.bed.owned);
}
BENCHMARK(listed_rebuild)->Apply(sizes);

// ---- two ranks, one after the other -------------------------------------------------------------

template <class Variant> struct TwoRanks {
  std::vector<Bed> beds;
  std::vector<std::unique_ptr<Variant>> ranks;

  template <class... Options>
  explicit TwoRanks(const Bed &bed, Options... options) : beds(two_ranks(bed))
  {
    for (Bed &half : beds) ranks.push_back(std::make_unique<Variant>(half, 1, options...));
  }
};

template <class Variant, class... Options>
void step_on_ranks(benchmark::State &state, Options... options)
{
  Bed &bed = bed_of(state);
  TwoRanks<Variant> scene(bed, options...);
  for (auto &rank : scene.ranks) rank->start();
  for (auto _ : state)
    for (auto &rank : scene.ranks) rank->step();
  count_spheres(state, bed.owned);
}

template <class Variant, class... Options>
void rebuild_on_ranks(benchmark::State &state, Options... options)
{
  Bed &bed = bed_of(state);
  TwoRanks<Variant> scene(bed, options...);
  for (auto _ : state)
    for (auto &rank : scene.ranks) rank->rebuild();
  count_spheres(state, bed.owned);
}

void ranks_step(benchmark::State &state, bool two_phases)
{
  step_on_ranks<Canonical>(state, two_phases);
}
BENCHMARK_CAPTURE(ranks_step, one_phase, false)->Apply(sizes);
BENCHMARK_CAPTURE(ranks_step, two_phases, true)->Apply(sizes);

void ranks_rebuild(benchmark::State &state, bool two_phases)
{
  rebuild_on_ranks<Canonical>(state, two_phases);
}
BENCHMARK_CAPTURE(ranks_rebuild, one_phase, false)->Apply(sizes);
BENCHMARK_CAPTURE(ranks_rebuild, two_phases, true)->Apply(sizes);

void listed_ranks_step(benchmark::State &state)
{
  step_on_ranks<AsListed>(state);
}
BENCHMARK(listed_ranks_step)->Apply(sizes);

void listed_ranks_rebuild(benchmark::State &state)
{
  rebuild_on_ranks<AsListed>(state);
}
BENCHMARK(listed_ranks_rebuild)->Apply(sizes);

}    // namespace
}    // namespace Bench
