// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/particle_order.h"

#include "contact/in_parallel.h"
#include "contact/simd.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace Talus {
namespace {

struct Entry {
  std::uint64_t key;
  std::int64_t tag;
  int atom;
  bool operator<(const Entry &o) const
  {
    return std::tie(key, tag, atom) < std::tie(o.key, o.tag, o.atom);
  }
};

void set(std::atomic<unsigned char> &flag)
{
  flag.store(1, std::memory_order_relaxed);
}

constexpr int rows_in_block = 64;

int num_blocks(const NeighbourView &neighbours)
{
  return neighbours.rows / rows_in_block + (neighbours.rows % rows_in_block ? 1 : 0);
}

ParticleOrder::Range rows_of_block(const NeighbourView &neighbours, int block)
{
  const int begin = block * rows_in_block;
  return {begin, begin + std::min(rows_in_block, neighbours.rows - begin)};
}

template <class Visit>
void for_each_pair_of_block(const NeighbourView &neighbours, int block, Visit visit)
{
  const ParticleOrder::Range rows = rows_of_block(neighbours, block);
  neighbours.for_each_pair(rows.begin, rows.end, visit);
}

/// work(thread, block) for every block of rows: each thread takes some that follow each other.
template <class Work> void in_blocks(const NeighbourView &neighbours, int threads, Work work)
{
  const std::int64_t blocks = num_blocks(neighbours);
  in_parallel(threads, threads, [&](int t) {
    for (std::int64_t b = blocks * t / threads; b < blocks * (t + 1) / threads; b++)
      work(t, static_cast<int>(b));
  });
}

}    // namespace

void ParticleOrder::require_countable(std::size_t particles)
{
  if (particles > static_cast<std::size_t>(std::numeric_limits<int>::max()) - lanes)
    throw std::length_error("more than 2^31 particles and ghosts on one rank");
}

/* The host's particles are nearly in order already, since the contact store sorts them by key. */

void ParticleOrder::arrange(int num_owned, const std::vector<std::uint64_t> &key,
                            std::vector<std::int64_t> tag_of_atom)
{
  owned = num_owned;
  tag = std::move(tag_of_atom);
  require_countable(tag.size());
  const int total = static_cast<int>(tag.size());
  parts = 1;
  two_phases = false;
  part_of_slot.clear();

  std::vector<Entry> order(total);
  for (int a = 0; a < total; a++) order[a] = {key[a], tag[a], a};
  const auto middle = order.begin() + owned;
  if (!std::is_sorted(order.begin(), middle)) std::sort(order.begin(), middle);
  std::sort(middle, order.end());
  std::inplace_merge(order.begin(), middle, order.end());

  atom_of_slot.resize(total);
  slot_of_atom.resize(total);
  for (int s = 0; s < total; s++) {
    atom_of_slot[s] = order[s].atom;
    slot_of_atom[order[s].atom] = s;
  }
}

/* Pairs of each slot are counted by up to eight threads, each for itself. */

void ParticleOrder::divide(const NeighbourView &neighbours, int threads, bool in_phases)
{
  two_phases = in_phases;
  parts = two_phases ? 2 * threads : threads;
  part_of_slot.clear();
  slots_of_block.clear();
  if (parts == 1) return;

  constexpr int enough = 8;
  std::vector<std::vector<int>> pairs(std::min(threads, enough));
  for (auto &one : pairs) one.resize(size());
  Flags late(two_phases ? size() : 0);
  slots_of_block.resize(num_blocks(neighbours));
  in_blocks(neighbours, static_cast<int>(pairs.size()), [&](int thread, int block) {
    Range slots{size(), 0};
    for_each_pair_of_block(neighbours, block, [&](int i, int j, double) {
      const int a = slot_of_atom[i], b = slot_of_atom[j];
      slots = {std::min({slots.begin, a, b}), std::max({slots.end, a + 1, b + 1})};
      pairs[thread][a]++;
      pairs[thread][b]++;
      if (!two_phases) return;
      if (!is_owned(j)) set(late[a]);
      if (!is_owned(i)) set(late[b]);
    });
    slots_of_block[block] = slots;
  });
  assign_parts(pairs, late, threads);
}

/* Ranges of the order with the same work: one for each particle and for each of its pairs. */

void ParticleOrder::assign_parts(PairCounts &pairs, const Flags &late, int threads)
{
  std::vector<int> &work = pairs[0];
  std::vector<std::int64_t> work_of_thread(threads, 0);
  in_parallel(threads, threads, [&](int t) {
    const std::int64_t n = size();
    std::int64_t sum = 0;
    for (std::int64_t s = n * t / threads; s < n * (t + 1) / threads; s++) {
      for (std::size_t other = 1; other < pairs.size(); other++) work[s] += pairs[other][s];
      work[s] = is_owned(atom_of_slot[s]) ? work[s] + 1 : 0;
      sum += work[s];
    }
    work_of_thread[t] = sum;
  });
  const std::int64_t total =
      std::accumulate(work_of_thread.begin(), work_of_thread.end(), std::int64_t{0});

  part_of_slot.assign(size(), no_part);
  range_of_part.assign(parts, {size(), size()});
  std::int64_t done = 0;
  int range = 0;
  for (int s = 0; s < size(); s++) {
    if (work[s] == 0) continue;
    while (done * threads >= (range + 1) * total) range++;
    const int its = two_phases && late[s] ? threads + range : range;
    part_of_slot[s] = static_cast<std::uint16_t>(its);
    range_of_part[its] = {std::min(range_of_part[its].begin, s), s + 1};
    done += work[s];
  }
}

ParticleOrder::Range ParticleOrder::range_of_thread(int thread) const
{
  if (!two_phases) return range(thread);
  const Range early = range(thread), late = range(thread + parts / 2);
  if (early.begin == early.end) return late;
  if (late.begin == late.end) return early;
  return {std::min(early.begin, late.begin), std::max(early.end, late.end)};
}

std::vector<ParticleOrder::Range> ParticleOrder::rows_of(const NeighbourView &neighbours,
                                                         int part) const
{
  if (parts == 1) return {{0, neighbours.rows}};
  const Range its = range(part);
  std::vector<Range> pieces;
  for (int block = 0; block < static_cast<int>(slots_of_block.size()); block++) {
    const Range &slots = slots_of_block[block];
    if (slots.end <= its.begin || slots.begin >= its.end) continue;
    const Range rows = rows_of_block(neighbours, block);
    if (!pieces.empty() && pieces.back().end == rows.begin)
      pieces.back().end = rows.end;
    else
      pieces.push_back(rows);
  }
  return pieces;
}

double ParticleOrder::memory_usage() const
{
  return static_cast<double>(sizeof(int) * (atom_of_slot.capacity() + slot_of_atom.capacity()) +
                             sizeof(std::int64_t) * tag.capacity() +
                             sizeof(std::uint16_t) * part_of_slot.capacity() +
                             sizeof(Range) * slots_of_block.capacity());
}

}    // namespace Talus
