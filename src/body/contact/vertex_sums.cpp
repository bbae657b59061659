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
  std::vector<std::int64_t> all(BinnedSums<1>::size + (1 + BinnedSums<3>::size) * used.size());
  std::int64_t *to = all.data();
  of_numbers.to_array(to);
  to += BinnedSums<1>::size;
  for (std::size_t n = 0; n < used.size(); n++) {
    *to++ = used[n];
    sums[n].to_array(to);
    to += BinnedSums<3>::size;
  }
  return all;
}

void VertexSums::add_packed(const std::int64_t *begin, const std::int64_t *end)
{
  if (begin == end) return;
  of_numbers.add(BinnedSums<1>::from_array(begin));
  for (const std::int64_t *from = begin + BinnedSums<1>::size; from != end;) {
    BinnedSums<3> &sum = sum_of(static_cast<int>(*from++));
    sum.add(BinnedSums<3>::from_array(from));
    from += BinnedSums<3>::size;
  }
}

}    // namespace Talus
