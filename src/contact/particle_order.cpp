// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/particle_order.h"

#include "contact/in_parallel.h"
#include "contact/pair_rows.h"
#include "contact/simd.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace Talus {
namespace {

void set(std::atomic<unsigned char> &flag)
{
  flag.store(1, std::memory_order_relaxed);
}

constexpr int rows_in_block = 64;

int num_blocks(int rows)
{
  return rows / rows_in_block + (rows % rows_in_block ? 1 : 0);
}

ParticleOrder::Range rows_of_block(int rows, int block)
{
  const int begin = block * rows_in_block;
  return {begin, begin + std::min(rows_in_block, rows - begin)};
}

}    // namespace

void ParticleOrder::require_countable(std::size_t particles)
{
  if (particles > static_cast<std::size_t>(std::numeric_limits<int>::max()) - lanes)
    throw std::length_error("more than 2^31 particles and ghosts on one rank");
}

/* The host's particles are usually in order already, since the contact store sorts them by key. */

void ParticleOrder::arrange(int num_owned, const std::vector<std::uint64_t> &key,
                            std::vector<std::int64_t> tag_of_atom, int threads)
{
  owned = num_owned;
  tag = std::move(tag_of_atom);
  require_countable(tag.size());
  const int total = static_cast<int>(tag.size());
  parts = 1;
  two_phases = false;
  part_of_slot.clear();

  const auto before = [&](int a, int b) {
    return std::tie(key[a], tag[a], a) < std::tie(key[b], tag[b], b);
  };
  std::atomic<bool> in_order{true};
  atom_of_slot.resize(total);
  in_ranges(total, threads, [&](int, int begin, int end) {
    std::iota(atom_of_slot.begin() + begin, atom_of_slot.begin() + end, begin);
    for (int a = std::max(begin, 1); a < std::min(end, owned); a++)
      if (before(a, a - 1)) in_order.store(false, std::memory_order_relaxed);
  });
  const auto middle = atom_of_slot.begin() + owned;
  if (!in_order) std::sort(atom_of_slot.begin(), middle, before);
  std::sort(middle, atom_of_slot.end(), before);
  std::inplace_merge(atom_of_slot.begin(), middle, atom_of_slot.end(), before);

  slot_of_atom.resize(total);
  in_ranges(total, threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) slot_of_atom[atom_of_slot[s]] = s;
  });
}

/* Work is one for each owned particle and for each of its pairs, without two phases for those of
   which it is the second. */

void ParticleOrder::divide(const PairRows &rows, int threads, bool in_phases)
{
  two_phases = in_phases;
  parts = two_phases ? 2 * threads : threads + 2 * small_parts * (threads - 1);
  part_of_slot.clear();
  classes_of_block.clear();
  if (parts == 1) return;
  Work work(size());
  if (two_phases) {
    Flags late(size());
    count_in_phases(rows, threads, work, late);
    assign_phases(work, late, threads);
    return;
  }
  in_ranges(size(), threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) work[s] = rows.size(s) + (is_owned(atom_of_slot[s]) ? 1 : 0);
  });
  assign_ranges(work, threads);
}

/* Pairs of each slot are counted by up to eight threads, each for itself. Nothing is done for
   ghosts. */

void ParticleOrder::count_in_phases(const PairRows &rows, int threads, Work &work, Flags &late)
{
  for (class_bits = 0; size() >> class_bits >= 64;) class_bits++;
  classes_of_block.resize(num_blocks(size()));
  constexpr int enough = 8;
  std::vector<std::vector<int>> pairs(std::min(threads, enough));
  for (auto &one : pairs) one.resize(size());
  const auto count_row = [&](int second, std::vector<int> &mine) {
    std::uint64_t classes = 0;
    rows.for_each(second, [&](int first, double) {
      mine[first]++;
      mine[second]++;
      classes |= std::uint64_t{1} << class_of(first) | std::uint64_t{1} << class_of(second);
      if (!is_owned(atom_of_slot[first])) set(late[second]);
      if (!is_owned(atom_of_slot[second])) set(late[first]);
    });
    return classes;
  };
  in_ranges(num_blocks(size()), static_cast<int>(pairs.size()), [&](int t, int begin, int end) {
    for (int b = begin; b < end; b++) {
      const Range its = rows_of_block(size(), b);
      for (int s = its.begin; s < its.end; s++) classes_of_block[b] |= count_row(s, pairs[t]);
    }
  });
  in_ranges(size(), threads, [&](int, int begin, int end) {
    for (int s = begin; s < end; s++) {
      work[s] = is_owned(atom_of_slot[s]) ? 1 : 0;
      for (const auto &one : pairs) work[s] += work[s] ? one[s] : 0;
    }
  });
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
    constexpr int per_thread = 1 + 2 * small_parts;
    const int thread = (p + small_parts) / per_thread, its = (p + small_parts) % per_thread;
    work_before[p] =
        of_thread * (its <= small_parts ? thread + small_part * its
                                        : thread + 1 - small_part * (per_thread - its));
  }

  part_of_slot.resize(size());
  std::vector<std::vector<int>> begins(threads, std::vector<int>(parts + 1, size()));
  in_ranges(size(), threads, [&](int t, int begin, int end) {
    auto done =
        static_cast<double>(std::accumulate(sums.begin(), sums.begin() + t, std::int64_t{0}));
    int its = 0;
    for (int s = begin; s < end; s++) {
      while (done >= work_before[its + 1]) its++;
      part_of_slot[s] = static_cast<std::uint16_t>(its);
      begins[t][its] = std::min(begins[t][its], s);
      done += work[s];
    }
  });
  range_of_part.assign(parts, {size(), size()});
  for (int p = parts - 1; p >= 0; p--) {
    const int next = p + 1 < parts ? range_of_part[p + 1].begin : size();
    range_of_part[p] = {next, next};
    for (const std::vector<int> &begin : begins)
      range_of_part[p].begin = std::min(range_of_part[p].begin, begin[p]);
  }
}

/* Ranges of the order with the same work, and of each what waits for ghosts apart. */

void ParticleOrder::assign_phases(const Work &work, const Flags &late, int threads)
{
  const Sums sums = sums_of(work, threads);
  const std::int64_t total = std::accumulate(sums.begin(), sums.end(), std::int64_t{0});

  part_of_slot.resize(size());
  const std::vector<Range> none(parts, {size(), size()});
  std::vector<std::vector<Range>> found(threads, none);
  in_ranges(size(), threads, [&](int t, int begin, int end) {
    std::int64_t done = std::accumulate(sums.begin(), sums.begin() + t, std::int64_t{0});
    int range = 0;
    for (int s = begin; s < end; s++) {
      part_of_slot[s] = no_part;
      if (work[s] == 0) continue;
      while (done * threads >= (range + 1) * total) range++;
      const int its = late[s] ? threads + range : range;
      part_of_slot[s] = static_cast<std::uint16_t>(its);
      found[t][its] = {std::min(found[t][its].begin, s), s + 1};
      done += work[s];
    }
  });
  range_of_part = none;
  for (const std::vector<Range> &ranges : found)
    for (int p = 0; p < parts; p++)
      if (ranges[p].begin < ranges[p].end)
        range_of_part[p] = {std::min(range_of_part[p].begin, ranges[p].begin), ranges[p].end};
}

ParticleOrder::Range ParticleOrder::range_of_thread(int thread) const
{
  if (parts == 1) return range(0);
  if (!two_phases) {
    const int home = thread * (1 + 2 * small_parts), last = parts - 1;
    return {range(std::max(0, home - small_parts)).begin,
            range(std::min(last, home + small_parts)).end};
  }
  const Range early = range(thread), late = range(thread + parts / 2);
  if (early.begin == early.end) return late;
  if (late.begin == late.end) return early;
  return {std::min(early.begin, late.begin), std::max(early.end, late.end)};
}

std::uint64_t ParticleOrder::classes_of(Range slots) const
{
  if (slots.begin >= slots.end) return 0;
  const int first = class_of(slots.begin), last = class_of(slots.end - 1);
  return ~std::uint64_t{0} << first & ~std::uint64_t{0} >> (63 - last);
}

std::vector<ParticleOrder::Range> ParticleOrder::rows_of(int part) const
{
  const std::uint64_t wanted = classes_of(range(part));
  std::vector<Range> pieces;
  for (int block = 0; block < static_cast<int>(classes_of_block.size()); block++) {
    if (!(classes_of_block[block] & wanted)) continue;
    const Range rows = rows_of_block(size(), block);
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
                             sizeof(std::uint64_t) * classes_of_block.capacity());
}

}    // namespace Talus
