// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_TESTS_SAME_NUMBERS_H
#define TALUS_TESTS_SAME_NUMBERS_H

#include <algorithm>
#include <cstring>

/// Whether two structures of doubles hold the same numbers. A zero that only differs in sign adds
/// the same to any sum.
template <class Doubles> bool same_numbers(const Doubles &a, const Doubles &b)
{
  constexpr std::size_t count = sizeof(Doubles) / sizeof(double);
  double of_a[count], of_b[count];
  std::memcpy(of_a, &a, sizeof a);
  std::memcpy(of_b, &b, sizeof b);
  return std::equal(of_a, of_a + count, of_b);
}

#endif
