// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/work_partition.h"

#include "base/in_parallel.h"
#include "neighbors/pair_rows.h"

#include <limits>
#include <numeric>

namespace Talus {

WorkPartition::WorkPartition(const ParticleOrder &order, const PairRows &rows, int threads,
                             bool two_phases) :
    phases(two_phases ? 2 : 1),
    ends{order.size()}
{
  if (threads > 1) cut(order, rows, threads);
  if (two_phases) assign_roles(order, rows, threads);
}

/* Work is one for each owned particle and for each pair of which it is the second. */

void WorkPartition::cut(const ParticleOrder &order, const PairRows &rows, int threads)
{
  const auto work = [&](int s) { return rows.size(s) + (order.owns_slot(s) ? 1 : 0); };
  std::vector<std::int64_t> sums(threads, 0);
  in_ranges(order.size(), threads, [&](int t, int begin, int end) {
    std::int64_t sum = 0;
    for (int s = begin; s < end; s++) sum += work(s);
    sums[t] = sum;
  });
  const double of_thread =
      static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::int64_t{0})) / threads;

  constexpr int per_thread = 1 + 2 * small_ranges;
  const int ranges = threads + 2 * small_ranges * (threads - 1);
  std::vector<double> work_before(ranges + 1, std::numeric_limits<double>::infinity());
  for (int r = 0; r < ranges; r++) {
    const int thread = (r + small_ranges) / per_thread, piece = (r + small_ranges) % per_thread;
    work_before[r] = r == 0 ? 0.0
                     : piece <= small_ranges
                         ? of_thread * (thread + small_share * piece)
                         : of_thread * (thread + 1 - small_share * (per_thread - piece));
  }

  // each thread finds begins among its slots, or takes its first one for what begins before it
  std::vector<std::vector<int>> begins(threads);
  in_ranges(order.size(), threads, [&](int t, int begin, int end) {
    std::vector<int> mine(ranges, order.size());
    auto done =
        static_cast<double>(std::accumulate(sums.begin(), sums.begin() + t, std::int64_t{0}));
    int next = 0;
    for (int s = begin; s < end; s++) {
      while (done >= work_before[next]) mine[next++] = s;
      done += work(s);
    }
    begins[t] = std::move(mine);
  });
  ends.assign(ranges, order.size());
  for (int r = 1; r < ranges; r++)
    for (const std::vector<int> &of_thread : begins)
      ends[r - 1] = std::min(ends[r - 1], of_thread[r]);
}

void WorkPartition::assign_roles(const ParticleOrder &order, const PairRows &rows, int threads)
{
  role.resize(order.size());
  in_ranges(order.size(), threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) role[s] = order.owns_slot(s) ? EARLY : GHOST;
  });
  rows.for_each_beside_ghosts([&](int slot) { role[slot] = LATE; });
}

double WorkPartition::memory_usage() const
{
  return static_cast<double>(sizeof(int) * ends.capacity() + sizeof(Role) * role.capacity());
}

}    // namespace Talus
