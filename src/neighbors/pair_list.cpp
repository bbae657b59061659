// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "neighbors/pair_list.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace Talus {

void PairList::collect(const ParticleOrder &order, const PairRows &rows, int which_part)
{
  particles = &order;
  part = which_part;
  crossing.clear();
  copy_of_first.clear();
  distant.clear();
  foreign.clear();
  if (order.in_two_phases()) {
    take_served(rows);
    look_around();
  } else {
    take_rows(rows);
    look_back();
  }
}

void PairList::make_room(std::int64_t count, bool with_weights)
{
  require_countable(count);
  renew(first, count);
  renew(second, count);
  renew(weights, with_weights ? count : 0);
}

/* Parts that follow each other have all pairs of their rows. */

void PairList::take_rows(const PairRows &rows)
{
  const ParticleOrder::Range its = slots();
  std::int64_t count = 0;
  for (int s = its.begin; s < its.end; s++) count += rows.size(s);
  make_room(count, rows.weighted());
  std::int64_t c = 0;
  for (int s = its.begin; s < its.end; s++) {
    const int size = rows.size(s);
    rows.copy(s, first.data() + c, weighted() ? weights.data() + c : nullptr);
    std::fill_n(second.data() + c, size, s);
    c += size;
  }
}

/* With two phases, those of which they serve either particle: all of their own rows, and some of
   others. */

void PairList::take_served(const PairRows &rows)
{
  const std::vector<int> &beyond = particles->rows_beyond(part);
  const std::uint16_t *part_of = particles->chunk_of_slots();
  const auto for_each_row = [&](auto visit) {
    auto next = beyond.begin();
    for (int s = slots().begin; s < slots().end; s++) {
      if (!serves(s)) continue;
      while (next != beyond.end() && *next < s) visit(*next++);
      visit(s);
    }
    while (next != beyond.end()) visit(*next++);
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
      end += part_of[s] == part || part_of[first[end]] == part;
    }
  });
  make_room(end, rows.weighted());
}

void PairList::read_copies(const std::vector<int> &copy_of_slot)
{
  if (crossing.empty()) return;
  renew(copy_of_first, num_pairs());
  std::copy(first.begin(), first.end(), copy_of_first.begin());
  for (const std::uint32_t c : crossing) copy_of_first[c] = copy_of_slot[first[c]];
  for (Distant &its : distant)
    if (its.slot < slots().begin) its.slot = copy_of_slot[its.slot];
}

namespace {
/// Of particles that follow each other.
constexpr int records_in_cache = 2048;
}    // namespace

/* Which particles are far away in memory, and which belong to others: these may stand in the cache
   of another core, however near they are in memory. */

void PairList::look_around()
{
  const std::uint16_t *part_of = particles->chunk_of_slots();
  std::vector<unsigned char> seen(particles->size(), 0);
  for (std::int64_t c = 0; c < num_pairs(); c++) {
    const auto call = [&](int slot) { distant.push_back({static_cast<std::uint32_t>(c), slot}); };
    const auto look_at = [&](int slot) {
      if (part_of[slot] == part || seen[slot]) return;
      seen[slot] = 1;
      call(slot);
      if (part_of[slot] != ParticleOrder::no_chunk) foreign.push_back(slot);
    };
    if (second[c] - first[c] > records_in_cache) call(first[c]);
    look_at(first[c]);
    look_at(second[c]);
  }
  std::sort(foreign.begin(), foreign.end());
}

/* The same where others are those before this part. */

void PairList::look_back()
{
  const int begin = slots().begin;
  std::vector<unsigned char> seen(begin, 0);
  for (std::int64_t c = 0; c < num_pairs(); c++) {
    const int a = first[c];
    const auto pair = static_cast<std::uint32_t>(c);
    if (second[c] - a > records_in_cache) distant.push_back({pair, a});
    if (a >= begin) continue;
    crossing.push_back(pair);
    if (std::exchange(seen[a], 1)) continue;
    distant.push_back({pair, a});
    foreign.push_back(a);
  }
  std::sort(foreign.begin(), foreign.end());
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
      sizeof(int) * foreign.capacity() + sizeof(std::uint32_t) * crossing.capacity());
}

}    // namespace Talus
