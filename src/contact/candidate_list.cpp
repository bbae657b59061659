// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/candidate_list.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace Talus {

void CandidateList::order_particles(int num_owned, const std::vector<std::uint64_t> &key,
                                    std::vector<std::int64_t> tag_of_atom)
{
  owned = num_owned;
  tag = std::move(tag_of_atom);
  const int total = static_cast<int>(tag.size());

  struct Entry {
    std::uint64_t key;
    std::int64_t tag;
    int atom;
    bool operator<(const Entry &o) const
    {
      return std::tie(key, tag, atom) < std::tie(o.key, o.tag, o.atom);
    }
  };
  std::vector<Entry> order(total);
  for (int a = 0; a < total; a++) order[a] = {key[a], tag[a], a};
  std::sort(order.begin(), order.end());

  atom_of_slot.resize(total);
  slot_of_atom.resize(total);
  for (int s = 0; s < total; s++) {
    atom_of_slot[s] = order[s].atom;
    slot_of_atom[order[s].atom] = s;
  }
  added.clear();
}

void CandidateList::add_pair(int i, int j, double weight)
{
  const int a = slot_of_atom[i], b = slot_of_atom[j];
  added.push_back({std::min(a, b), std::max(a, b), weight});
}

void CandidateList::finish()
{
  // contacts are numbered with 32 bits to halve the traffic of the contact list
  if (added.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("more than 2^32 candidate pairs on one rank");

  const auto unit = [](const Pair &p) { return p.weight == 1.0; };
  const bool all_unit = std::all_of(added.begin(), added.end(), unit);

  row_start.assign(atom_of_slot.size() + 1, 0);
  for (const Pair &p : added) row_start[p.first + 1]++;
  for (std::size_t s = 1; s < row_start.size(); s++) row_start[s] += row_start[s - 1];

  std::vector<std::pair<int, double>> sorted(added.size());
  std::vector<std::int64_t> next(row_start.begin(), row_start.end() - 1);
  for (const Pair &p : added) sorted[next[p.first]++] = {p.second, p.weight};
  for (std::size_t s = 0; s + 1 < row_start.size(); s++)
    std::sort(sorted.begin() + row_start[s], sorted.begin() + row_start[s + 1]);

  first.resize(added.size());
  second.resize(added.size());
  weights.resize(all_unit ? 0 : added.size());
  for (std::size_t s = 0; s + 1 < row_start.size(); s++)
    for (std::int64_t c = row_start[s]; c < row_start[s + 1]; c++) {
      first[c] = static_cast<int>(s);
      second[c] = sorted[c].first;
      if (!all_unit) weights[c] = sorted[c].second;
    }
}

std::int64_t CandidateList::find(int slot_a, int slot_b) const
{
  const int a = std::min(slot_a, slot_b), b = std::max(slot_a, slot_b);
  const auto begin = second.begin() + row_start[a], end = second.begin() + row_start[a + 1];
  const auto found = std::lower_bound(begin, end, b);
  return found != end && *found == b ? found - second.begin() : -1;
}

double CandidateList::memory_usage() const
{
  return static_cast<double>(sizeof(int) * (atom_of_slot.capacity() + slot_of_atom.capacity() +
                                            first.capacity() + second.capacity()) +
                             sizeof(std::int64_t) * (tag.capacity() + row_start.capacity()) +
                             sizeof(double) * weights.capacity() + sizeof(Pair) * added.capacity());
}

}    // namespace Talus
