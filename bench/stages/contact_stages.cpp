// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The stages of a step and of a rebuild, one by one, on one thread.

#include "stages.h"

#include "body/contact/body_contacts.h"
#include "body/shape/plane.h"
#include "contact/narrow_phase.h"

#include <algorithm>

using namespace Talus;

namespace Bench {
namespace {

/// A bed in canonical order with its pairs and records.
struct Prepared {
  Bed &bed;
  ContactScene scene;
  ParticleOrder order;
  WorkPartition work;
  ParticleRecords records;
  HistoryStore store;
  ContactChunk part;

  Prepared(Bed &given, const char *normal, const char *tangential) :
      bed(given), scene(scene_of(one_law(normal, tangential)))
  {
    order.arrange(bed.owned, bed.key, bed.tag);
    work = WorkPartition(order);
    store.resize(order.size());
    bring_ghosts();
    records.resize(order.size(), scene.with_friction, scene.with_resistance);
    collect();
    part.start_pairs(scene, store);
    store.number(order);
    records.read(order, bed.view(), all());
    compute();    // contacts are known now
  }

  SlotChoice all() const { return {0, order.size()}; }
  void collect() { part.pairs.collect(order, work, PairRows(order, bed.neighbors.view()), 0); }
  void compute()
  {
    part.compute(scene, records, {dt, true}, [](int, int) {}, {});
  }
  /// Ghosts are images of particles of this rank.
  void bring_ghosts()
  {
    for (int a = bed.owned; a < bed.size(); a++)
      store.set_ghost(bed.owned, a, store.origin(bed.original[a - bed.owned]), 0);
  }
  /// All that a rebuild does with histories, but for the exchange with other ranks.
  void keep_history()
  {
    store.begin(work, {false, bed.owned < bed.size()});
    part.history.put_aside(part.pairs, store.chunk(0), false);
    store.finish(order, 1);
    bring_ghosts();
    store.open(order, 1);
    part.history.fetch(part.pairs, store);
    store.number(order);
  }
  double contacts() const
  {
    double n = 0;
    part.for_each_contact([&](std::int64_t) { n++; });
    return n;
  }
};

Prepared prepared(const benchmark::State &state, const char *normal = "hertz",
                  const char *tangential = "multistep")
{
  return {bed_of(state), normal, tangential};
}

template <class Work> void repeat(benchmark::State &state, const Prepared &p, Work work)
{
  for (auto _ : state) {
    work();
    benchmark::ClobberMemory();
  }
  count_spheres(state, p.bed.owned);
  state.counters["contacts"] = p.contacts() / p.bed.owned;
  state.counters["candidates"] = static_cast<double>(p.part.pairs.num_pairs()) / p.bed.owned;
}

// ---- a rebuild ----------------------------------------------------------------------------------

void order_particles(benchmark::State &state)
{
  Prepared p = prepared(state);
  repeat(state, p, [&] { p.order.arrange(p.bed.owned, p.bed.key, p.bed.tag); });
}
BENCHMARK(order_particles)->Apply(sizes);

void collect_pairs(benchmark::State &state)
{
  Prepared p = prepared(state);
  repeat(state, p, [&] { p.collect(); });
}
BENCHMARK(collect_pairs)->Apply(sizes);

void keep_history(benchmark::State &state)
{
  Prepared p = prepared(state);
  repeat(state, p, [&] { p.keep_history(); });
}
BENCHMARK(keep_history)->Apply(sizes);

void keep_history_periodic(benchmark::State &state)
{
  Bed bed = in_periodic_box(bed_of(state));
  Prepared p(bed, "hertz", "multistep");
  repeat(state, p, [&] { p.keep_history(); });
}
BENCHMARK(keep_history_periodic)->Apply(sizes);

// ---- a step -------------------------------------------------------------------------------------

void read_particles(benchmark::State &state)
{
  Prepared p = prepared(state);
  repeat(state, p, [&] { p.records.read(p.order, p.bed.view(), p.all()); });
}
BENCHMARK(read_particles)->Apply(sizes);

/// Of particles that something has acted on since the last step, or nothing.
void advance_records(benchmark::State &state, bool acted_on)
{
  Prepared p = prepared(state);
  const std::vector<RecordStep> at_rest{{0.0, 0.0, {0.0, 0.0, 0.0}, 0.4}};
  repeat(state, p, [&] {
    if (acted_on)
      for (int s = 0; s < p.all().end; s++) p.records.has_acted(s);
    benchmark::DoNotOptimize(p.records.advance(at_rest, {}, p.all()));
  });
}
BENCHMARK_CAPTURE(advance_records, acted_on, true)->Apply(sizes);
BENCHMARK_CAPTURE(advance_records, free, false)->Apply(sizes);

void narrow_phase(benchmark::State &state)
{
  Prepared p = prepared(state);
  const std::int64_t pairs = p.part.pairs.num_pairs();
  std::vector<std::uint32_t> contacts(pairs + lanes);
  repeat(state, p, [&] {
    find_contacts(p.part.pairs, 0, pairs, p.records.position.data(), &p.part.history,
                  contacts.data());
  });
}
BENCHMARK(narrow_phase)->Apply(sizes);

/// Narrow phase, gather, kernel, and sum.
void contacts(benchmark::State &state, const char *normal, const char *tangential)
{
  Prepared p = prepared(state, normal, tangential);
  repeat(state, p, [&] { p.compute(); });
}
BENCHMARK_CAPTURE(contacts, hooke_frictionless, "hooke", "none")->Apply(sizes);
BENCHMARK_CAPTURE(contacts, hertz_frictionless, "hertz", "none")->Apply(sizes);
BENCHMARK_CAPTURE(contacts, hertz_onestep, "hertz", "onestep")->Apply(sizes);
BENCHMARK_CAPTURE(contacts, hooke_multistep, "hooke", "multistep")->Apply(sizes);
BENCHMARK_CAPTURE(contacts, hertz_multistep, "hertz", "multistep")->Apply(sizes);

void add_to_host(benchmark::State &state)
{
  Prepared p = prepared(state);
  repeat(state, p, [&] { p.records.add_to(p.order, p.bed.view(), 0, p.order.size()); });
}
BENCHMARK(add_to_host)->Apply(sizes);

// ---- a floor under the bed ----------------------------------------------------------------------

/// Contacts with a plane through the lowest layer, of particles in the records.
struct OnFloor {
  Prepared p;
  Plane plane{{0.0, 0.0, -0.48}, {0.0, 0.0, 1.0}, false};
  BodyContacts contacts;
  BodyFrame frame;
  std::vector<int> mask;

  explicit OnFloor(const benchmark::State &state) : p(prepared(state)), mask(p.bed.size(), 1)
  {
    contacts.set_laws(p.scene.laws);
    contacts.history.keep(false);
    frame.origin = plane.reference_point();
    find();
  }
  ParticleState view()
  {
    return {p.bed.owned, p.bed.view(), p.bed.type.data(), &p.records, p.order.slot_of_atom.data()};
  }
  void find() { contacts.find_candidates(plane, frame, view(), mask.data(), 1, skin); }
  BodyLoad compute()
  {
    BodyStep step;
    step.dt = dt;
    return contacts.compute(plane, frame, view(), step);
  }
};

void floor_find(benchmark::State &state)
{
  OnFloor scene(state);
  for (auto _ : state) scene.find();
  count_spheres(state, scene.p.order.size());
}
BENCHMARK(floor_find)->Apply(sizes);

/// Per sphere on the floor, not per sphere of the bed.
void floor_contacts(benchmark::State &state)
{
  OnFloor scene(state);
  const double touching = scene.compute().contacts;
  for (auto _ : state) benchmark::DoNotOptimize(scene.compute());
  count_spheres(state, touching);
  state.counters["contacts"] = touching;
}
BENCHMARK(floor_contacts)->Apply(sizes);

}    // namespace
}    // namespace Bench

BENCHMARK_MAIN();
