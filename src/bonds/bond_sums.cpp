// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "bonds/bond_sums.h"

#include <tuple>

namespace Talus {

void BondSums::set_bonds(const std::vector<BondEnds> &all, int owned, const std::int64_t *tag)
{
  num_bonds = static_cast<int>(all.size());
  bonds = all;
  while (bonds.size() % lanes != 0) bonds.push_back(bonds.back());
  forces.resize(bonds.size());
  energies.resize(bonds.size());
  torques1.resize(turning ? bonds.size() : 0);
  torques2.resize(torques1.size());

  sides_begin.assign(owned + 1L, 0);
  const auto for_each_side = [&](auto visit) {
    for (int b = 0; b < num_bonds; b++)
      for (const bool first : {true, false})
        if (const int i = first ? all[b].first : all[b].second; i < owned) visit(i, Side{b, first});
  };
  for_each_side([&](int i, Side) { sides_begin[i + 1L]++; });
  for (int i = 0; i < owned; i++) sides_begin[i + 1L] += sides_begin[i];
  sides.resize(sides_begin[owned]);
  std::vector<std::uint32_t> next = sides_begin;
  for_each_side([&](int i, Side side) { sides[next[i]++] = side; });
  const auto order = [&](const Side &s) {
    const BondEnds &b = all[s.bond];
    return std::make_tuple(tag[s.first ? b.second : b.first], b.type);
  };
  for (int i = 0; i < owned; i++)
    std::sort(sides.begin() + sides_begin[i], sides.begin() + sides_begin[i + 1L],
              [&](const Side &a, const Side &b) { return order(a) < order(b); });
}

void BondSums::drop(int b)
{
  bonds[b].type = 0;
  forces[b] = {};
  energies[b] = 0.0;
  if (!turning) return;
  torques1[b] = {};
  torques2[b] = {};
}

double BondSums::memory_usage() const
{
  return static_cast<double>(
      bonds.capacity() * sizeof(BondEnds) + energies.capacity() * sizeof(double) +
      (forces.capacity() + torques1.capacity() + torques2.capacity()) * sizeof(Record) +
      sides_begin.capacity() * sizeof(std::uint32_t) + sides.capacity() * sizeof(Side));
}

/* ---------------------------------------------------------------------- */

void BondSums::add_to(const ParticleState &particles, int threads) const
{
  if (turning)
    add_all<true>(particles, threads);
  else
    add_all<false>(particles, threads);
}

template <bool with_torques>
void BondSums::add_all(const ParticleState &particles, int threads) const
{
  const auto owned = static_cast<std::int64_t>(sides_begin.size()) - 1;
  in_ranges(owned, threads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      const std::uint32_t first = sides_begin[i], last = sides_begin[i + 1L];
      if (first == last) continue;
      Vec4 f{}, t{};
      for (std::uint32_t s = first; s < last; s++) {
        const auto [bond, is_first] = sides[s];
        const Vec4 on_first = load4(forces[bond]);
        f = is_first ? f + on_first : f - on_first;
        if constexpr (with_torques) t = t + load4(is_first ? torques1[bond] : torques2[bond]);
      }
      particles.add_at(particles.place(i), f, with_torques ? &t : nullptr);
    }
  });
}

}    // namespace Talus
