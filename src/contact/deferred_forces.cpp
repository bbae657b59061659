// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/deferred_forces.h"

#include "base/in_parallel.h"

#include <algorithm>
#include <tuple>

namespace Talus {
namespace {

/// A contact of a particle on its way into a row.
struct Found {
  int slot, second, first;
  std::uint32_t place;

  bool operator<(const Found &o) const
  {
    return std::tie(slot, second, first) < std::tie(o.slot, o.second, o.first);
  }
};

}    // namespace

/* Chunks do not share cache lines. */

void DeferredForces::collect_from(const ParticleOrder &order, const WorkPartition &work,
                                  int threads, const std::vector<const PairList *> &lists)
{
  release();
  first_of_chunk.clear();
  places = 0;
  for (const PairList *list : lists) {
    first_of_chunk.push_back(places);
    places += (list->frontier().size() + 1) / 2 * 2;
  }
  PairList::require_countable(static_cast<std::int64_t>(places));
  of_thread.resize(threads);
  in_parallel(threads, threads, [&](int t) {
    Rows mine;
    make_rows(order, work, work.range_of_thread(t), lists, mine);
    of_thread[t] = std::move(mine);
  });
}

void DeferredForces::make_rows(const ParticleOrder &order, const WorkPartition &work,
                               SlotRange range, const std::vector<const PairList *> &lists,
                               Rows &to) const
{
  std::vector<Found> found;
  for (std::size_t c = 0; c < lists.size(); c++) {
    const PairList &list = *lists[c];
    const bool reads_range = !list.foreign.empty() && list.foreign.front() < range.end &&
                             list.foreign.back() >= range.begin;
    const bool is_within = list.slots().begin < range.end && list.slots().end > range.begin;
    if (!reads_range && !is_within) continue;
    for (std::size_t n = 0; n < list.frontier().size(); n++) {
      const int first = list.first[list.frontier()[n]], second = list.second[list.frontier()[n]];
      for (const int slot : {first, second})
        if (range.holds(slot) && list.defers(slot) && order.owns_slot(slot))
          found.push_back({slot, second, first, static_cast<std::uint32_t>(first_of_chunk[c] + n)});
    }
  }
  std::sort(found.begin(), found.end());
  for (const Found &one : found) {
    if (to.rows.empty() || to.rows.back().slot != one.slot)
      to.rows.push_back({one.slot, work.in_two_phases() && work.is_late(one.slot), 0});
    to.entries.push_back({one.place, one.slot == one.second});
    to.rows.back().end = static_cast<std::uint32_t>(to.entries.size());
  }
}

void DeferredForces::make_room(const ParticleRecords &particles)
{
  const std::size_t twisting_torques = particles.twisting_torque.empty() ? 0 : places;
  stride = particles.stride;
  load.assign(stride * places, Record{});
  twisting_torque.assign(twisting_torques, Record{});
  heat_flow.assign(particles.heat_flow.empty() ? 0 : places, 0.0);
}

void DeferredForces::release()
{
  for (AlignedVector<Record> *records : {&load, &twisting_torque}) Talus::release(*records);
  Talus::release(heat_flow);
}

void DeferredForces::add(int thread, ParticleRecords &particles) const
{
  const Rows &part = of_thread[thread];
  const Entry *next = part.entries.data();
  for (const Row &row : part.rows) {
    const Entry *end = part.entries.data() + row.end;
    if (stride == 2)
      add_row<true>(row, next, end, particles);
    else
      add_row<false>(row, next, end, particles);
    if (!twisting_torque.empty()) add_twisting_torques(row, next, end, particles);
    if (!heat_flow.empty()) add_heat(row, next, end, particles);
    next = end;
  }
}

/* Signs are factors, and pairs that do not touch add zero: which are which is unpredictable.
   Neither changes a bit. */

template <bool rotation>
void DeferredForces::add_row(const Row &row, const Entry *begin, const Entry *end,
                             ParticleRecords &particles) const
{
  const Vec4 sign_of[2] = {four(1.0, 1.0, 1.0, 0.0), four(-1.0, -1.0, -1.0, 0.0)};
  constexpr std::size_t row_stride = rotation ? 2 : 1;
  const auto touches = [this](const Entry &e) { return load[row_stride * e.place].c[3] == step; };
  Record *sums = &particles.load[row_stride * row.slot];
  particles.has_acted(row.slot);
  Vec4 force = row.has_all ? particles.weight(row.slot) : load4(sums[0]), torque_per_radius{};
  if constexpr (rotation) torque_per_radius = kept_if(!row.has_all, load4(sums[1]));
  for (const Entry *e = begin; e < end; e++) {
    const Record *stored = &load[row_stride * e->place];
    force = force + sign_of[e->of_second] * kept_if(touches(*e), load4(stored[0]));
    if constexpr (rotation)
      torque_per_radius = torque_per_radius + kept_if(touches(*e), load4(stored[1]));
  }
  store(sums[0], force);
  if constexpr (rotation) store(sums[1], torque_per_radius);
}

void DeferredForces::add_twisting_torques(const Row &row, const Entry *begin, const Entry *end,
                                          ParticleRecords &particles) const
{
  const Vec4 sign_of[2] = {four(1.0, 1.0, 1.0, 0.0), four(-1.0, -1.0, -1.0, 0.0)};
  Vec4 sum = kept_if(!row.has_all, load4(particles.twisting_torque[row.slot]));
  for (const Entry *e = begin; e < end; e++)
    sum = sum + sign_of[e->of_second] * kept_if(acts(*e), load4(twisting_torque[e->place]));
  store(particles.twisting_torque[row.slot], sum);
}

void DeferredForces::add_heat(const Row &row, const Entry *begin, const Entry *end,
                              ParticleRecords &particles) const
{
  double sum = row.has_all ? 0.0 : particles.heat_flow[row.slot];
  for (const Entry *e = begin; e < end; e++) {
    const double flow = acts(*e) ? heat_flow[e->place] : 0.0;
    sum += e->of_second ? -flow : flow;
  }
  particles.heat_flow[row.slot] = sum;
}

double DeferredForces::memory_usage() const
{
  std::size_t bytes = sizeof(Record) * (load.capacity() + twisting_torque.capacity()) +
                      sizeof(double) * heat_flow.capacity();
  for (const Rows &part : of_thread)
    bytes += sizeof(Row) * part.rows.capacity() + sizeof(Entry) * part.entries.capacity();
  return static_cast<double>(bytes);
}

}    // namespace Talus
