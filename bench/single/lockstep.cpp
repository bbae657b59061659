// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What it costs on this machine that two cores wait for each other after every step, whatever they
// compute: two threads repeat the same arithmetic, for about as long as half a step of a bed of
// 50 000 spheres, and either meet after each repetition or do not. And how long a cache line takes
// to the other core and back, which says whether the two share a cache.
//
// usage: lockstep CORE CORE TURNS
// Prints the seconds that each way took, without meeting (mean of the threads) and with it, 0 if
// there are no turns; and the nanoseconds of the cache line.

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include <pthread.h>

namespace {

constexpr int repetitions = 100, round_trips = 100000;

/// Where both threads wait for each other; without sleeping, as OpenMP and MPI do.
class Meeting {
 public:
  void wait()
  {
    const int now = round.load();
    if (arrived.fetch_add(1) == 0) {
      while (round.load() == now) {
      }
      return;
    }
    arrived.store(0);
    round.store(now + 1);
  }

 private:
  std::atomic<int> arrived{0}, round{0};
};

void pin(int core)
{
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(core, &set);
  if (pthread_setaffinity_np(pthread_self(), sizeof set, &set) != 0)
    std::fprintf(stderr, "lockstep: core %d is not ours, times are those of any core\n", core);
}

/// About a millisecond, on as many bytes as half of the bed has: a shared cache holds them. Never
/// inlined, or compilers would exchange its loops with those around it.
constexpr std::size_t size = 5000000 / sizeof(double);
[[gnu::noinline]] void work(std::vector<double> &numbers)
{
  for (int pass = 0; pass < 2; pass++)
    for (double &a : numbers) a = 1.0 + std::sqrt(a) / (0.5 + a);
}

double seconds_of(std::vector<double> &numbers, Meeting *meeting)
{
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < repetitions; n++) {
    work(numbers);
    if (meeting) meeting->wait();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Both threads call it; the first one returns the mean time (s) of the line to the other core and
/// back.
double line_round_trip(int who)
{
  alignas(64) static std::atomic<int> turn{0};
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < round_trips; n++) {
    while (turn.load(std::memory_order_acquire) != who) {
    }
    turn.store(1 - who, std::memory_order_release);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
         round_trips;
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc != 4) {
    std::fprintf(stderr, "usage: lockstep CORE CORE TURNS\n");
    return 1;
  }
  const int turns = std::atoi(argv[3]);
  Meeting start, meeting;
  double apart[2] = {}, together[2] = {}, trip[2] = {};
  const auto run = [&](int who) {
    pin(std::atoi(argv[1 + who]));
    start.wait();
    trip[who] = line_round_trip(who);
    if (turns == 0) return;
    std::vector<double> numbers(size, 1.0);
    work(numbers);
    for (int turn = 0; turn < turns; turn++) {
      start.wait();
      apart[who] += seconds_of(numbers, nullptr);
      start.wait();
      together[who] += seconds_of(numbers, &meeting);
    }
  };
  std::thread other(run, 1);
  run(0);
  other.join();
  std::printf("%g %g %g\n", 0.5 * (apart[0] + apart[1]), 0.5 * (together[0] + together[1]),
              1.0e9 * trip[0]);
}
