// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_pipeline.h"

#include <algorithm>

namespace Talus {

void ContactPipeline::set_laws(const LawTable &table)
{
  scene.laws = table;
  scene.with_friction = table.has_friction();
  scene.with_history = table.has_history();
  scene.with_impact = table.has_impact();
  scene.with_resistance = table.has_resistance();
}

void ContactPipeline::set_work(int num_threads, bool in_phases)
{
  next_threads = std::clamp(num_threads, 1, ParticleOrder::max_threads);
  next_in_phases = in_phases;
}

void ContactPipeline::set_pairs(const Particles &given, const NeighborView &neighbors)
{
  in_records = prepared = move_pending = false;
  threads = next_threads;
  order.arrange(given.owned, given.key, given.tag, threads);
  const PairRows rows(order, neighbors, threads);
  order.divide(rows, threads, next_in_phases);
  scene.slot_type.clear();
  if (!scene.laws.uniform()) {
    scene.slot_type.resize(order.size());
    in_ranges(order.size(), [&](int begin, int end) {
      for (int s = begin; s < end; s++) scene.slot_type[s] = given.type[order.atom_of_slot[s]];
    });
  }
  parts.resize(order.num_chunks());
  claims = std::vector<Claim>(order.num_chunks());
  late_slots.clear();
  for (int s = 0; order.in_two_phases() && s < order.size(); s++)
    if (order.part(s) >= threads && order.part(s) != ParticleOrder::no_chunk)
      late_slots.push_back(s);

  travels.assign(order.num_chunks(), RecordTravel{});
  in_parallel(order.num_chunks(), threads, [&](int p) { parts[p].pairs.collect(order, rows, p); });
  ghost_slots.assign(order.slot_of_atom.begin() + order.owned, order.slot_of_atom.end());
  std::sort(ghost_slots.begin(), ghost_slots.end());
  find_frontier();
  pairs_known = true;
}

void ContactPipeline::sort_and_unite(std::vector<int> &slots)
{
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

void ContactPipeline::find_frontier()
{
  at_frontier.clear();
  for (const ContactChunk &part : parts) mark(part.pairs.foreign, at_frontier);
  frontier.clear();
  for (int s = 0; s < static_cast<int>(at_frontier.size()); s++)
    if (at_frontier[s]) frontier.push_back(s);
  if (in_two_phases() || frontier.empty()) return;
  // copies are numbered behind the slots
  ParticleOrder::require_countable(order.size() + frontier.size());
  copy_of_slot.resize(order.size());
  for (int n = 0; n < static_cast<int>(frontier.size()); n++)
    copy_of_slot[frontier[n]] = order.size() + n;
  in_parallel(order.num_chunks(), threads,
              [&](int p) { parts[p].pairs.read_copies(copy_of_slot); });
}

void ContactPipeline::start_pairs(HistoryStore &histories)
{
  histories.open(order, threads);
  in_parallel(order.num_chunks(), threads, [&](int p) { parts[p].start_pairs(scene, histories); });
  make_room();
}

void ContactPipeline::make_room()
{
  particles.resize(order.size(), order.num_places(), scene.with_friction, scene.with_resistance,
                   in_two_phases() ? 0 : frontier.size());
}

void ContactPipeline::release_records()
{
  in_records = prepared = move_pending = false;
  if (memory_usage() < worth_giving_back) return;
  particles.release_sums();
  Talus::release(held);
  for (ContactChunk &part : parts) part.forget_contacts();
}

void ContactPipeline::release()
{
  const bool much = memory_usage() > worth_giving_back;
  release_records();
  if (!much) return;
  parts.clear();
  pairs_known = false;
}

void ContactPipeline::keep_history(HistoryStore &to, HistoryStore::Scope scope, bool stay)
{
  to.clear();
  if (!stay) pairs_known = false;
  if (!scene.with_history) return;
  to.begin(order, order.num_chunks(), order.chunk_of_slots(), scope);
  in_parallel(order.num_chunks(), threads,
              [&](int p) { parts[p].history.put_aside(parts[p].pairs, to.chunk(p), stay); });
  to.finish(order, threads);
}

/* ---------------------------------------------------------------------- */

void ContactPipeline::compute(const ParticleView &host, const ContactStep &step)
{
  start_step(step);
  // parts that follow each other bring the ghosts among their slots
  const bool with_ghosts = step.read_ghosts && (in_two_phases() || !step.read);
  run_phase(host, step, 0, with_ghosts);
  if (in_two_phases()) run_phase(host, step, threads, false);
  end_step(host, step);
}

void ContactPipeline::compute_early(const ParticleView &host, const ContactStep &step)
{
  start_step(step);
  run_phase(host, step, 0, false);
}

void ContactPipeline::compute_late(const ParticleView &host, const ContactStep &step)
{
  run_phase(host, step, threads, step.read_ghosts);
  end_step(host, step);
}

void ContactPipeline::end_step(const ParticleView &host, const ContactStep &step)
{
  in_records = !step.deliver;
  move_pending = false;
  if (step.deliver)
    in_ranges(order.size(), [&](int begin, int end) { particles.add_to(order, host, begin, end); });
}

/* Those of a list in ascending order that are in the range of a thread. */

SlotChoice ContactPipeline::of_thread(const std::vector<int> &slots, int thread) const
{
  const ParticleOrder::Range its = order.range_of_thread(thread);
  const auto place = [&](int slot) {
    return static_cast<int>(std::lower_bound(slots.begin(), slots.end(), slot) - slots.begin());
  };
  return {place(its.begin), place(its.end), slots.data()};
}

/* What several parts read has to be there before any of them begins: a thread brings its own. */

void ContactPipeline::bring_frontier(const ParticleView &host, const ContactStep &step, int thread)
{
  if (step.read)
    particles.read(order, host, of_thread(frontier, thread));
  else if (move_pending)
    travels[thread].join(
        particles.advance(move, role, held_or_null(), of_thread(moved_first, thread)));
  else    // nobody has moved them: only the sums are those of the last step
    particles.clear(piece(order.size(), thread), piece(order.size(), thread + 1));
}

void ContactPipeline::read_ghosts(const ParticleView &host, int thread)
{
  const std::size_t n = ghost_slots.size();
  particles.read(order, host,
                 in_two_phases()
                     ? SlotChoice{piece(n, thread), piece(n, thread + 1), ghost_slots.data()}
                     : of_thread(ghost_slots, thread));
}

/* Parts of other threads read copies: were it the particle itself, its thread would have to ask
   theirs for it in every step. */

void ContactPipeline::copy_frontier(int thread)
{
  const SlotChoice its = of_thread(frontier, thread);
  for (int n = its.begin; n < its.end; n++) particles.copy_state(frontier[n], order.size() + n);
  streams_are_done();
}

void ContactPipeline::bring(const ParticleView &host, const ContactStep &step, int part, int begin,
                            int end)
{
  const auto flags = [](const std::vector<unsigned char> &v) {
    return v.empty() ? nullptr : v.data();
  };
  SlotChoice slots{
      begin, end, nullptr, order.chunk_of_slots(), part, nullptr, order.range(part).end};
  if (step.read) {
    slots.marked = flags(at_frontier);
    particles.read(order, host, slots);
  } else if (move_pending) {
    slots.marked = flags(is_moved_before);
    travels[part].join(particles.advance(move, role, held_or_null(), slots));
  }
}

void ContactPipeline::start_step(const ContactStep &step)
{
  remembered.reset();
  if (!particles.has_room()) make_room();
  if (step.account) step.account->begin_step(order.size());
}

/* visit(part) for what a thread does of a phase: in two phases its own part, else what no other
   thread has claimed before. */

template <class Visit>
void ContactPipeline::for_each_part_of(int thread, int first_part, Visit visit)
{
  if (in_two_phases()) return visit(first_part + thread);
  order.for_each_wanted(thread, [&](int p) {
    if (!claims[p].taken.exchange(true, std::memory_order_relaxed)) visit(p);
  });
}

/* Adds what parts have handed over to the particles of a thread. */

void ContactPipeline::take_over(int thread)
{
  const ParticleOrder::Range its = order.range_of_thread(thread);
  for (const ContactChunk &part : parts) {
    const std::vector<int> &foreign = part.pairs.foreign;
    if (foreign.empty() || foreign.back() < its.begin || foreign.front() >= its.end) continue;
    part.handed_over().add_to(particles, its);
  }
}

/* Computes the parts of one phase. Reports and accounts are kept in the order of the parts, so
   these then run one after the other. */

void ContactPipeline::run_phase(const ParticleView &host, const ContactStep &step, int first_part,
                                bool with_ghosts)
{
  const bool last = !in_two_phases() || first_part > 0;
  for (Claim &one : claims) one.taken.store(false, std::memory_order_relaxed);
  const auto prepare = [&](int t) {
    if (first_part)
      of_thread(late_slots, t).for_each([&](std::size_t slot) {
        particles.clear_sums(static_cast<int>(slot));
      });
    else
      bring_frontier(host, step, t);
    if (with_ghosts) read_ghosts(host, t);
    if (!in_two_phases()) copy_frontier(t);
  };
  const auto work = [&](int t) {
    ContactStep of_part = step;
    if (t) of_part.meanwhile = nullptr;
    for_each_part_of(t, first_part, [&](int p) {
      parts[p].compute(scene, particles, of_part,
                       [&](int begin, int end) { bring(host, step, p, begin, end); });
    });
  };
  const auto finish = [&](int t) {
    if (!in_two_phases()) take_over(t);
    const ParticleOrder::Range its = order.range_of_thread(t);
    if (last && step.add_more) (*step.add_more)(t, its.begin, its.end);
  };
  in_parallel(threads, step.report || step.account ? 1 : threads, prepare, work, finish);
  parts_moved = last ? order.num_chunks() : threads;
}

/* ---------------------------------------------------------------------- */

void ContactPipeline::mark(const std::vector<int> &slots, std::vector<unsigned char> &marks) const
{
  if (!slots.empty()) marks.resize(order.size(), 0);
  for (const int s : slots) marks[s] = 1;
}

/* ---------------------------------------------------------------------- */

ContactPipeline::Place ContactPipeline::place_of(int i, int j) const
{
  if (!scene.with_history || std::max(i, j) >= num_particles()) return {nullptr, -1};
  const int a = order.slot_of_atom[i], b = order.slot_of_atom[j];
  const int p = order.chunk_with_pair(std::min(a, b), std::max(a, b));
  if (p == ParticleOrder::no_chunk) return {nullptr, -1};
  const std::int64_t pair = parts[p].pairs.find(a, b);
  return {pair < 0 ? nullptr : &parts[p], pair};
}

TangentialHistory<double> ContactPipeline::history_of(int i, int j) const
{
  const Place place = place_of(i, j);
  if (!place.part || !place.part->history.touches(place.pair)) return {};
  const bool in_order = order.slot_of_atom[i] < order.slot_of_atom[j];
  const Record &stored = place.part->history.record(place.pair);
  const Record h = in_order ? stored : mirrored(stored);
  return {{h.c[0], h.c[1], h.c[2]}, h.c[3]};
}

ContactImpact<double> ContactPipeline::impact_of(int i, int j) const
{
  const Place place = place_of(i, j);
  if (!place.part || !place.part->history.with_impacts()) return {};
  if (!place.part->history.touches(place.pair)) return {};
  const Record &o = place.part->history.impact(place.pair);
  return {o.c[0], o.c[1], o.c[2]};
}

double ContactPipeline::memory_usage() const
{
  double bytes = order.memory_usage() + particles.memory_usage();
  for (const ContactChunk &part : parts) bytes += part.memory_usage();
  return bytes;
}

}    // namespace Talus
