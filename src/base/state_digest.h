// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BASE_STATE_DIGEST_H
#define TALUS_BASE_STATE_DIGEST_H

#include <cstdint>
#include <cstring>

namespace Talus {

/// Tells whether numbers have changed: all their bits go into 64. FNV-1a with words in the place of
/// bytes, which takes a few cycles for each number.
class StateDigest {
 public:
  std::uint64_t value() const { return digest; }

  void add(std::uint64_t word) { digest = (digest ^ (word >> 32U) ^ word) * 1099511628211U; }
  void add(double number)
  {
    std::uint64_t word;
    std::memcpy(&word, &number, sizeof word);
    add(word);
  }
  void add(const double *numbers, std::int64_t count)
  {
    for (std::int64_t n = 0; n < count; n++) add(numbers[n]);
  }

 private:
  std::uint64_t digest = 14695981039346656037U;
};

}    // namespace Talus

#endif
