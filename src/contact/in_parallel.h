// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_CONTACT_IN_PARALLEL_H
#define TALUS_CONTACT_IN_PARALLEL_H

#include <exception>

namespace Talus {

/// work(n) for n = 0 ... count-1 by so many threads, each of them a range of n. What work throws,
/// out of memory for one, is thrown here when all are done: in a thread nobody would catch it.
template <class Work> void in_parallel(int count, int threads, Work work)
{
  std::exception_ptr failure;
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (int n = 0; n < count; n++) try {
      work(n);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  if (failure) std::rethrow_exception(failure);
}

}    // namespace Talus

#endif
