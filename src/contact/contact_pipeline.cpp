// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_pipeline.h"

#include <algorithm>
#include <functional>

namespace Talus {

void ContactPipeline::set_laws(const LawTable &table)
{
  scene.laws = table;
  scene.with_friction = table.has_friction();
  scene.with_history = table.has_history();
  scene.history_records = table.history_records();
  scene.with_twisting = table.has_twisting_torques();
  scene.with_resistance = table.has_resistance();
  scene.with_heat = table.conducts_heat();
  scene.liquid.set(table);
  scene.second_order = table.second_order();
  for (ContactChunk &chunk : chunks) chunk.forget_limits();
}

void ContactPipeline::set_work(int num_threads, bool in_phases)
{
  next_threads = std::max(num_threads, 1);
  next_in_phases = in_phases;
}

void ContactPipeline::set_pairs(const Particles &given, const NeighborView &neighbors)
{
  moving.leave();
  kept_lists.reset();
  threads = next_threads;
  order.arrange(given.owned, given.key, given.tag, threads);
  const PairRows rows(order, neighbors, threads);
  work = WorkPartition(order, rows, threads, next_in_phases);
  find_types(given.type);
  make_chunks();
  for_chunks([&](int c) { chunks[c].pairs.collect(order, work, rows, c); });
  ghost_slots.clear();
  for (int slot = 0; slot < order.size(); slot++)
    if (!order.owns_slot(slot)) ghost_slots.push_back(slot);
  find_shared();
  deferred.collect(order, work, threads, [this](int c) { return &chunks[c].pairs; });
  pairs_known = true;
}

void ContactPipeline::find_types(const int *type)
{
  scene.slot_type.clear();
  if (scene.laws.uniform()) return;
  scene.slot_type.resize(order.size());
  in_ranges(order.size(), [&](int begin, int end) {
    for (int s = begin; s < end; s++) scene.slot_type[s] = type[order.atom_of_slot[s]];
  });
}

void ContactPipeline::make_chunks()
{
  chunks.resize(work.num_chunks());
  claims = std::vector<Claim>(work.num_ranges());
  moving.make_room(work.num_ranges());
}

/* Lists of pairs refer to the order and the work of this object, in any copy. */

std::shared_ptr<const ContactPipeline::Lists> ContactPipeline::lists()
{
  if (kept_lists || !pairs_known) return kept_lists;
  auto made = std::make_shared<Lists>(Lists{threads,
                                            order,
                                            work,
                                            {},
                                            ghost_slots,
                                            shared_owned,
                                            shared_ghosts,
                                            is_loaded_before,
                                            deferred});
  for (const ContactChunk &chunk : chunks) made->pairs.push_back(chunk.pairs);
  kept_lists = made;
  return kept_lists;
}

void ContactPipeline::set_lists(const std::shared_ptr<const Lists> &given, const int *type)
{
  moving.leave();
  kept_lists = given;
  threads = given->threads;
  order = given->order;
  work = given->work;
  find_types(type);
  ghost_slots = given->ghost_slots;
  shared_owned = given->shared_owned;
  shared_ghosts = given->shared_ghosts;
  is_loaded_before = given->is_loaded_before;
  deferred = given->deferred;
  make_chunks();
  for_chunks([&](int c) { chunks[c].pairs = given->pairs[c]; });
  pairs_known = true;
}

double ContactPipeline::Lists::memory_usage() const
{
  double bytes =
      order.memory_usage() + work.memory_usage() + deferred.memory_usage() +
      static_cast<double>((ghost_slots.size() + shared_owned.size() + shared_ghosts.size()) *
                              sizeof(int) +
                          is_loaded_before.size());
  for (const PairList &list : pairs) bytes += list.memory_usage();
  return bytes;
}

void ContactPipeline::find_shared()
{
  shared_owned.clear();
  shared_ghosts.clear();
  is_loaded_before.clear();
  for (const ContactChunk &chunk : chunks) mark(chunk.pairs.foreign, is_loaded_before);
  for (int s = 0; s < static_cast<int>(is_loaded_before.size()); s++)
    if (is_loaded_before[s]) (order.owns_slot(s) ? shared_owned : shared_ghosts).push_back(s);
  if (work.in_two_phases()) mark(ghost_slots, is_loaded_before);

  // copies stand behind the slots, those of owned particles first
  const std::size_t shared = shared_owned.size() + shared_ghosts.size();
  if (shared == 0) return;
  ParticleOrder::require_countable(order.size() + shared);
  std::vector<int> copy_of_slot(order.size());
  int copy = order.size();
  for (const std::vector<int> *slots : {&shared_owned, &shared_ghosts})
    for (const int s : *slots) copy_of_slot[s] = copy++;
  for_chunks([&](int c) { chunks[c].pairs.read_copies(copy_of_slot); });
}

void ContactPipeline::start_pairs(HistoryStore &histories)
{
  histories.open(order, threads);
  for_chunks([&](int c) { chunks[c].start_pairs(scene, histories); });
  make_room();
}

void ContactPipeline::take_back_histories(HistoryStore &from)
{
  moving.leave();
  from.open_unmoved(order);
  for_chunks([&](int c) { chunks[c].start_pairs(scene, from); });
  from.close();
}

void ContactPipeline::exchange_contacts(StateExchange &x)
{
  x(dt, lag, particles.position, particles.motion);
  AlignedVector<ChangeRecord> changes = particles.change;
  x(changes);
  if (changes.size() == particles.change.size()) particles.change.swap(changes);
  for (ContactChunk &chunk : chunks) chunk.exchange_contacts(x);
}

void ContactPipeline::change_order(int to_order, const LawOfTypes &law)
{
  if (!scene.with_history) return;
  const auto type = [this](int slot) {
    return scene.slot_type.empty() ? 1 : scene.slot_type[slot];
  };
  for_chunks([&](int c) {
    chunks[c].change_order(to_order, [&](int a, int b) -> const ContactLaw & {
      return law(std::min(type(a), type(b)), std::max(type(a), type(b)));
    });
  });
}

void ContactPipeline::make_room()
{
  particles.resize(order.size(), scene.with_friction, scene.with_twisting,
                   shared_owned.size() + shared_ghosts.size(), moving.keeps_changes(),
                   scene.with_heat);
  deferred.make_room(particles);
}

void ContactPipeline::release_records()
{
  moving.leave();
  if (memory_usage() < release_threshold) return;
  particles.release_sums();
  deferred.release();
  for (ContactChunk &chunk : chunks) chunk.forget_contacts();
}

void ContactPipeline::release()
{
  const bool much = memory_usage() > release_threshold;
  kept_lists.reset();
  release_records();
  pairs_known = false;
  if (much) chunks.clear();
}

void ContactPipeline::keep_history(HistoryStore &to, HistoryStore::Scope scope, bool stay)
{
  to.clear();
  if (!stay) pairs_known = false;
  if (!scene.with_history) return;
  to.begin(work, scope);
  for_chunks([&](int c) { chunks[c].history.put_aside(chunks[c].pairs, to.chunk(c), stay); });
  to.finish(order, threads);
}

/* ---------------------------------------------------------------------- */

void ContactPipeline::compute(const ParticleView &arrays, const ContactStep &step)
{
  start_step(step);
  for (int phase = 0; phase < work.num_phases(); phase++) run_phase(arrays, step, phase);
  end_step(arrays, step);
}

void ContactPipeline::compute_early(const ParticleView &arrays, const ContactStep &step)
{
  start_step(step);
  run_phase(arrays, step, 0);
}

void ContactPipeline::compute_late(const ParticleView &arrays, const ContactStep &step)
{
  run_phase(arrays, step, 1);
  end_step(arrays, step);
}

void ContactPipeline::start_step(const ContactStep &step)
{
  dt = step.dt;
  lag = step.lag;
  if (!particles.has_room()) make_room();
  deferred.begin_step();
}

void ContactPipeline::end_step(const ParticleView &arrays, const ContactStep &step)
{
  moving.end_step(!step.deliver);
  for (const ContactChunk &chunk : chunks) {
    if (step.virial) step.virial->add(chunk.virial());
    if (!step.account) continue;
    step.account->sum += chunk.work();
    chunk.add_work_left(*step.account);
  }
  if (step.liquid) add_liquid_flows(step.liquid);
  const bool forces = step.deliver || step.add_to_arrays;
  if (forces || arrays.heat_flow)
    in_ranges(order.size(), [&](int begin, int end) {
      if (forces)
        particles.add_to(order, arrays, begin, end);
      else
        particles.add_heat_to(order, arrays, begin, end);
    });
  if (!step.deliver || step.read) return;
  in_ranges(order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++) moving.write_state(a, arrays);
  });
}

SlotChoice ContactPipeline::of_thread(const std::vector<int> &slots, int thread) const
{
  if (slots.empty()) return {0, 0};
  const SlotRange range = work.range_of_thread(thread);
  const auto place = [&](int slot) {
    return static_cast<int>(std::lower_bound(slots.begin(), slots.end(), slot) - slots.begin());
  };
  return {place(range.begin), place(range.end), slots.data()};
}

/* Owned particles that several ranges read have to be there before any of these begins: a thread
   loads its own. */

void ContactPipeline::load_shared(const ParticleView &arrays, const ContactStep &step, int thread)
{
  const SlotRange range = work.range_of_thread(thread);
  if (step.read)
    particles.read(order, arrays, of_thread(shared_owned, thread));
  else if (moving.is_moving())
    moving.move_shared(thread);
  else if (!moving.has_moved())    // only the sums are those of the last step
    particles.clear(range.begin, range.end);
}

/* In one phase the others are read on the way, if owned particles are. */

void ContactPipeline::load_ghosts(const ParticleView &arrays, const ContactStep &step, int thread)
{
  const bool all = work.in_two_phases() || !step.read;
  if (step.read_ghosts)
    particles.read(order, arrays, of_thread(all ? ghost_slots : shared_ghosts, thread));
}

/* Chunks of other ranges read copies: were it the particle itself, its thread would have to ask
   theirs for it in every step. */

void ContactPipeline::copy_states(const std::vector<int> &slots, int first_copy, int thread)
{
  const SlotChoice choice = of_thread(slots, thread);
  for (int n = choice.begin; n < choice.end; n++) particles.copy_state(slots[n], first_copy + n);
  streams_are_done();
}

void ContactPipeline::load(const ParticleView &arrays, const ContactStep &step, int range,
                           int begin, int end)
{
  SlotChoice slots{begin, end};
  slots.next_end = work.range(range).end;
  if (step.read) {
    slots.marked = is_loaded_before.empty() ? nullptr : is_loaded_before.data();
    particles.read(order, arrays, slots);
  } else if (moving.is_moving()) {
    moving.move_on_the_way(range, slots);
  }
}

/* visit(chunk) for what a thread does of a phase: what no other one has claimed before. Of a single
   range there is nothing to claim. */

template <class Visit> void ContactPipeline::for_each_chunk_of(int thread, int phase, Visit visit)
{
  work.for_each_wanted(thread, [&](int range) {
    if (claims.size() == 1 || !claims[range].taken.exchange(true, std::memory_order_relaxed))
      visit(work.chunk(phase, range));
  });
}

/* Computes the chunks of one phase. Reports are in the order of the chunks, so these then run one
   after the other. */

void ContactPipeline::run_phase(const ParticleView &arrays, const ContactStep &step, int phase)
{
  const bool first = phase == 0, last = phase + 1 == work.num_phases();
  for (Claim &one : claims) one.taken.store(false, std::memory_order_relaxed);
  const auto prepare = [&](int t) {
    if (first) {
      load_shared(arrays, step, t);
      copy_states(shared_owned, order.size(), t);
    }
    if (!last) return;
    load_ghosts(arrays, step, t);
    copy_states(shared_ghosts, order.size() + static_cast<int>(shared_owned.size()), t);
  };
  const auto compute_chunks = [&](int t) {
    ContactStep thread_step = step;
    if (t) thread_step.progress = nullptr;
    for_each_chunk_of(t, phase, [&](int c) {
      const int range = c % work.num_ranges();
      const auto load_slots = [&](int begin, int end) { load(arrays, step, range, begin, end); };
      chunks[c].compute(scene, particles, thread_step, std::cref(load_slots),
                        {&deferred, deferred.first_place(c), first ? nullptr : &chunks[range]});
    });
  };
  const auto finish = [&](int t) {
    if (!last) return;
    deferred.add(t, particles);
    const SlotRange range = work.range_of_thread(t);
    if (step.add_other_forces) (*step.add_other_forces)(t, range.begin, range.end);
  };
  in_parallel(threads, step.tally ? 1 : threads, prepare, compute_chunks, finish);
  moving.all_are_moved();    // on the way
}

/* ---------------------------------------------------------------------- */

void ContactPipeline::mark(const std::vector<int> &slots, std::vector<unsigned char> &marks) const
{
  if (!slots.empty()) marks.resize(order.size(), 0);
  for (const int s : slots) marks[s] = 1;
}

void ContactPipeline::set_weightless(const std::function<bool(int)> &is_weightless)
{
  std::vector<unsigned char> marks(is_weightless ? order.size() : 0);
  in_ranges(static_cast<std::int64_t>(marks.size()), [&](int begin, int end) {
    for (int s = begin; s < end; s++) marks[s] = is_weightless(order.atom_of_slot[s]);
  });
  particles.set_weightless(std::move(marks));
}

void ContactPipeline::set_own_masses(const double *of_atom)
{
  std::vector<double> own_mass(of_atom ? order.size() : 0);
  for (std::size_t s = 0; s < own_mass.size(); s++) own_mass[s] = of_atom[order.atom_of_slot[s]];
  particles.set_own_masses(std::move(own_mass));
}

double ContactPipeline::memory_usage() const
{
  double bytes = order.memory_usage() + work.memory_usage() + particles.memory_usage() +
                 deferred.memory_usage();
  for (const ContactChunk &chunk : chunks) bytes += chunk.memory_usage();
  return bytes;
}

}    // namespace Talus
