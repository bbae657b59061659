// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/pair_list.h"

#include "base/nearly_sorted.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace Talus {

void PairList::collect(const ParticleOrder &order, const WorkPartition &partition,
                       const PairRows &rows, int chunk)
{
  particles = &order;
  work = &partition;
  range = work->range_of_chunk(chunk);
  late = work->is_late_chunk(chunk);
  copy_of_first.clear();
  if (work->in_two_phases())
    take_of_phase(rows);
  else
    take_all(rows);
  find_frontier();
  find_distant();
}

void PairList::make_room(std::int64_t count, bool with_weights)
{
  require_countable(count);
  renew(first, count);
  renew(second, count);
  renew(weights, with_weights ? count : 0);
}

void PairList::take_all(const PairRows &rows)
{
  std::int64_t count = 0;
  for (int s = range.begin; s < range.end; s++) count += rows.size(s);
  make_room(count, rows.weighted());
  std::int64_t c = 0;
  for (int s = range.begin; s < range.end; s++) {
    const int size = rows.size(s);
    rows.copy(s, first.data() + c, weighted() ? weights.data() + c : nullptr);
    std::fill_n(second.data() + c, size, s);
    c += size;
  }
}

/* Of rows of ghosts all pairs are late, of rows of particles beside ghosts some. */

void PairList::take_of_phase(const PairRows &rows)
{
  const auto for_each_row = [&](auto visit) {
    for (int s = range.begin; s < range.end; s++)
      if (late ? work->is_ghost(s) || work->is_late(s) : !work->is_ghost(s)) visit(s);
  };
  std::int64_t count = 0;
  for_each_row([&](int s) { count += rows.size(s); });
  make_room(count, rows.weighted());
  std::int64_t end = 0;
  for_each_row([&](int s) {
    const std::int64_t begin = end;
    rows.copy(s, first.data() + begin, weighted() ? weights.data() + begin : nullptr);
    for (std::int64_t c = begin; c < begin + rows.size(s); c++) {
      first[end] = first[c];
      if (weighted()) weights[end] = weights[c];
      second[end] = s;
      end += (work->is_ghost(s) || work->is_ghost(first[c])) == late;
    }
  });
  make_room(end, rows.weighted());
}

void PairList::read_copies(const std::vector<int> &copy_of_slot)
{
  if (foreign.empty()) return;
  renew(copy_of_first, num_pairs());
  std::copy(first.begin(), first.end(), copy_of_first.begin());
  for (const std::uint32_t c : at_frontier)
    if (is_foreign(first[c])) copy_of_first[c] = copy_of_slot[first[c]];
  for (Distant &one : distant)
    if (is_foreign(one.slot)) one.slot = copy_of_slot[one.slot];
}

void PairList::find_frontier()
{
  at_frontier.clear();
  foreign.clear();
  frontier_bits.clear();
  before_word.clear();
  if (range.begin == 0 && !work->in_two_phases()) return;
  for (std::int64_t c = 0; c < num_pairs(); c++) {
    if (!defers(first[c]) && !defers(second[c])) continue;
    at_frontier.push_back(static_cast<std::uint32_t>(c));
    if (is_foreign(first[c])) foreign.push_back(first[c]);
  }
  sort_and_unite(foreign);
  frontier_bits.assign(num_pairs() / 64 + 1, 0);
  for (const std::uint32_t c : at_frontier) frontier_bits[c / 64] |= std::uint64_t{1} << (c % 64);
  before_word.assign(frontier_bits.size(), 0);
  for (std::size_t word = 1; word < before_word.size(); word++)
    before_word[word] = before_word[word - 1] +
                        static_cast<std::uint32_t>(__builtin_popcountll(frontier_bits[word - 1]));
}

/* Late pairs are few and stand far from each other: nothing of them can be expected in a cache. */

void PairList::find_distant()
{
  constexpr int records_in_cache = 2048;    // of particles that follow each other
  distant.clear();
  std::vector<unsigned char> seen(range.begin, 0);
  for (std::int64_t c = 0; c < num_pairs(); c++) {
    const auto pair = static_cast<std::uint32_t>(c);
    const bool is_new = is_foreign(first[c]) && !std::exchange(seen[first[c]], 1);
    if (late || is_new || second[c] - first[c] > records_in_cache)
      distant.push_back({pair, first[c]});
    if (late && (c == 0 || second[c] != second[c - 1])) distant.push_back({pair, second[c]});
  }
}

/* The narrow phase counts a few further than there are pairs. */

void PairList::require_countable(std::int64_t pairs)
{
  if (pairs > std::int64_t{std::numeric_limits<std::uint32_t>::max()} - 8)
    throw std::length_error("more than 2^32 pairs of neighbors on one rank");
}

std::int64_t PairList::find(int slot_a, int slot_b) const
{
  const int a = std::min(slot_a, slot_b), b = std::max(slot_a, slot_b);
  const auto row = std::equal_range(second.begin(), second.end(), b);
  const auto begin = first.begin() + (row.first - second.begin());
  const auto end = first.begin() + (row.second - second.begin());
  const auto found = std::lower_bound(begin, end, a);
  return found != end && *found == a ? found - first.begin() : -1;
}

double PairList::memory_usage() const
{
  return static_cast<double>(
      sizeof(int) * (first.capacity() + second.capacity() + copy_of_first.capacity()) +
      sizeof(double) * weights.capacity() + sizeof(Distant) * distant.capacity() +
      sizeof(int) * foreign.capacity() +
      sizeof(std::uint32_t) * (at_frontier.capacity() + before_word.capacity()) +
      sizeof(std::uint64_t) * frontier_bits.capacity());
}

}    // namespace Talus
