// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums of vectors by vertex, and of one number: the same bits in any order, over any number of ranks. Only
// vertices to which something was added take memory.

#ifndef TALUS_BODY_CONTACT_VERTEX_SUMS_H
#define TALUS_BODY_CONTACT_VERTEX_SUMS_H

#include "base/aligned_vector.h"
#include "base/binned_sum.h"
#include "base/vector3.h"

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
    Sum &sum = sum_of(vertex);
    sum.add(0, v.x);
    sum.add(1, v.y);
    sum.add(2, v.z);
  }
  void add(double number) { of_numbers.add(0, number); }
  /// Prefetch what add() reads first, and then.
  void prefetch_slot(int vertex) const { __builtin_prefetch(&slot_of[vertex]); }
  void prefetch(int vertex) const
  {
    if (slot_of[vertex] < 0) return;
    const char *const at = reinterpret_cast<const char *>(&sums[slot_of[vertex]]);
    for (std::size_t byte = 0; byte < sizeof(Sum); byte += 64) __builtin_prefetch(at + byte, 1);
  }
  void clear();

  /// Those to which something was added, ascending.
  std::vector<int> vertices() const;
  Vector3<double> sum(int vertex) const
  {
    double value[3];
    sums[slot_of[vertex]].values(value);
    return {value[0], value[1], value[2]};
  }
  double sum_of_numbers() const
  {
    double value;
    of_numbers.values(&value);
    return value;
  }

  /// All of it, for messages and files. add_packed() adds what it finds.
  std::vector<std::int64_t> packed() const;
  void add_packed(const std::int64_t *begin, const std::int64_t *end);

  template <class Exchange> void exchange_state(Exchange &x)
  {
    std::vector<std::int64_t> all = packed();
    x(all);
    if (!x.restores()) return;
    clear();
    add_packed(all.data(), all.data() + all.size());
  }

  double memory_usage() const
  {
    return static_cast<double>(sums.capacity() * sizeof sums[0] +
                               (slot_of.capacity() + used.capacity()) * sizeof(int));
  }

 private:
  struct alignas(64) Sum : BinnedSums<3> {};

  Sum &sum_of(int vertex)
  {
    if (slot_of[vertex] < 0) {
      slot_of[vertex] = static_cast<int>(used.size());
      used.push_back(vertex);
      sums.emplace_back();
    }
    return sums[slot_of[vertex]];
  }

  std::vector<int> slot_of;    // by vertex: -1: none
  std::vector<int> used;       // vertices by slot
  AlignedVector<Sum> sums;     // by slot
  BinnedSums<1> of_numbers;
};

}    // namespace Talus

#endif
