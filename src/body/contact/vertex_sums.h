// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums of vectors by vertex, and of one number: the same bits in any order, over any number of ranks. Only
// vertices to which something was added take memory.

#ifndef TALUS_BODY_CONTACT_VERTEX_SUMS_H
#define TALUS_BODY_CONTACT_VERTEX_SUMS_H

#include "base/binned_sum.h"
#include "base/vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Talus {

class VertexSums {
 public:
  explicit VertexSums(int num_vertices) : slot_of(num_vertices, -1) {}

  void add(int vertex, const Vector3<double> &v)
  {
    if (v.x == 0.0 && v.y == 0.0 && v.z == 0.0) return;
    std::array<BinnedSum, 3> &sum = sum_of(vertex);
    sum[0].add(v.x);
    sum[1].add(v.y);
    sum[2].add(v.z);
  }
  void add(double number) { of_numbers.add(number); }
  /// Prefetch what add() reads first, and then.
  void prefetch_slot(int vertex) const { __builtin_prefetch(&slot_of[vertex]); }
  void prefetch(int vertex) const
  {
    if (slot_of[vertex] < 0) return;
    const char *const at = reinterpret_cast<const char *>(&sums[slot_of[vertex]]);
    for (std::size_t byte = 0; byte < sizeof sums[0]; byte += 64) __builtin_prefetch(at + byte, 1);
  }
  void clear();

  /// Those to which something was added, ascending.
  std::vector<int> vertices() const;
  Vector3<double> sum(int vertex) const
  {
    const std::array<BinnedSum, 3> &sum = sums[slot_of[vertex]];
    return {sum[0].value(), sum[1].value(), sum[2].value()};
  }
  double sum_of_numbers() const { return of_numbers.value(); }

  /// All of it, for messages and files. add_packed() adds what it finds.
  std::vector<std::int64_t> packed() const;
  void add_packed(const std::int64_t *begin, const std::int64_t *end);

  double memory_usage() const
  {
    return static_cast<double>(sums.capacity() * sizeof sums[0] +
                               (slot_of.capacity() + used.capacity()) * sizeof(int));
  }

 private:
  std::array<BinnedSum, 3> &sum_of(int vertex)
  {
    if (slot_of[vertex] < 0) {
      slot_of[vertex] = static_cast<int>(used.size());
      used.push_back(vertex);
      sums.emplace_back();
    }
    return sums[slot_of[vertex]];
  }

  std::vector<int> slot_of;                      // by vertex: -1: none
  std::vector<int> used;                         // vertices by slot
  std::vector<std::array<BinnedSum, 3>> sums;    // by slot
  BinnedSum of_numbers;
};

}    // namespace Talus

#endif
