// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_CONTACT_IN_PARALLEL_H
#define TALUS_CONTACT_IN_PARALLEL_H

#include <cstdint>
#include <exception>

namespace Talus {

/// work(n) for n = 0 ... count-1 by so many threads, each of them a range of n. What work throws,
/// out of memory for one, is thrown here when all are done: in a thread nobody would catch it.
template <class Work> void in_parallel(int count, int threads, Work work)
{
  in_parallel(
      count, threads, [](int) {}, work);
}

/// The same, of which all of `first` is done before any of `work` begins; the same thread does both
/// for one n. One start and one end of the threads less than two calls.
template <class First, class Work> void in_parallel(int count, int threads, First first, Work work)
{
  std::exception_ptr failure;
  const auto guarded = [&failure](auto &task, int n) {
    try {
      task(n);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  };
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
#pragma omp for schedule(static)
    for (int n = 0; n < count; n++) guarded(first, n);
#pragma omp for schedule(static) nowait
    for (int n = 0; n < count; n++) guarded(work, n);
  }
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
