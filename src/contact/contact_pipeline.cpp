// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_pipeline.h"

#include <algorithm>
#include <exception>

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

/* work(begin, end) for as many ranges of slots as there are threads, at the same time. */

template <class Work> void ContactPipeline::in_ranges(Work work) const
{
  const std::int64_t n = order.size();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int t = 0; t < threads; t++)
    work(static_cast<int>(n * t / threads), static_cast<int>(n * (t + 1) / threads));
}

void ContactPipeline::set_pairs(const Particles &given, const NeighbourView &neighbours)
{
  order.arrange(given.owned, given.key, given.tag);
  order.divide(neighbours, threads, two_phases);
  scene.slot_type.clear();
  if (!scene.laws.uniform()) {
    scene.slot_type.resize(order.size());
    for (int s = 0; s < order.size(); s++) scene.slot_type[s] = given.type[order.atom_of_slot[s]];
  }
  parts.resize(order.num_parts());
  parts_per_phase = threads;
  particles.resize(order.size(), order.num_parts(), scene.with_friction, scene.with_resistance);
  late_slots.clear();
  for (int s = 0; two_phases && s < order.size(); s++)
    if (order.part(s) >= threads && order.part(s) != ParticleOrder::no_part)
      late_slots.push_back(s);

  const int num_parts = order.num_parts();
  std::exception_ptr failure;
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int p = 0; p < num_parts; p++) try {
      parts[p].pairs.collect(order, neighbours, p);
      parts[p].start_pairs(scene, given.partners, given.filed_tag);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
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
  run_parts(host, step, 0, ParticleRecords::Which::ALL);
  for (int p = parts_per_phase; p < static_cast<int>(parts.size()); p += parts_per_phase)
    run_parts(host, step, p, ParticleRecords::Which::NONE);
  add_forces(host);
}

void ContactPipeline::compute_early(const ParticleView &host, const ContactStep &step)
{
  start_step(step);
  run_parts(host, step, 0, ParticleRecords::Which::OWNED);
}

void ContactPipeline::compute_late(const ParticleView &host, const ContactStep &step)
{
  run_parts(host, step, parts_per_phase, ParticleRecords::Which::GHOSTS);
  add_forces(host);
}

void ContactPipeline::add_forces(const ParticleView &host) const
{
  in_ranges([&](int begin, int end) { particles.add_to(order, host, begin, end); });
}

void ContactPipeline::start_step(const ContactStep &step)
{
  if (step.account) step.account->begin_step(order.size());
}

/* Reads what is asked for, then computes the parts of one phase. Reports and accounts are kept in
   the order of the parts, so these then run one after the other. */

void ContactPipeline::run_parts(const ParticleView &host, const ContactStep &step, int first_part,
                                ParticleRecords::Which which)
{
  if (which != ParticleRecords::Which::NONE)
    in_ranges([&](int begin, int end) { particles.read(order, host, begin, end, which); });
  if (first_part)
    for (const int slot : late_slots) particles.clear_sums(slot);
  const int count = std::min(parts_per_phase, static_cast<int>(parts.size()) - first_part);
  const bool alone = threads == 1 || step.report || step.account;
#pragma omp parallel for schedule(static) num_threads(threads) if (!alone)
  for (int p = 0; p < count; p++) {
    ContactStep of_part = step;
    if (p) of_part.meanwhile = nullptr;
    parts[first_part + p].compute(scene, particles, of_part);
  }
}

/* ---------------------------------------------------------------------- */

ContactPipeline::Place ContactPipeline::place_of(int i, int j) const
{
  if (!scene.with_history || std::max(i, j) >= order.size()) return {nullptr, -1};
  const int a = order.slot_of_atom[i], b = order.slot_of_atom[j];
  const int p = order.part(a) != ParticleOrder::no_part ? order.part(a) : order.part(b);
  if (p == ParticleOrder::no_part) return {nullptr, -1};
  const std::int64_t pair = parts[p].pairs.find(a, b);
  return {pair < 0 ? nullptr : &parts[p], pair};
}

TangentialHistory<double> ContactPipeline::history_of(int i, int j) const
{
  const Place place = place_of(i, j);
  if (!place.part) return {};
  const bool in_order = order.slot_of_atom[i] < order.slot_of_atom[j];
  const Record &stored = place.part->history.records[place.pair];
  const Record h = in_order ? stored : mirrored(stored);
  return {{h.c[0], h.c[1], h.c[2]}, h.c[3]};
}

ContactOnset<double> ContactPipeline::onset_of(int i, int j) const
{
  const Place place = place_of(i, j);
  if (!place.part || place.part->history.onsets.empty()) return {};
  const Record &o = place.part->history.onsets[place.pair];
  return {o.c[0], o.c[1], o.c[2]};
}

double ContactPipeline::memory_usage() const
{
  double bytes = order.memory_usage() + particles.memory_usage();
  for (const ContactPart &part : parts) bytes += part.memory_usage();
  return bytes;
}

}    // namespace Talus
