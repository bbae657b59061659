// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// To be preloaded into ranks of which there are more than cores: one that waits for a message sleeps. MPI libraries
// look for messages without end, at best with sched_yield() in between, and the ranks that have work to do share the cores
// with those that only look: half of the time of the tests was spent so, in the kernel.

#include <ctime>
#include <sys/prctl.h>

// NOLINTNEXTLINE(bugprone-reserved-identifier): the name of the C library
extern "C" __attribute__((visibility("default"))) int sched_yield()
{
  thread_local int calls = 0;
  // the kernel rounds a sleep up by 50 us if it is not told otherwise
  if (calls == 0) prctl(PR_SET_TIMERSLACK, 1000UL, 0UL, 0UL, 0UL);
  constexpr int soon = 20;    // a message that comes at once is not slept over
  if (++calls % soon != 0) return 0;
  const timespec pause{0, 10000};
  nanosleep(&pause, nullptr);
  return 0;
}
