// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the benchmarks of stages share: sizes, beds that are made once, how results are stated. All
// times are stated per sphere (items of Google Benchmark).

#ifndef TALUS_BENCH_STAGES_H
#define TALUS_BENCH_STAGES_H

#include "bed.h"

#include <benchmark/benchmark.h>

#include <map>

namespace Bench {

/// Spheres: in the second cache of most machines, in the third, and in memory.
inline void sizes(benchmark::internal::Benchmark *benchmark)
{
  for (const int n : {3000, 50000, 400000}) benchmark->Arg(n);
}

inline Bed &bed_of(const benchmark::State &state)
{
  static std::map<std::int64_t, Bed> beds;
  const auto found = beds.find(state.range(0));
  if (found != beds.end()) return found->second;
  return beds[state.range(0)] = make_bed(static_cast<int>(state.range(0)));
}

inline void count_spheres(benchmark::State &state, double each)
{
  state.SetItemsProcessed(static_cast<std::int64_t>(each * state.iterations()));
}

}    // namespace Bench

#endif
