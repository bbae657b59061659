// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums of vectors by vertex, and of one number, without rounding: the same bits in any order, over any
// number of ranks. Only vertices to which something was added take memory.

#ifndef TALUS_BODY_CONTACT_VERTEX_SUMS_H
#define TALUS_BODY_CONTACT_VERTEX_SUMS_H

#include "base/exact_sum.h"
#include "base/vector3.h"

#include <array>
#include <vector>

namespace Talus {

class VertexSums {
 public:
  explicit VertexSums(int num_vertices) : slot_of(num_vertices, -1) {}

  void add(int vertex, const Vector3<double> &v)
  {
    if (v.x == 0.0 && v.y == 0.0 && v.z == 0.0) return;
    std::array<ExactSum, 3> &sum = sum_of(vertex);
    sum[0].add(v.x);
    sum[1].add(v.y);
    sum[2].add(v.z);
  }
  void add(double number) { of_numbers.add(number); }
  void clear();

  /// Those to which something was added, ascending.
  std::vector<int> vertices() const;
  Vector3<double> sum(int vertex) const;
  double sum_of_numbers() const { return of_numbers.value(); }

  /// Exactly, for messages and files: behind what is there. unpack() adds what it finds.
  void pack(std::vector<double> &to) const;
  void unpack(const double *begin, const double *end);
  double memory_usage() const
  {
    return static_cast<double>(sums.capacity() * sizeof sums[0] +
                               (slot_of.capacity() + used.capacity()) * sizeof(int));
  }

 private:
  std::array<ExactSum, 3> &sum_of(int vertex);

  std::vector<int> slot_of;     // by vertex: -1: none
  std::vector<int> used;        // vertices by slot
  std::vector<std::array<ExactSum, 3>> sums;    // by slot, some more
  ExactSum of_numbers;
};

}    // namespace Talus

#endif
