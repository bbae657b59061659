// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/candidate_list.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace Talus {

void CandidateList::collect(const ParticleOrder &order, const NeighbourView &neighbours,
                            int which_part)
{
  particles = &order;
  part = which_part;
  const bool all = !shared(), of_both = order.in_two_phases();
  // second slots are among these
  const ParticleOrder::Range seconds =
      of_both ? ParticleOrder::Range{0, order.size()} : order.range(part);
  const std::vector<ParticleOrder::Range> rows = order.rows_of(neighbours, part);
  const auto for_each_of_part = [&](auto visit) {
    for (const ParticleOrder::Range &piece : rows)
      neighbours.for_each_pair(piece.begin, piece.end, [&](int i, int j, double weight) {
        const int a = order.slot_of_atom[i], b = order.slot_of_atom[j];
        const int first_of_both = std::min(a, b), second_of_both = std::max(a, b);
        if (all || serves(second_of_both) || (of_both && serves(first_of_both)))
          visit(first_of_both, second_of_both, weight);
      });
  };

  bool all_unit = true;
  // pairs with the n-th second: row_start[n] ... row_start[n+1]-1
  const int rows_in_all = seconds.end - seconds.begin;
  std::vector<std::int64_t> row_start(static_cast<std::size_t>(rows_in_all) + 2, 0);
  for_each_of_part([&](int, int b, double weight) {
    row_start[b - seconds.begin + 2]++;
    all_unit = all_unit && weight == 1.0;
  });
  for (std::size_t s = 2; s < row_start.size(); s++) row_start[s] += row_start[s - 1];
  const std::int64_t count = row_start.back();
  require_countable(count);

  copy_of_first.clear();
  renew(first, count);
  renew(second, count);
  renew(weights, all_unit ? 0 : count);
  for_each_of_part([&](int a, int b, double weight) {
    // which ends as the end of the row
    const std::int64_t c = row_start[b - seconds.begin + 1]++;
    first[c] = a;
    second[c] = b;
    if (!all_unit) weights[c] = weight;
  });
  row_start.pop_back();
  for (int row = 0; row < rows_in_all; row++) sort_row(row_start[row], row_start[row + 1]);
  look_around();
  find_crossing();
}

void CandidateList::find_crossing()
{
  crossing.clear();
  if (!hands_over()) return;
  const int begin = slots().begin;
  for (std::int64_t c = 0; c < num_pairs(); c++)
    if (first[c] < begin) crossing.push_back(static_cast<std::uint32_t>(c));
}

void CandidateList::read_copies(const std::vector<int> &copy_of_slot)
{
  if (crossing.empty()) return;
  renew(copy_of_first, num_pairs());
  std::copy(first.begin(), first.end(), copy_of_first.begin());
  for (const std::uint32_t c : crossing) copy_of_first[c] = copy_of_slot[first[c]];
  for (Distant &its : distant)
    if (its.slot < slots().begin) its.slot = copy_of_slot[its.slot];
}

/* Which particles are far away in memory, and which belong to others: these may stand in the cache
   of another core, however near they are in memory. */

void CandidateList::look_around()
{
  constexpr int records_in_cache = 2048;
  distant.clear();
  foreign.clear();
  std::vector<unsigned char> seen(shared() ? particles->size() : 0, 0);
  for (std::int64_t c = 0; c < num_pairs(); c++) {
    const auto call = [&](int slot) { distant.push_back({static_cast<std::uint32_t>(c), slot}); };
    const auto look_at = [&](int slot) {
      if (serves(slot) || seen[slot]) return;
      seen[slot] = 1;
      call(slot);
      if (particles->part(slot) != ParticleOrder::no_part) foreign.push_back(slot);
    };
    if (second[c] - first[c] > records_in_cache) call(first[c]);
    if (!shared()) continue;
    look_at(first[c]);
    look_at(second[c]);
  }
  std::sort(foreign.begin(), foreign.end());
}

/* The narrow phase counts a few further than there are pairs. */

void CandidateList::require_countable(std::int64_t pairs)
{
  if (pairs > std::int64_t{std::numeric_limits<std::uint32_t>::max()} - 8)
    throw std::length_error("more than 2^32 pairs of neighbors on one rank");
}

/* Rows hold a few pairs, often in order already; those of a sphere much larger than the others may
   be long. */

void CandidateList::sort_row(std::int64_t begin, std::int64_t end)
{
  constexpr std::int64_t few = 32;
  if (end - begin > few) {
    std::vector<std::pair<int, double>> row;
    for (std::int64_t c = begin; c < end; c++)
      row.emplace_back(first[c], weighted() ? weights[c] : 1.0);
    std::sort(row.begin(), row.end());
    for (std::int64_t c = begin; c < end; c++) {
      first[c] = row[c - begin].first;
      if (weighted()) weights[c] = row[c - begin].second;
    }
    return;
  }
  for (std::int64_t c = begin + 1; c < end; c++)
    for (std::int64_t k = c; k > begin && first[k] < first[k - 1]; k--) {
      std::swap(first[k], first[k - 1]);
      if (weighted()) std::swap(weights[k], weights[k - 1]);
    }
}

std::int64_t CandidateList::find(int slot_a, int slot_b) const
{
  const int a = std::min(slot_a, slot_b), b = std::max(slot_a, slot_b);
  const auto row = std::equal_range(second.begin(), second.end(), b);
  const auto begin = first.begin() + (row.first - second.begin());
  const auto end = first.begin() + (row.second - second.begin());
  const auto found = std::lower_bound(begin, end, a);
  return found != end && *found == a ? found - first.begin() : -1;
}

double CandidateList::memory_usage() const
{
  return static_cast<double>(
      sizeof(int) * (first.capacity() + second.capacity() + copy_of_first.capacity()) +
      sizeof(double) * weights.capacity() + sizeof(Distant) * distant.capacity() +
      sizeof(int) * foreign.capacity() + sizeof(std::uint32_t) * crossing.capacity());
}

}    // namespace Talus
