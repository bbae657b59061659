// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/pair_rows.h"

#include "base/in_parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace Talus {
namespace {

/// Most rows are not longer.
constexpr int usual = 16;
using Ints = VectorOf<std::int32_t, usual>;

/* Every number goes where it belongs: as far as there are smaller ones, or equal ones before it.
   No branch, since it would be mispredicted. */

inline void sort_usual(const std::int32_t *numbers, int count, int *sorted)
{
  alignas(64) std::int32_t rank[usual];
  const Ints all = Memory<Ints>::load(numbers), lane = counting<Ints>();
  Ints before{};
  for (int k = 0; k < count; k++)
    before = before - ((all > numbers[k]) | ((all == numbers[k]) & (lane > k)));
  store(rank, before);
  for (int k = 0; k < count; k++) sorted[rank[k]] = numbers[k];
}

}    // namespace

PairRows::PairRows(const ParticleOrder &particles, const NeighborView &neighbors, int threads) :
    order(particles), view(neighbors), ranges(threads), scaled(neighbors.scales())
{
  if (view.particle || view.rows == 0) {    // a list without rows may have no arrays at all
    listed.resize(order.size(), 0);
    for (int row = 0; row < view.rows; row++) listed[view.particle[row]] = 1;
  }
  renew(sizes, num_slots());
  beside_ghosts.resize(ranges);
  std::vector<Finds> finds(ranges);
  in_parallel(ranges, ranges, [&](int r) { look_through(r, finds[r]); });
  const auto any = [](const Finds &found) {
    return std::any_of(found.begin(), found.end(), [](const auto &one) { return !one.empty(); });
  };
  if (std::none_of(finds.begin(), finds.end(), any)) return;
  reversed.resize(ranges);
  in_parallel(ranges, ranges, [&](int r) { take_reversed(r, finds); });
}

/* Counts the pairs in the rows of a range of slots, and notes those that belong to others. */

void PairRows::look_through(int range, Finds &finds)
{
  Finds mine(ranges);
  std::vector<int> beside;
  bool some = false;
  for (int slot = range_begin(range); slot < range_begin(range + 1); slot++) {
    const int atom = order.atom_of_slot[slot];
    const bool is_owned = order.is_owned(atom);
    int count = 0;
    for (int n = 0; has_row(atom) && n < view.size[atom]; n++) {
      const int entry = view.entries[atom][n], other = slot_of(entry);
      const double scale = scaled ? view.scale_of(entry) : 1.0;
      if (scale == 0.0) continue;
      some = some || scale != 1.0;
      count += other < slot;
      if (other > slot) mine[range_of(other)].push_back({other, atom | (entry & ~view.index_mask)});
      if (order.is_owned(entry & view.index_mask) != is_owned)
        beside.push_back(is_owned ? slot : other);
    }
    sizes[slot] = count;
  }
  // written here alone: vectors side by side would share cache lines
  finds = std::move(mine);
  beside_ghosts[range] = std::move(beside);
  if (some) with_weights = true;
}

/* Sorts what has been found for a range by the second slot. */

void PairRows::take_reversed(int range, const std::vector<Finds> &finds)
{
  Reversed &of_range = reversed[range];
  const int begin = range_begin(range), rows = range_begin(range + 1) - begin;
  const auto for_each_found = [&](auto visit) {
    for (const Finds &of_thread : finds)
      for (const Found &found : of_thread[range]) visit(found.second - begin, found.entry);
  };
  std::vector<std::size_t> &ends = of_range.begin;
  ends.assign(rows + 2, 0);
  for_each_found([&](int row, int) { ends[row + 2]++; });
  for (int row = 0; row < rows; row++) sizes[begin + row] += static_cast<int>(ends[row + 2]);
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  renew(of_range.entries, ends.back());
  // the begin of a row moves on to its end
  for_each_found([&](int row, int entry) { of_range.entries[ends[row + 1]++] = entry; });
  ends.pop_back();
}

void PairRows::copy(int second, int *firsts, double *weights) const
{
  const int count = size(second);
  if (count == 0) return;
  if (count <= usual && !weights) {
    alignas(64) std::int32_t numbers[usual];
    std::fill_n(numbers, usual, std::numeric_limits<std::int32_t>::max());
    int n = 0;
    for_each(second, [&](int first, double) { numbers[n++] = first; });
    return sort_usual(numbers, count, firsts);
  }
  std::vector<std::pair<int, double>> row;
  row.reserve(count);
  for_each(second, [&](int first, double scale) { row.emplace_back(first, scale); });
  std::sort(row.begin(), row.end());
  for (int n = 0; n < count; n++) {
    firsts[n] = row[n].first;
    if (weights) weights[n] = row[n].second;
  }
}

}    // namespace Talus
