// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/vertex_sums.h"

#include <algorithm>

namespace Talus {
namespace {

/* The digits from the first to the last that is not zero, each a whole number below 2^53. */

void pack_digits(ExactSum sum, std::vector<double> &to)
{
  sum.normalize();
  const std::int64_t *const digits = sum.data();
  int begin = 0, end = ExactSum::size;
  while (begin < end && !digits[begin]) begin++;
  while (end > begin && !digits[end - 1]) end--;
  to.push_back(begin);
  to.push_back(end - begin);
  for (int k = begin; k < end; k++) to.push_back(static_cast<double>(digits[k]));
}

const double *add_digits(const double *from, ExactSum &to)
{
  ExactSum addend;
  const int begin = static_cast<int>(from[0]), count = static_cast<int>(from[1]);
  for (int k = 0; k < count; k++) addend.data()[begin + k] = static_cast<std::int64_t>(from[2 + k]);
  to.add(addend);
  return from + 2 + count;
}

}    // namespace

std::array<ExactSum, 3> &VertexSums::sum_of(int vertex)
{
  if (slot_of[vertex] < 0) {
    slot_of[vertex] = static_cast<int>(used.size());
    used.push_back(vertex);
    if (sums.size() < used.size())
      sums.emplace_back();
    else
      for (ExactSum &sum : sums[used.size() - 1]) sum.clear();
  }
  return sums[slot_of[vertex]];
}

void VertexSums::clear()
{
  for (const int vertex : used) slot_of[vertex] = -1;
  used.clear();
  of_numbers.clear();
}

std::vector<int> VertexSums::vertices() const
{
  std::vector<int> sorted = used;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

Vector3<double> VertexSums::sum(int vertex) const
{
  const std::array<ExactSum, 3> &sum = sums[slot_of[vertex]];
  return {sum[0].value(), sum[1].value(), sum[2].value()};
}

void VertexSums::pack(std::vector<double> &to) const
{
  pack_digits(of_numbers, to);
  for (const int vertex : used) {
    to.push_back(vertex);
    for (const ExactSum &sum : sums[slot_of[vertex]]) pack_digits(sum, to);
  }
}

void VertexSums::unpack(const double *begin, const double *end)
{
  if (begin == end) return;
  const double *at = add_digits(begin, of_numbers);
  while (at != end) {
    std::array<ExactSum, 3> &sum = sum_of(static_cast<int>(*at++));
    for (ExactSum &component : sum) at = add_digits(at, component);
  }
}

}    // namespace Talus
