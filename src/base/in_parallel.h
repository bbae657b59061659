// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BASE_IN_PARALLEL_H
#define TALUS_BASE_IN_PARALLEL_H

#include <cstdint>
#include <exception>

namespace Talus {

namespace in_parallel_detail {

/// Inside a parallel region: every thread does its share of each stage, and waits between stages.
template <class Guarded, class Stage, class... Later>
void do_stages(int count, const Guarded &guarded, Stage &stage, Later &...later)
{
#pragma omp for schedule(static) nowait
  for (int n = 0; n < count; n++) guarded(stage, n);
  if constexpr (sizeof...(later) > 0) {
#pragma omp barrier
    do_stages(count, guarded, later...);
  }
}

template <class Stage> void do_alone(int count, Stage &stage)
{
  for (int n = 0; n < count; n++) stage(n);
}

}    // namespace in_parallel_detail

/// stage(n) for n = 0 ... count-1 by so many threads, each of them a range of n. Of several stages
/// all of one is done before any of the next one begins; the same thread does all stages for one n,
/// and threads start and end once. What a stage throws, out of memory for one, is thrown here, by
/// several threads when all are done: no handler catches exceptions of a thread.
template <class... Stage> void in_parallel(int count, int threads, Stage... stages)
{
  if (threads <= 1) {    // even a team of one thread would be created again, and its barriers call
                         // the system
    (in_parallel_detail::do_alone(count, stages), ...);
    return;
  }
  std::exception_ptr failure;
  const auto guarded = [&failure](auto &stage, int n) {
    try {
      stage(n);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  };
#pragma omp parallel num_threads(threads)
  in_parallel_detail::do_stages(count, guarded, stages...);
  if (failure) std::rethrow_exception(failure);
}

/// work(thread, begin, end) for as many ranges of 0 ... n-1 as there are threads, in ascending
/// order and at the same time.
template <class Work> void in_ranges(std::int64_t n, int threads, Work work)
{
  in_parallel(threads, threads, [&](int t) {
    work(t, static_cast<int>(n * t / threads), static_cast<int>(n * (t + 1) / threads));
  });
}

}    // namespace Talus

#endif
