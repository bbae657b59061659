// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_pipeline.h"

#include "contact/in_parallel.h"

#include <algorithm>

namespace Talus {

void ContactPipeline::set_laws(const LawTable &table)
{
  scene.laws = table;
  scene.with_friction = table.has_friction();
  scene.with_history = table.has_history();
  scene.with_onset = table.has_onset();
  scene.with_resistance = table.has_resistance();
}

void ContactPipeline::set_work(int num_threads, bool in_phases)
{
  threads = std::clamp(num_threads, 1, ParticleOrder::max_threads);
  two_phases = in_phases;
}

/* work(begin, end) for as many ranges of 0 ... n-1 as there are threads, at the same time. */

template <class Work> void ContactPipeline::in_ranges(std::int64_t n, Work work) const
{
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int t = 0; t < threads; t++)
    work(static_cast<int>(n * t / threads), static_cast<int>(n * (t + 1) / threads));
}

void ContactPipeline::set_pairs(const Particles &given, const NeighbourView &neighbours)
{
  in_records = prepared = move_pending = false;
  order.arrange(given.owned, given.key, given.tag);
  order.divide(neighbours, threads, two_phases);
  scene.slot_type.clear();
  if (!scene.laws.uniform()) {
    scene.slot_type.resize(order.size());
    for (int s = 0; s < order.size(); s++) scene.slot_type[s] = given.type[order.atom_of_slot[s]];
  }
  parts.resize(order.num_parts());
  parts_per_phase = threads;
  late_slots.clear();
  for (int s = 0; two_phases && s < order.size(); s++)
    if (order.part(s) >= threads && order.part(s) != ParticleOrder::no_part)
      late_slots.push_back(s);

  mark(order.frontier(), at_frontier);

  travels.assign(order.num_parts() + 1, RecordTravel{});
  in_parallel(order.num_parts(), threads,
              [&](int p) { parts[p].pairs.collect(order, neighbours, p); });
  pairs_known = true;
}

void ContactPipeline::start_pairs(const FiledHistories &filed)
{
  const std::vector<int> slots = slots_then(filed);
  in_parallel(order.num_parts(), threads,
              [&](int p) { parts[p].start_pairs(scene, filed, slots); });
  make_room();
}

/* By present slot: that of the last lists. */

std::vector<int> ContactPipeline::slots_then(const FiledHistories &filed) const
{
  if (filed.kept.empty()) return {};
  std::vector<int> slots(order.size());
  in_ranges(order.size(), [&](int begin, int end) {
    for (int s = begin; s < end; s++) {
      const int atom = order.atom_of_slot[s];
      slots[s] = filed.slot_then(atom, order.is_owned(atom));
    }
  });
  return slots;
}

void ContactPipeline::make_room()
{
  particles.resize(order.size(), order.num_parts(), scene.with_friction, scene.with_resistance);
}

void ContactPipeline::release_records()
{
  in_records = prepared = move_pending = false;
  if (memory_usage() < worth_giving_back) return;
  particles.release();
  Talus::release(held);
  for (ContactPart &part : parts) part.forget_contacts();
}

void ContactPipeline::release()
{
  const bool much = memory_usage() > worth_giving_back;
  release_records();
  if (!much) return;
  parts.clear();
  pairs_known = false;
}

void ContactPipeline::keep_history(KeptContacts &to, bool particles_may_leave)
{
  to.clear();
  pairs_known = false;
  if (!scene.with_history) return;
  to.begin(order, particles_may_leave);
  in_parallel(order.num_parts(), threads,
              [&](int p) { parts[p].history.keep(parts[p].pairs, to.part(p)); });
  to.finish(threads);
}

void ContactPipeline::file_history(PartnerLists &partners) const
{
  partners.begin();
  if (!scene.with_history) return;
  const int num_parts = static_cast<int>(parts.size());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int p = 0; p < num_parts; p++) parts[p].history.announce(parts[p].pairs, partners);
  partners.layout();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int p = 0; p < num_parts; p++) parts[p].history.file(parts[p].pairs, partners);
}

void ContactPipeline::adopt_first_copies(
    PartnerLists &partners,
    const std::function<const double *(int, std::int64_t)> &ghost_values) const
{
  if (!scene.with_history) return;
  for (const ContactPart &part : parts)
    part.history.adopt_first_copies(part.pairs, partners, ghost_values);
}

/* ---------------------------------------------------------------------- */

void ContactPipeline::compute(const ParticleView &host, const ContactStep &step)
{
  start_step(step);
  bring_frontier(host, step);
  if (step.read_ghosts && (order.num_parts() > 1 || !step.read)) read_ghosts(host);
  for (int p = 0; p < static_cast<int>(parts.size()); p += parts_per_phase)
    run_parts(host, step, p);
  end_step(host, step);
}

void ContactPipeline::compute_early(const ParticleView &host, const ContactStep &step)
{
  start_step(step);
  bring_frontier(host, step);
  run_parts(host, step, 0);
}

void ContactPipeline::compute_late(const ParticleView &host, const ContactStep &step)
{
  if (step.read_ghosts) read_ghosts(host);
  run_parts(host, step, parts_per_phase);
  end_step(host, step);
}

void ContactPipeline::end_step(const ParticleView &host, const ContactStep &step)
{
  in_records = !step.deliver;
  move_pending = false;
  if (step.deliver)
    in_ranges(order.size(), [&](int begin, int end) { particles.add_to(order, host, begin, end); });
}

/* What several parts read has to be there before any of them begins. */

void ContactPipeline::bring_frontier(const ParticleView &host, const ContactStep &step)
{
  if (step.read) {
    const std::vector<int> &list = order.frontier();
    in_ranges(list.size(), [&](int begin, int end) {
      particles.read(order, host, {begin, end, list.data()});
    });
  } else if (!move_pending) {    // nobody has moved them: only the sums are those of the last step
    in_ranges(order.size(), [&](int begin, int end) { particles.clear(begin, end); });
  }
}

void ContactPipeline::read_ghosts(const ParticleView &host)
{
  const int *slots = order.slot_of_atom.data() + order.owned;
  in_ranges(order.size() - order.owned, [&](int begin, int end) {
    particles.read(order, host, {begin, end, slots});
  });
}

void ContactPipeline::bring(const ParticleView &host, const ContactStep &step, int part, int begin,
                            int end)
{
  const auto flags = [](const std::vector<unsigned char> &v) {
    return v.empty() ? nullptr : v.data();
  };
  SlotChoice slots{begin, end, nullptr, order.part_of_slots(), part, nullptr};
  if (step.read) {
    slots.marked = flags(at_frontier);
    particles.read(order, host, slots);
  } else if (move_pending) {
    slots.marked = flags(is_moved_at_once);
    travels[part].join(particles.advance(move, role, held.empty() ? nullptr : held.data(), slots));
  }
}

void ContactPipeline::start_step(const ContactStep &step)
{
  if (particles.position.empty()) make_room();
  if (step.account) step.account->begin_step(order.size());
}

/* Computes the parts of one phase. Reports and accounts are kept in the order of the parts, so
   these then run one after the other. */

void ContactPipeline::run_parts(const ParticleView &host, const ContactStep &step, int first_part)
{
  if (first_part)
    for (const int slot : late_slots) particles.clear_sums(slot);
  const int count = std::min(parts_per_phase, static_cast<int>(parts.size()) - first_part);
  const bool alone = threads == 1 || step.report || step.account;
#pragma omp parallel for schedule(static) num_threads(threads) if (!alone)
  for (int p = 0; p < count; p++) {
    ContactStep of_part = step;
    if (p) of_part.meanwhile = nullptr;
    parts[first_part + p].compute(scene, particles, of_part, [&, p](int begin, int end) {
      bring(host, step, first_part + p, begin, end);
    });
  }
  parts_moved = first_part + count;
}

/* ---------------------------------------------------------------------- */

void ContactPipeline::mark(const std::vector<int> &slots, std::vector<unsigned char> &marks) const
{
  marks.assign(slots.empty() ? 0 : order.size(), 0);
  for (const int s : slots) marks[s] = 1;
}

void ContactPipeline::prepare_to_move(const std::function<bool(int)> &moves,
                                      const std::vector<int> &sent, const double *x_then)
{
  bool all = true;
  role.assign(order.size(), ParticleRecords::MOVES);
  for (int s = 0; s < order.size(); s++) {
    const int a = order.atom_of_slot[s];
    if (!order.is_owned(a))
      role[s] = ParticleRecords::GHOST;
    else if (!moves(a))
      role[s] = ParticleRecords::RESTS;
    all = all && role[s] == ParticleRecords::MOVES;
  }
  if (all) role.clear();

  moved_at_once = order.frontier();
  for (const int a : sent) moved_at_once.push_back(order.slot_of_atom[a]);
  std::sort(moved_at_once.begin(), moved_at_once.end());
  moved_at_once.erase(std::unique(moved_at_once.begin(), moved_at_once.end()), moved_at_once.end());
  mark(moved_at_once, is_moved_at_once);

  renew(held, x_then ? order.size() : 0);
  for (int s = 0; x_then && s < order.size(); s++) {
    const int a = order.atom_of_slot[s];
    if (!order.is_owned(a)) continue;
    const double *x = x_then + 3L * a;
    held[s] = {{x[0], x[1], x[2], particles.position[s].c[3]}};
  }
  prepared = true;
}

void ContactPipeline::advance(const RecordStep &step)
{
  move = step;
  move_pending = true;
  parts_moved = 0;
  travels.assign(travels.size(), RecordTravel{});
  const Record *then = held.empty() ? nullptr : held.data();
  std::vector<RecordTravel> pieces(threads);
  const std::int64_t n = moved_at_once.size();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int t = 0; t < threads; t++) {
    const SlotChoice piece{static_cast<int>(n * t / threads),
                           static_cast<int>(n * (t + 1) / threads), moved_at_once.data()};
    pieces[t] = particles.advance(move, role, then, piece);
  }
  for (const RecordTravel &piece : pieces) travels.back().join(piece);
}

RecordTravel ContactPipeline::travel() const
{
  RecordTravel all;
  for (const RecordTravel &one : travels) all.join(one);
  return all;
}

void ContactPipeline::return_state(double *x, double *v, double *omega, double *f, double *torque)
{
  // an error may have come between the two phases, when the first parts have already moved theirs
  for (int p = parts_moved; move_pending && p < order.num_parts(); p++) {
    const ParticleOrder::Range its = order.range(p);
    in_ranges(its.end - its.begin, [&](int begin, int end) {
      particles.advance(move, role, nullptr,
                        {its.begin + begin, its.begin + end, nullptr, order.part_of_slots(), p,
                         is_moved_at_once.empty() ? nullptr : is_moved_at_once.data()});
    });
  }
  move_pending = in_records = false;
  write_state(x, v, omega);
  if (f)
    in_ranges(order.owned, [&](int begin, int end) {
      for (int a = begin; a < end; a++)
        particles.write_forces(order.slot_of_atom[a], f + 3L * a, torque + 3L * a);
    });
}

void ContactPipeline::write_state(double *x, double *v, double *omega) const
{
  in_ranges(order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++)
      particles.write_state(order.slot_of_atom[a], x + 3L * a, v + 3L * a, omega + 3L * a);
  });
}

void ContactPipeline::show_state(const std::vector<int> &atoms, double *x, double *v,
                                 double *omega) const
{
  for (const int atom : atoms) {
    const std::int64_t a = 3L * atom;
    particles.write_state(order.slot_of_atom[atom], x + a, v + a, omega + a);
  }
}

/* ---------------------------------------------------------------------- */

ContactPipeline::Place ContactPipeline::place_of(int i, int j) const
{
  if (!scene.with_history || std::max(i, j) >= num_particles()) return {nullptr, -1};
  const int a = order.slot_of_atom[i], b = order.slot_of_atom[j];
  const int p = order.part(a) != ParticleOrder::no_part ? order.part(a) : order.part(b);
  if (p == ParticleOrder::no_part) return {nullptr, -1};
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

ContactOnset<double> ContactPipeline::onset_of(int i, int j) const
{
  const Place place = place_of(i, j);
  if (!place.part || !place.part->history.with_onsets()) return {};
  if (!place.part->history.touches(place.pair)) return {};
  const Record &o = place.part->history.onset(place.pair);
  return {o.c[0], o.c[1], o.c[2]};
}

double ContactPipeline::memory_usage() const
{
  double bytes = order.memory_usage() + particles.memory_usage();
  for (const ContactPart &part : parts) bytes += part.memory_usage();
  return bytes;
}

}    // namespace Talus
