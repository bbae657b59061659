// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Random numbers that are the same on all machines and ranks, with a state of one word: splitmix64
// (Steele, Lea, Flood, OOPSLA 2014).

#ifndef TALUS_PACKING_RANDOM_NUMBERS_H
#define TALUS_PACKING_RANDOM_NUMBERS_H

#include <cstdint>
#include <utility>
#include <vector>

namespace Talus {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state(seed) {}

  /// 0 < number < 1
  double uniform() { return (static_cast<double>(next() >> 12) + 0.5) * 0x1p-52; }

  template <class Thing> void shuffle(std::vector<Thing> &things)
  {
    for (std::size_t n = things.size(); n > 1; n--) std::swap(things[n - 1], things[next() % n]);
  }

  /// Any 64 bits.
  std::uint64_t draw() { return next(); }

  std::uint64_t state;

 private:
  std::uint64_t next()
  {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
};

}    // namespace Talus

#endif
