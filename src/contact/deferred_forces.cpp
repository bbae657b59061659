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

/* Flags of different chunks are in different cache lines. */

void DeferredForces::collect_from(const ParticleOrder &order, const WorkPartition &work,
                                  int threads, const std::vector<const PairList *> &lists)
{
  constexpr std::size_t cache_line = 64;
  release();
  first_of_chunk.clear();
  places = 0;
  for (const PairList *list : lists) {
    first_of_chunk.push_back(places);
    places += (list->frontier().size() + cache_line - 1) / cache_line * cache_line;
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
    const PairList &its = *lists[c];
    const bool reads_range = !its.foreign.empty() && its.foreign.front() < range.end &&
                             its.foreign.back() >= range.begin;
    const bool is_within = its.slots().begin < range.end && its.slots().end > range.begin;
    if (!reads_range && !is_within) continue;
    for (std::size_t n = 0; n < its.frontier().size(); n++) {
      const int first = its.first[its.frontier()[n]], second = its.second[its.frontier()[n]];
      for (const int slot : {first, second})
        if (range.holds(slot) && its.defers(slot) && order.owns_slot(slot))
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
  const std::size_t couples = particles.couple.empty() ? 0 : places;
  if (stored.size() == places && stride == particles.stride && couple.size() == couples) return;
  stride = particles.stride;
  stored.assign(places, 0);
  load.assign(stride * places, Record{});
  couple.assign(couples, Record{});
}

void DeferredForces::release()
{
  for (AlignedVector<Record> *records : {&load, &couple}) Talus::release(*records);
  Talus::release(stored);
}

void DeferredForces::add(int thread, ParticleRecords &particles) const
{
  const Rows &its = of_thread[thread];
  const Entry *next = its.entries.data();
  for (const Row &row : its.rows) {
    const Entry *end = its.entries.data() + row.end;
    add_row(row, next, end, particles);
    next = end;
  }
}

/* Signs are factors: nobody could foresee them. Neither these nor the zeros of pairs that do not
   touch change a bit. */

void DeferredForces::add_row(const Row &row, const Entry *begin, const Entry *end,
                             ParticleRecords &particles) const
{
  constexpr double sign_of[2] = {1.0, -1.0};
  const std::size_t s = row.slot;
  const auto sum = [&](Record &to, auto value) {
    Vec4 all = kept_if(!row.has_all, load4(to));
    for (const Entry *e = begin; e < end; e++) all = all + value(*e);
    store(to, all);
  };
  Record *sums = &particles.load[stride * s];
  sum(sums[0],
      [&](const Entry &e) { return sign_of[e.of_second] * load4(load[stride * e.place]); });
  if (stride == 2) sum(sums[1], [&](const Entry &e) { return load4(load[stride * e.place + 1]); });
  if (!couple.empty())
    sum(particles.couple[s],
        [&](const Entry &e) { return sign_of[e.of_second] * load4(couple[e.place]); });
}

double DeferredForces::memory_usage() const
{
  std::size_t bytes = stored.capacity() + sizeof(Record) * (load.capacity() + couple.capacity());
  for (const Rows &its : of_thread)
    bytes += sizeof(Row) * its.rows.capacity() + sizeof(Entry) * its.entries.capacity();
  return static_cast<double>(bytes);
}

}    // namespace Talus
