// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "particles/particle_order.h"

#include "base/in_parallel.h"
#include "base/nearly_sorted.h"
#include "base/simd.h"
#include "neighbors/pair_rows.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace Talus {

void ParticleOrder::require_countable(std::size_t particles)
{
  if (particles > static_cast<std::size_t>(std::numeric_limits<int>::max()) - lanes)
    throw std::length_error("more than 2^31 particles and ghosts on one rank");
}

namespace {

/* The host's particles are usually in order already, since the contact store sorts them by key. */

template <class Before>
std::vector<int> sorted(int begin_all, int end_all, int threads, Before before)
{
  std::vector<int> atoms(end_all - begin_all);
  std::atomic<bool> in_order{true};
  in_ranges(end_all - begin_all, threads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      atoms[n] = begin_all + n;
      if (n > 0 && before(begin_all + n, begin_all + n - 1))
        in_order.store(false, std::memory_order_relaxed);
    }
  });
  if (!in_order) sort_nearly_sorted(atoms, before);
  return atoms;
}

}    // namespace

void ParticleOrder::arrange(int num_owned, const std::vector<std::uint64_t> &key,
                            std::vector<std::int64_t> tag_of_atom, int threads)
{
  owned = num_owned;
  tag = std::move(tag_of_atom);
  require_countable(tag.size());
  const int total = static_cast<int>(tag.size());
  parts = 1;
  two_phases = false;
  chunk_of_slot.clear();
  beyond.clear();

  const auto before = [&](int a, int b) {
    return std::tie(key[a], tag[a], a) < std::tie(key[b], tag[b], b);
  };
  const std::vector<int> ours = sorted(0, owned, threads, before),
                         ghosts = sorted(owned, total, threads, before);
  atom_of_slot.resize(total);
  slot_of_atom.resize(total);
  const auto put = [&](int slot, int atom) {
    atom_of_slot[slot] = atom;
    slot_of_atom[atom] = slot;
  };
  // merges them: each ghost finds its place, owned ones fill the rest
  std::vector<int> ours_before(ghosts.size());
  in_ranges(total - owned, threads, [&](int, int begin, int end) {
    for (int g = begin; g < end; g++) {
      const auto next = std::lower_bound(ours.begin(), ours.end(), ghosts[g], before);
      ours_before[g] = static_cast<int>(next - ours.begin());
      put(ours_before[g] + g, ghosts[g]);
    }
  });
  in_ranges(owned, threads, [&](int, int begin, int end) {
    int g = 0;
    for (int n = begin; n < end; n++) {
      while (g < total - owned && ours_before[g] <= n) g++;
      put(n + g, ours[n]);
    }
  });
}

/* Work is one for each owned particle and for each pair of which it is the second. With two phases
   nothing is done for ghosts. */

void ParticleOrder::divide(const PairRows &rows, int threads, bool in_phases)
{
  two_phases = in_phases;
  parts = two_phases ? 2 * threads : threads + 2 * small_chunks * (threads - 1);
  chunk_of_slot.clear();
  beyond.clear();
  if (parts == 1) return;
  Work work(size());
  in_ranges(size(), threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) {
      const bool is_ghost = !is_owned(atom_of_slot[s]);
      work[s] = is_ghost && two_phases ? 0 : rows.size(s) + (is_ghost ? 0 : 1);
    }
  });
  if (!two_phases) return assign_ranges(work, threads);
  Flags late(size(), 0);
  rows.for_each_beside_ghosts([&](int slot) { late[slot] = 1; });
  assign_phases(work, late, threads);
  find_rows_beyond(rows.neighbors(), threads);
}

ParticleOrder::Sums ParticleOrder::sums_of(const Work &work, int threads) const
{
  Sums sums(threads);
  in_ranges(size(), threads, [&](int t, int begin, int end) {
    sums[t] = std::accumulate(work.begin() + begin, work.begin() + end, std::int64_t{0});
  });
  return sums;
}

/* Ranges of the order: large ones with the same work, between them small ones. */

void ParticleOrder::assign_ranges(const Work &work, int threads)
{
  const Sums sums = sums_of(work, threads);
  const double of_thread =
      static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::int64_t{0})) / threads;

  std::vector<double> work_before(parts + 1, std::numeric_limits<double>::infinity());
  work_before[0] = 0.0;
  for (int p = 1; p < parts; p++) {
    constexpr int per_thread = 1 + 2 * small_chunks;
    const int thread = (p + small_chunks) / per_thread, its = (p + small_chunks) % per_thread;
    work_before[p] =
        of_thread * (its <= small_chunks ? thread + small_chunk * its
                                         : thread + 1 - small_chunk * (per_thread - its));
  }

  chunk_of_slot.resize(size());
  std::vector<std::vector<int>> begins(threads, std::vector<int>(parts + 1, size()));
  in_ranges(size(), threads, [&](int t, int begin, int end) {
    auto done =
        static_cast<double>(std::accumulate(sums.begin(), sums.begin() + t, std::int64_t{0}));
    int its = 0;
    for (int s = begin; s < end; s++) {
      while (done >= work_before[its + 1]) its++;
      chunk_of_slot[s] = static_cast<std::uint16_t>(its);
      begins[t][its] = std::min(begins[t][its], s);
      done += work[s];
    }
  });
  range_of_chunk.assign(parts, {size(), size()});
  for (int p = parts - 1; p >= 0; p--) {
    const int next = p + 1 < parts ? range_of_chunk[p + 1].begin : size();
    range_of_chunk[p] = {next, next};
    for (const std::vector<int> &begin : begins)
      range_of_chunk[p].begin = std::min(range_of_chunk[p].begin, begin[p]);
  }
}

/* Ranges of the order with the same work, and of each what waits for ghosts apart. */

void ParticleOrder::assign_phases(const Work &work, const Flags &late, int threads)
{
  const Sums sums = sums_of(work, threads);
  const std::int64_t total = std::accumulate(sums.begin(), sums.end(), std::int64_t{0});

  chunk_of_slot.resize(size());
  const std::vector<Range> none(parts, {size(), size()});
  std::vector<std::vector<Range>> found(threads, none);
  in_ranges(size(), threads, [&](int t, int begin, int end) {
    std::int64_t done = std::accumulate(sums.begin(), sums.begin() + t, std::int64_t{0});
    int range = 0;
    for (int s = begin; s < end; s++) {
      chunk_of_slot[s] = no_chunk;
      if (work[s] == 0) continue;
      while (done * threads >= (range + 1) * total) range++;
      const int its = late[s] ? threads + range : range;
      chunk_of_slot[s] = static_cast<std::uint16_t>(its);
      found[t][its] = {std::min(found[t][its].begin, s), s + 1};
      done += work[s];
    }
  });
  range_of_chunk = none;
  for (const std::vector<Range> &ranges : found)
    for (int p = 0; p < parts; p++)
      if (ranges[p].begin < ranges[p].end)
        range_of_chunk[p] = {std::min(range_of_chunk[p].begin, ranges[p].begin), ranges[p].end};
}

ParticleOrder::Range ParticleOrder::range_of_thread(int thread) const
{
  if (parts == 1) return range(0);
  if (!two_phases) {
    const int home = thread * (1 + 2 * small_chunks), last = parts - 1;
    return {range(std::max(0, home - small_chunks)).begin,
            range(std::min(last, home + small_chunks)).end};
  }
  const Range early = range(thread), late = range(thread + parts / 2);
  if (early.begin == early.end) return late;
  if (late.begin == late.end) return early;
  return {std::min(early.begin, late.begin), std::max(early.end, late.end)};
}

/* Of most pairs both members are of one part, which is seen without a look at their slots. */

void ParticleOrder::find_rows_beyond(const NeighborView &neighbors, int threads)
{
  std::vector<std::uint16_t> part_of_atom(size());
  in_ranges(size(), threads, [&](int, int begin, int end) {
    for (int a = begin; a < end; a++) part_of_atom[a] = chunk_of_slot[slot_of_atom[a]];
  });
  std::vector<std::vector<std::vector<int>>> found(threads);
  in_ranges(neighbors.rows, threads, [&](int t, int begin, int end) {
    std::vector<std::vector<int>> mine(parts);
    neighbors.for_each_pair(begin, end, [&](int i, int j, double) {
      if (part_of_atom[i] == part_of_atom[j]) return;
      const auto [first, second] = std::minmax({slot_of_atom[i], slot_of_atom[j]});
      if (chunk_of_slot[first] != no_chunk) mine[chunk_of_slot[first]].push_back(second);
    });
    found[t] = std::move(mine);
  });
  beyond.resize(parts);
  in_parallel(parts, threads, [&](int p) {
    for (const auto &of_thread : found)
      beyond[p].insert(beyond[p].end(), of_thread[p].begin(), of_thread[p].end());
    std::sort(beyond[p].begin(), beyond[p].end());
    beyond[p].erase(std::unique(beyond[p].begin(), beyond[p].end()), beyond[p].end());
  });
}

double ParticleOrder::memory_usage() const
{
  std::size_t numbers = atom_of_slot.capacity() + slot_of_atom.capacity();
  for (const auto &rows : beyond) numbers += rows.capacity();
  return static_cast<double>(sizeof(int) * numbers + sizeof(std::int64_t) * tag.capacity() +
                             sizeof(std::uint16_t) * chunk_of_slot.capacity());
}

}    // namespace Talus
