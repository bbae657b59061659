// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/vertex_sums.h"

#include <algorithm>

namespace Talus {

void VertexSums::clear()
{
  for (const int vertex : used) slot_of[vertex] = -1;
  used.clear();
  sums.clear();
  of_numbers.clear();
}

std::vector<int> VertexSums::vertices() const
{
  std::vector<int> sorted;
  sorted.reserve(used.size());
  for (std::size_t v = 0; v < slot_of.size(); v++)
    if (slot_of[v] >= 0) sorted.push_back(static_cast<int>(v));
  return sorted;
}

std::vector<std::int64_t> VertexSums::packed() const
{
  constexpr std::size_t size_row = 1 + 3 * BinnedSum::size;
  std::vector<std::int64_t> all(BinnedSum::size + size_row * used.size());
  std::int64_t *to = all.data();
  of_numbers.to_array(to);
  to += BinnedSum::size;
  for (std::size_t n = 0; n < used.size(); n++) {
    *to++ = used[n];
    for (const BinnedSum &sum : sums[n]) {
      sum.to_array(to);
      to += BinnedSum::size;
    }
  }
  return all;
}

void VertexSums::add_packed(const std::int64_t *begin, const std::int64_t *end)
{
  if (begin == end) return;
  of_numbers.add(BinnedSum::from_array(begin));
  for (const std::int64_t *from = begin + BinnedSum::size; from != end;) {
    std::array<BinnedSum, 3> &sum = sum_of(static_cast<int>(*from++));
    for (BinnedSum &component : sum) {
      component.add(BinnedSum::from_array(from));
      from += BinnedSum::size;
    }
  }
}

}    // namespace Talus
