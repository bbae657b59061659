// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/particle_order.h"

#include "contact/in_parallel.h"
#include "contact/simd.h"

#include <algorithm>
#include <limits>
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

/// visit(thread, i, j) for every pair: each thread takes a piece of the rows.
template <class Visit> void for_each_pair(const NeighbourView &neighbours, int threads, Visit visit)
{
  const auto first_row = [&](int thread) {
    return static_cast<int>(std::int64_t{neighbours.rows} * thread / threads);
  };
  in_parallel(threads, threads, [&](int t) {
    neighbours.for_each_pair(first_row(t), first_row(t + 1),
                             [&](int i, int j, double) { visit(t, i, j); });
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
  frontier_slots.clear();

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
  frontier_slots.clear();
  if (parts == 1) return;

  constexpr int enough = 8;
  std::vector<std::vector<int>> pairs(std::min(threads, enough));
  for (auto &one : pairs) one.resize(size());
  Flags late(two_phases ? size() : 0);
  for_each_pair(neighbours, static_cast<int>(pairs.size()), [&](int thread, int i, int j) {
    const int a = slot_of_atom[i], b = slot_of_atom[j];
    pairs[thread][a]++;
    pairs[thread][b]++;
    if (!two_phases) return;
    if (!is_owned(j)) set(late[a]);
    if (!is_owned(i)) set(late[b]);
  });
  assign_parts(pairs, late, threads);
  find_ranges();
  find_frontier(neighbours, threads);
}

/* Ranges of the order with the same work: one for each particle and for each of its pairs. */

void ParticleOrder::assign_parts(const PairCounts &pairs, const Flags &late, int threads)
{
  const auto work = [&](int s) {
    std::int64_t its = 1;
    for (const auto &counted : pairs) its += counted[s];
    return its;
  };
  std::int64_t total = 0, done = 0;
  for (int s = 0; s < size(); s++)
    if (is_owned(atom_of_slot[s])) total += work(s);
  part_of_slot.assign(size(), no_part);
  int range = 0;
  for (int s = 0; s < size(); s++) {
    if (!is_owned(atom_of_slot[s])) continue;
    while (done * threads >= (range + 1) * total) range++;
    part_of_slot[s] = static_cast<std::uint16_t>(two_phases && late[s] ? threads + range : range);
    done += work(s);
  }
}

void ParticleOrder::find_ranges()
{
  range_of_part.assign(parts, {size(), 0});
  for (int s = 0; s < size(); s++) {
    if (part_of_slot[s] == no_part) continue;
    Range &its = range_of_part[part_of_slot[s]];
    its.begin = std::min(its.begin, s);
    its.end = s + 1;
  }
  for (Range &its : range_of_part) its.begin = std::min(its.begin, its.end);
}

ParticleOrder::Range ParticleOrder::range_of_thread(int thread) const
{
  if (!two_phases) return range(thread);
  const Range early = range(thread), late = range(thread + parts / 2);
  if (early.begin == early.end) return late;
  if (late.begin == late.end) return early;
  return {std::min(early.begin, late.begin), std::max(early.end, late.end)};
}

void ParticleOrder::find_frontier(const NeighbourView &neighbours, int threads)
{
  Flags read_by_others(size());
  for_each_pair(neighbours, threads, [&](int, int i, int j) {
    const int a = slot_of_atom[i], b = slot_of_atom[j];
    if (part_of_slot[a] == no_part || part_of_slot[b] == no_part) return;
    if (part_of_slot[a] == part_of_slot[b]) return;
    set(read_by_others[a]);
    set(read_by_others[b]);
  });
  for (int s = 0; s < size(); s++)
    if (read_by_others[s]) frontier_slots.push_back(s);
}

double ParticleOrder::memory_usage() const
{
  return static_cast<double>(sizeof(int) * (atom_of_slot.capacity() + slot_of_atom.capacity()) +
                             sizeof(std::int64_t) * tag.capacity() +
                             sizeof(std::uint16_t) * part_of_slot.capacity() +
                             sizeof(int) * frontier_slots.capacity());
}

}    // namespace Talus
