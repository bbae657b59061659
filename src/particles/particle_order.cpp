// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "particles/particle_order.h"

#include "base/in_parallel.h"
#include "base/nearly_sorted.h"
#include "base/simd.h"

#include <algorithm>
#include <atomic>
#include <limits>
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

/* LAMMPS' particles are usually in order already, since the contact store sorts them by key. */

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
  // merges them: each ghost finds its place behind that of the one before, owned ones fill the rest
  std::vector<int> ours_before(ghosts.size());
  in_ranges(total - owned, threads, [&](int, int begin, int end) {
    auto next = ours.begin();
    if (begin < end) next = std::lower_bound(next, ours.end(), ghosts[begin], before);
    for (int g = begin; g < end; g++) {
      while (next != ours.end() && before(*next, ghosts[g])) ++next;
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

double ParticleOrder::memory_usage() const
{
  return static_cast<double>(sizeof(int) * (atom_of_slot.capacity() + slot_of_atom.capacity()) +
                             sizeof(std::int64_t) * tag.capacity());
}

}    // namespace Talus
